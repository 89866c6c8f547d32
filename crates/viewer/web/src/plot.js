// Unshot light and stated error against time, both axes logarithmic.

import { draw, make, percent, seconds } from './text.js';

const WIDTH = 400;
const HEIGHT = 210;
const LEFT = 52;
const RIGHT = 8;
const TOP = 8;
const BOTTOM = 32;

/** A figure of the report's curve, or nothing where it has fewer than two points. */
export function plot(curve) {
  const points = curve.filter((p) => p.seconds > 0);
  const unshot = points.filter((p) => p.unshot > 0);
  const errors = points.filter((p) => p.error > 0);
  if (unshot.length + errors.length < 2) return null;
  const x = axis(points.map((p) => p.seconds), LEFT, WIDTH - RIGHT);
  const y = axis([...unshot.map((p) => p.unshot), ...errors.map((p) => p.error)], HEIGHT - BOTTOM, TOP);
  const line = (list, of) => list.map((p) => `${x.at(p.seconds).toFixed(1)},${y.at(of(p)).toFixed(1)}`).join(' ');
  const svg = draw('svg', {
    class: 'plot', viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img',
    'aria-label': 'Unshot light and stated error against time; the table below has the numbers after each mesh.',
  });
  for (const decade of x.decades) {
    svg.append(
      draw('line', { class: 'grid', x1: x.at(decade), x2: x.at(decade), y1: TOP, y2: HEIGHT - BOTTOM }),
      draw('text', { x: x.at(decade), y: HEIGHT - BOTTOM + 14, 'text-anchor': 'middle' }, seconds(decade)));
  }
  for (const decade of y.decades) {
    svg.append(
      draw('line', { class: 'grid', x1: LEFT, x2: WIDTH - RIGHT, y1: y.at(decade), y2: y.at(decade) }),
      draw('text', { x: LEFT - 5, y: y.at(decade) + 4, 'text-anchor': 'end' }, percent(decade)));
  }
  svg.append(draw('text', { x: (LEFT + WIDTH - RIGHT) / 2, y: HEIGHT - 3, 'text-anchor': 'middle' }, 'time of the solve'));
  // Each mesh begins in the dark: a line for each.
  const pieces = [[]];
  for (const p of points) {
    if (p.unshot > 0) pieces[pieces.length - 1].push(p);
    if (p.elements !== null) pieces.push([]);
  }
  for (const piece of pieces.filter((p) => p.length > 1)) {
    svg.append(draw('polyline', { class: 'unshot', points: line(piece, (p) => p.unshot) }));
  }
  svg.append(draw('polyline', { class: 'error', points: line(errors, (p) => p.error) }));
  for (const p of errors) svg.append(draw('circle', { cx: x.at(p.seconds), cy: y.at(p.error), r: 3.5 }));
  return make('figure', { class: 'figure' }, svg,
    make('figcaption', { class: 'note' },
      make('span', { class: 'key' }, 'unshot share, a line for each mesh'),
      make('span', { class: 'key of-error' }, 'stated error')));
}

/** A logarithmic axis over some values, between two pixels. */
function axis(values, from, to) {
  const low = Math.log10(Math.min(...values));
  const high = Math.log10(Math.max(...values));
  const wide = Math.max(high - low, 0.3); // one value is no axis
  const start = low - 0.04 * wide;
  const length = 1.08 * wide;
  const at = (value) => from + ((Math.log10(value) - start) / length) * (to - from);
  const decades = [];
  for (let d = Math.ceil(start); d <= start + length; d++) decades.push(10 ** d);
  if (decades.length < 2) {
    // Less than two decades: 1, 2, 5.
    decades.length = 0;
    for (let d = Math.floor(start); d <= start + length; d++) {
      for (const m of [1, 2, 5]) {
        const value = m * 10 ** d;
        if (Math.log10(value) >= start && Math.log10(value) <= start + length) decades.push(value);
      }
    }
  }
  // More lines than this cover the curve.
  const every = Math.ceil(decades.length / 6);
  return { at, decades: decades.filter((_, i) => i % every === 0) };
}
