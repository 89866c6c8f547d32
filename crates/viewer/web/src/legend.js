// False colour: the range, where it comes from, and the legend that says what a colour means.

import { NAMES, scalar, spread } from './channel.js';
import { make, short } from './text.js';
import { viridisCss } from './viridis.js';

/** Shares of the area that the fitted range spans: a few elements beside a lamp set no scale. */
const LEAST = 0.01;
const MOST = 0.99;
/** Colours of the legend's bar; the browser blends between them. */
const STOPS = 33;
const TICKS = 5;
/** A logarithmic scale is fitted over at most this factor. */
const WIDEST = 1e6;

/** The range that fits the scene. */
export function fit(light, channel, logarithmic) {
  const [low, high] = spread(light, scalar(channel), LEAST, MOST);
  if (logarithmic) return high > low ? [Math.max(low, high / WIDEST), high] : [high / 10, high];
  return [0, high];
}

/** Why a range cannot be shown, or nothing. */
export function wrong([low, high], logarithmic) {
  if (!Number.isFinite(low) || !Number.isFinite(high)) return 'Both ends must be numbers.';
  if (!(low < high)) return 'The first number must be below the second.';
  if (logarithmic && !(low > 0)) return 'A logarithmic scale begins above 0.';
  return '';
}

/** Draws the legend. */
export function legend(light, channel, [low, high], logarithmic) {
  const at = (share) => (logarithmic ? low * (high / low) ** share : low + (high - low) * share);
  const colours = Array.from({ length: STOPS }, (_, i) => viridisCss(i / (STOPS - 1)));
  document.getElementById('legend-title').textContent =
    `exitance, ${NAMES[scalar(channel)]}, ${light.unit}${logarithmic ? ', logarithmic' : ''}`;
  document.getElementById('legend-bar').style.background = `linear-gradient(to right, ${colours.join(', ')})`;
  const ticks = Array.from({ length: TICKS }, (_, i) => i / (TICKS - 1)).map((share, i) => {
    const sign = i === 0 && low > 0 ? '≤ ' : i === TICKS - 1 ? '≥ ' : '';
    const tick = make('span', {}, sign + short(at(share)));
    tick.style.left = `${100 * share}%`;
    return tick;
  });
  document.getElementById('legend-ticks').replaceChildren(...ticks);
}
