// What is known of the point that was clicked.

import { facts, make, number, numeric, table } from './text.js';

/** Irradiance from exitance: (B − E) / ρ, unknown where nothing is reflected. */
export function irradiance(exitance, material) {
  return exitance.map((b, c) =>
    (material.reflectance[c] > 0 ? (b - material.emittance[c]) / material.reflectance[c] : null));
}

/** Shows a hit of `pick.js`, or that there was none. */
export function showPoint(light, hit, paired) {
  const panel = document.getElementById('point');
  if (hit === null) {
    panel.replaceChildren(make('p', { class: 'note' }, 'No surface shows its front there.'));
    return;
  }
  const { element, weights, place } = hit;
  const material = light.material(element);
  const here = light.at(element, weights);
  const mean = light.mean(element);
  const row = (name, id, values) => [name, ...values.map((v, c) => {
    // Nothing is said with more digits than single precision holds.
    const exact = v === null ? '' : String(v);
    return make('data', { value: exact, 'data-of': id, 'data-channel': 'rgb'[c] }, v === null ? '–' : number(v));
  })];
  const { unit } = light;
  const what = light.cornersOnly ? 'mean of the element’s corners' : 'mean of the element';
  const sides = paired ? ', both sides' : '';
  const rows = [
    row(`exitance here, ${unit}`, 'exitance-here', here),
    row(`exitance, ${what}, ${unit}`, 'exitance-mean', mean),
    row(`irradiance here${sides}, ${unit}`, 'irradiance-here', irradiance(here, material)),
    row(`irradiance, ${what}${sides}, ${unit}`, 'irradiance-mean', irradiance(mean, material)),
    row(`emittance, ${unit}`, 'emittance', material.emittance),
    row('reflectance', 'reflectance', material.reflectance),
  ];
  const where = light.toFile(place);
  const text = (id, value) => make('span', { 'data-of': id }, value);
  panel.replaceChildren(
    facts([
      ['material', text('material', material.name || 'unnamed')],
      ['group', text('group', light.group(element) || 'unnamed')],
      ['side', text('side', light.isBack(element) ? 'back' : 'front')],
      // In a lit file elements are all that is left of triangles.
      ['triangle', light.cornersOnly ? null : text('triangle', String(light.triangles[element]))],
      ['element', text('element', String(element))],
      ['its area', text('area', `${number(light.area(element))} (file unit²)`)],
      ['place', text('place', where.map(number).join(', '))],
    ]),
    table(['', 'red', 'green', 'blue'], numeric(rows)),
  );
  for (const [c, value] of where.entries()) panel.dataset[`place${c}`] = String(value);
}
