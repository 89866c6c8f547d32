// Which element a ray meets first, and where: in double precision, over all elements.

/** Hits this far outside an edge, as a share of the triangle, count: rays between two elements meet one. */
const SLACK = 1e-7;

/** The first element whose front the ray meets: its number, the place, and its barycentric weights. */
export function pick(light, origin, direction) {
  let best = null;
  const [a, b, c] = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  for (let element = 0; element < light.count; element++) {
    light.corner(element, 0, a);
    light.corner(element, 1, b);
    light.corner(element, 2, c);
    const hit = meet(a, b, c, origin, direction);
    if (hit !== null && (best === null || hit.distance < best.distance)) best = { element, ...hit };
  }
  if (best === null) return null;
  const place = origin.map((o, axis) => o + best.distance * direction[axis]);
  return { element: best.element, weights: best.weights, place };
}

/** Möller & Trumbore (1997), fronts only. */
function meet(a, b, c, origin, direction) {
  const ab = minus(b, a);
  const ac = minus(c, a);
  const across = cross(direction, ac);
  const volume = dot(ab, across);
  if (!(volume > 0)) return null;
  const from = minus(origin, a);
  const v = dot(from, across) / volume;
  if (v < -SLACK || v > 1 + SLACK) return null;
  const up = cross(from, ab);
  const w = dot(direction, up) / volume;
  if (w < -SLACK || v + w > 1 + SLACK) return null;
  const distance = dot(ac, up) / volume;
  return distance > 0 ? { distance, weights: [1 - v - w, v, w] } : null;
}

export const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
