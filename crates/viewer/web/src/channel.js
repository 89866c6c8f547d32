// One number of three channels, and which part of the scene it covers.

/** The names of the channels, as legends have them. */
export const NAMES = { r: 'red', g: 'green', b: 'blue', mean: 'mean of red, green and blue' };

/** The channel that false colour shows: three are not one number. */
export function scalar(channel) {
  return channel === 'rgb' ? 'mean' : channel;
}

/** The value of a channel, of the element's mean exitance. */
function value(light, element, channel) {
  const at = 3 * element;
  const place = { r: 0, g: 1, b: 2 }[channel];
  if (place !== undefined) return light.exitance[at + place];
  return (light.exitance[at] + light.exitance[at + 1] + light.exitance[at + 2]) / 3;
}

/** Values between which a share of the area of what does not emit lies: `least` and `most` of it. */
export function spread(light, channel, least, most) {
  const lamps = light.materials.map(({ emittance }) => emittance.some((e) => e > 0));
  const emits = (element) => lamps[light.triangleMaterials[light.triangles[element]]];
  const values = Float64Array.from({ length: light.count }, (_, e) => value(light, e, channel));
  const all = Uint32Array.from(values.keys()).filter((e) => values[e] > 0);
  const walls = all.filter((e) => !emits(e));
  // Lamps count only where nothing else is lit.
  const lit = (walls.length > 0 ? walls : all).sort((a, b) => values[a] - values[b]);
  if (lit.length === 0) return [0, 1];
  const total = lit.reduce((sum, e) => sum + light.areas[e], 0);
  const below = (share) => {
    let sum = 0;
    const found = lit.find((e) => (sum += light.areas[e]) >= share * total);
    return values[found ?? lit[lit.length - 1]];
  };
  return [below(least), below(most)];
}
