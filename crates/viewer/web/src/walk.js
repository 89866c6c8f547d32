// Walking: drag to look about, W A S D to go, Q and E to sink and rise.

import { Vector3 } from 'three';

/** Scene radii a second, and how much faster with Shift. */
const SPEED = 0.35;
const FASTER = 4;
/** Nearly straight up: beyond, the picture would turn over. */
const STEEPEST = 1.55;
/** How far a key turns, radians. */
const KEY_TURN = 0.06;

/** Radians that a drag over the whole height turns, in fields of view. */
const DRAG = 1;

export class Walk {
  constructor(camera, canvas, changed) {
    Object.assign(this, { camera, canvas, changed, enabled: false, held: new Set(), last: null });
    canvas.addEventListener('pointerdown', (event) => {
      if (!this.enabled) return;
      this.last = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!this.enabled || this.last === null) return;
      const perPixel = (DRAG * camera.fov * Math.PI) / 180 / canvas.clientHeight;
      this.turn((event.clientX - this.last[0]) * perPixel, (event.clientY - this.last[1]) * perPixel);
      this.last = [event.clientX, event.clientY];
    });
    for (const end of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(end, () => { this.last = null; });
    }
    // Letters work wherever the focus is, but where they mean something else.
    document.addEventListener('keydown', (event) => {
      if (!this.enabled || event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.target.closest('select, input[type="number"]')) return;
      const turns = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
      if (turns && event.target === canvas) {
        this.turn(turns[0] * KEY_TURN, turns[1] * KEY_TURN);
      } else if (DIRECTIONS[event.code]) {
        this.fast = event.shiftKey;
        if (this.held.size === 0) this.start();
        this.held.add(event.code);
      } else {
        return;
      }
      event.preventDefault();
    });
    document.addEventListener('keyup', (event) => this.held.delete(event.code));
    window.addEventListener('blur', () => this.held.clear());
  }

  /** Looks to the left and up by these angles. */
  turn(left, up) {
    const { camera } = this;
    const axis = camera.up.clone().normalize();
    const ahead = camera.getWorldDirection(new Vector3());
    ahead.applyAxisAngle(axis, left);
    const height = Math.PI / 2 - ahead.angleTo(axis);
    const to = Math.min(STEEPEST, Math.max(-STEEPEST, height + up));
    ahead.applyAxisAngle(new Vector3().crossVectors(ahead, axis).normalize(), to - height);
    camera.lookAt(camera.position.clone().add(ahead));
    this.changed();
  }

  /** Goes on as long as a key is held. */
  start() {
    let before = performance.now();
    const go = (now) => {
      if (this.held.size === 0) return;
      const { camera } = this;
      const ahead = camera.getWorldDirection(new Vector3());
      const right = new Vector3().crossVectors(ahead, camera.up).normalize();
      const step = new Vector3();
      for (const code of this.held) {
        const [r, a, u] = DIRECTIONS[code];
        step.addScaledVector(right, r).addScaledVector(ahead, a).addScaledVector(camera.up, u);
      }
      // A frame that took long is no leap through a wall.
      const time = Math.min(0.1, Math.max(0, now - before) / 1000);
      before = now;
      camera.position.addScaledVector(step, time * SPEED * (this.fast ? FASTER : 1));
      this.changed();
      requestAnimationFrame(go);
    };
    requestAnimationFrame(go);
  }
}

/** By place on the keyboard, whatever is written on the keys: to the right, ahead, up. */
const DIRECTIONS = {
  KeyW: [0, 1, 0], KeyS: [0, -1, 0], KeyA: [-1, 0, 0], KeyD: [1, 0, 0], KeyQ: [0, 0, -1], KeyE: [0, 0, 1],
};
