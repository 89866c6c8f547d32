// The report of the solve: how wrong the light can be, where it went, and what was left out, and why.

import { plot } from './plot.js';
import { count, facts, make, numeric, percent, seconds, table } from './text.js';

const CHANNELS = ['red', 'green', 'blue'];

/** The most important thing in one line. */
export function headline(report) {
  if (report === null) return 'No report was given: how wrong this light is, is not known here.';
  const { error, mesh, seconds: time } = report;
  const work = `${count(mesh.elements)} elements, ${seconds(time.solve)}`;
  if (error === null) return `No error is stated. ${work}`;
  return error.total === null ? `The error is unknown. ${work}` : `Error at most ${percent(error.total)} (E1). ${work}`;
}

/** Fills the report's place. */
export function showReport(report) {
  const place = document.getElementById('report');
  if (report === null) {
    place.replaceChildren();
    place.hidden = true;
    return;
  }
  place.hidden = false;
  place.replaceChildren(
    make('h2', {}, 'How wrong it can be'), ...statement(report),
    make('h2', {}, 'Error and unshot light against time'), ...curve(report),
    make('h2', {}, 'What was left out, and why'), ...plan(report),
    make('h2', {}, 'Where the light went'), ...energy(report),
    make('h2', {}, 'The run'), ...run(report),
  );
}

function statement({ error, solve }) {
  const limit = solve.limit === null ? [] : [make('p', {}, `Ended early by ${solve.limit}.`)];
  if (error === null) return [...limit, make('p', {}, 'This run states no error: it was told not to, or there is no light.')];
  const row = (name, parts) => [name, ...['total', 'iteration', 'form_factor', 'mesh'].map((part) => {
    const known = parts[part] !== null;
    return make('data', { value: known ? String(parts[part]) : '', 'data-error': part }, percent(parts[part]));
  })];
  const rows = [
    row('of the triangles’ exitance, E1', error),
    row('largest on one triangle', error.largest),
    row('at single places, E1', error.points),
    row('largest at a single place', error.points.largest),
  ];
  if (error.probes !== null) rows.push(row('at the probes, E1', error.probes));
  return [
    ...limit,
    table(['', 'total', 'iteration', 'form factors', 'mesh'], numeric(rows)),
    make('p', { class: 'note' },
      `Relative to the mean exitance of what does not emit. Form factors sum to ${error.rows.least.toFixed(4)} to `
      + `${error.rows.most.toFixed(4)} in ${count(error.sample)} sampled elements; 1 if closed.`),
  ];
}

function curve({ curve: points }) {
  const levels = points.filter((p) => p.elements !== null);
  const rows = levels.map((p) => [count(p.elements), seconds(p.seconds), percent(p.unshot), percent(p.error)]);
  return [
    plot(points) ?? make('p', { class: 'note' }, 'The work was too short for a curve.'),
    table(['elements', 'time', 'unshot', 'error'], numeric(rows)),
  ];
}

function plan({ plan: { decisions, foreseen, everything, actual } }) {
  const listed = (leaves) => decisions.filter((d) => d.leaves_out === leaves).map((d) =>
    make('details', { 'data-topic': d.topic },
      make('summary', leaves ? { class: 'left-out' } : {}, `${d.topic}: ${d.choice}`),
      make('p', {}, d.why),
      make('p', { class: 'note' }, `What it can do to the light: ${d.effect}.`),
      leaves ? make('p', { class: 'note' },
        `Foreseen to save ${count(d.saves.form_factors)} form factors, ${count(d.saves.segments)} segments, `
        + `${count(d.saves.directions)} directions, ${seconds(d.saves.seconds)} on one thread.`) : null));
  const work = (name, w) => (w === null ? null
    : [name, count(w.elements), count(w.form_factors), count(w.segments), seconds(w.seconds)]);
  const rows = [work('if nothing were left out', everything), work('foreseen', foreseen), work('done', actual)];
  const out = listed(true);
  return [
    ...(out.length > 0 ? out : [make('p', {}, 'Nothing was left out.')]),
    make('h3', {}, 'Other decisions'), ...listed(false),
    table(['work', 'elements', 'form factors', 'segments', 'time'], numeric(rows.filter((row) => row !== null))),
    make('p', { class: 'note' }, 'Times that were foreseen are those of one thread.'),
  ];
}

function energy({ energy: ledger }) {
  const share = (name, of) => [name, ...CHANNELS.map((_, c) =>
    (ledger.emitted[c] > 0 ? percent(ledger[of][c] / ledger.emitted[c]) : '–'))];
  return [
    table(['of what was emitted', ...CHANNELS], numeric([
      share('absorbed', 'absorbed'), share('escaped', 'escaped'), share('of that, by form factors', 'form_factor_defect'),
      share('met wrong sides', 'wrong_side'), share('unshot', 'unshot'),
    ])),
  ];
}

function run({ scene, mesh, solve, occluder, settings, seconds: time, warnings, version }) {
  const list = warnings.length === 0 ? [] : [
    make('details', {}, make('summary', {}, `${count(warnings.length)} warnings of the import`),
      make('ul', {}, ...warnings.map((warning) => make('li', {}, warning)))),
  ];
  return [
    facts([
      ['scene', `${scene.file} (${scene.format}), ${count(scene.triangles)} triangles, ${count(scene.emitters)} emit`],
      ['mesh', `${count(mesh.elements)} elements in ${count(mesh.patches)} patches, ${count(mesh.receiver_points)} receiver points`],
      ['work', `${count(solve.shots)} shots, ${count(solve.rays)} segments, ${count(solve.form_factors)} form factors`],
      ['occluders', occluder.kind],
      ['threads', String(settings.threads)],
      ['time', `read ${seconds(time.read)}, plan ${seconds(time.plan)}, solve ${seconds(time.solve)}`],
      ['program', `radiosity ${version}`],
    ]),
    ...list,
  ];
}
