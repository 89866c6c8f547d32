// One number of three channels, and which part of the scene it covers.

/** The names of the channels, as legends have them. */
export const NAMES = { r: 'red', g: 'green', b: 'blue', mean: 'mean of red, green and blue' };

/** The channel that false colour shows: three are not one number. */
export function scalar(channel) {
  return channel === 'rgb' ? 'mean' : channel;
}

/** The value of a channel. */
export function value([r, g, b], channel) {
  return { r, g, b, mean: (r + g + b) / 3 }[channel];
}

/** Values between which a share of the area of what does not emit lies: `least` and `most` of it. */
export function spread(light, channel, least, most) {
  const rows = [];
  for (const lamps of [false, true]) {
    for (let e = 0; e < light.count; e++) {
      const v = value(light.mean(e), channel);
      if (light.emits(e) === lamps && v > 0) rows.push([v, light.areas[e]]);
    }
    if (rows.length > 0) break; // lamps count only where nothing else is lit
  }
  if (rows.length === 0) return [0, 1];
  rows.sort((a, b) => a[0] - b[0]);
  const total = rows.reduce((sum, [, area]) => sum + area, 0);
  const below = (share) => {
    let sum = 0;
    const found = rows.find(([, area]) => (sum += area) >= share * total);
    return (found ?? rows[rows.length - 1])[0];
  };
  return [below(least), below(most)];
}
