// The page: takes the light and the report that stand in it, or that come while the program solves.

import { cameras } from './cameras.js';
import { fit, legend, wrong } from './legend.js';
import { decode, fromBase64 } from './light.js';
import { follow } from './live.js';
import { pick } from './pick.js';
import { showPoint } from './point.js';
import { headline, showReport } from './report.js';
import { Surface } from './surface.js';
import { make, short } from './text.js';
import { View } from './view.js';

const KEYS = {
  orbit: 'Drag turns, wheel comes nearer, right button shifts. Keys: arrows turn, + and − move.',
  walk: 'Drag looks about. W A S D goes, Q and E sink and rise, Shift is faster, arrows turn.',
};

const by = (id) => document.getElementById(id);
const chosen = (name) => document.querySelector(`input[name="${name}"]:checked`).value;

/** Says what keeps the page from working. */
function trouble(text) {
  by('trouble').textContent = text;
  by('trouble').hidden = false;
}

class Page {
  constructor(facts) {
    this.facts = facts;
    by('title').textContent = facts.title;
    document.title = `${facts.title} – radiosity`;
    by('headline').textContent = facts.live ? '' : headline(facts.report);
    try {
      showReport(facts.report);
    } catch (error) {
      trouble(`The report cannot be shown: ${error.message}`);
    }
  }

  /** Shows light: the first sets up the view, others replace it. */
  show(light) {
    this.light = light;
    this.expose(light);
    if (this.view) {
      this.surface.show(light);
    } else {
      this.surface = new Surface(light);
      this.view = new View(by('canvas'), this.surface);
      this.view.clicked = (...ray) => {
        this.asked = ray;
        this.answer();
      };
      this.cameras = cameras(light);
      by('camera').replaceChildren(...this.cameras.map((c, i) => make('option', { value: i }, c.name)));
      this.listen();
      this.view.stand(this.cameras[0]);
    }
    // What was asked for is asked for still: on the way to its end light changes, and meshes do.
    this.answer();
    this.apply();
  }

  /**
   * Takes the exposure of the light that is nearest to its end: each mesh begins in the dark, and should
   * be seen to.
   */
  expose(light) {
    const unshot = light.progress?.unshot ?? 0;
    if (this.unshot !== undefined && unshot > this.unshot) return;
    this.unshot = unshot;
    this.exposure = light.exposure;
  }

  /** Says what is known of the point that was asked for. */
  answer() {
    if (!this.asked) return;
    const hit = pick(this.light, ...this.asked);
    showPoint(this.light, hit, this.facts.report?.settings?.exchange === 'paired');
    this.surface.set({ picked: hit === null ? -1 : hit.element });
    this.view.changed();
  }

  listen() {
    by('camera').addEventListener('change', () => this.view.stand(this.cameras[by('camera').value]));
    for (const radio of document.querySelectorAll('input[name="mode"]')) {
      radio.addEventListener('change', () => {
        this.view.go(chosen('mode'));
        this.apply();
      });
    }
    for (const id of ['exposure', 'wireframe', 'low', 'high']) {
      by(id).addEventListener('input', () => this.apply());
    }
    by('shading').addEventListener('change', () => {
      this.surface.shade(by('shading').value);
      this.apply();
    });
    const refit = () => {
      this.range = null;
      this.apply();
    };
    for (const id of ['channel', 'false-colour']) by(id).addEventListener('change', refit);
    for (const radio of document.querySelectorAll('input[name="scale"]')) radio.addEventListener('change', refit);
    by('auto-range').addEventListener('click', refit);
  }

  /** Brings what is shown in line with the controls. */
  apply() {
    const stops = Number(by('exposure').value);
    by('exposure-value').value = `${stops > 0 ? '+' : ''}${stops} stops`;
    by('keys').textContent = KEYS[chosen('mode')];
    const channel = by('channel').value;
    const falseColour = by('false-colour').checked;
    this.surface.set({
      exposure: this.exposure * 2 ** stops, channel, falseColour, wireframe: by('wireframe').checked,
    });
    by('range').hidden = by('legend').hidden = !falseColour;
    by('exposure').disabled = falseColour;
    if (falseColour) this.applyRange(channel, chosen('scale') === 'log');
    this.view.changed();
  }

  applyRange(channel, logarithmic) {
    if (!this.range) {
      this.range = fit(this.light, channel, logarithmic);
      [by('low').value, by('high').value] = this.range.map(short);
    }
    const range = [by('low'), by('high')].map((input) => (input.value === '' ? NaN : Number(input.value)));
    const problem = wrong(range, logarithmic);
    by('range-note').textContent = problem
      || (channel === 'rgb' ? 'False colour shows the mean of the three channels.' : '');
    if (problem) return;
    this.surface.set({ range, logarithmic });
    legend(this.light, channel, range, logarithmic);
  }
}

try {
  const page = new Page(JSON.parse(by('facts').textContent));
  if (page.facts.live) {
    follow(page).catch((error) => trouble(`The light cannot be shown: ${error.message}`));
  } else {
    const text = by('light');
    page.show(decode(fromBase64(text.textContent.trim())));
    text.remove(); // what was decoded need not be kept twice
  }
} catch (error) {
  trouble(`The scene cannot be shown: ${error.message}`);
  throw error;
}
