// Where one can stand: the cameras of the scene, and one that sees all of it.

/** Vertical field of view of the whole view, radians. */
const WHOLE_FOV = 0.6;

/** A list of `{ name, position, target, up, fov }` in the page's units, the first to start with. */
export function cameras(light) {
  const ours = light.cameras.map((camera) => ({
    name: camera.name || 'unnamed',
    position: light.fromFile(camera.position),
    target: light.fromFile(camera.target),
    up: camera.up,
    fov: camera.fov,
  }));
  return [...ours, whole(ours[0]?.up ?? [0, 1, 0])];
}

/** From a corner above, far enough to see all: the scene lies within a sphere of radius 1. */
function whole(up) {
  const axis = up.map(Math.abs).indexOf(Math.max(...up.map(Math.abs)));
  const position = [0.5, 0.5, 0.5];
  position[axis] = 0.6 * Math.sign(up[axis]);
  position[(axis + 1) % 3] = 0.8;
  const far = 1.02 / Math.sin(WHOLE_FOV / 2) / Math.hypot(...position);
  return { name: 'the whole scene', position: position.map((p) => p * far), target: [0, 0, 0], up, fov: WHOLE_FOV };
}
