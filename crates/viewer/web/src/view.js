// The canvas: drawing when something changed, orbiting or walking, and the ray under a pixel.

import { Color, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Walk } from './walk.js';

/** A press that moved less than this is a click, pixels. */
const CLICK_PIXELS = 4;
/** What is nearer to the eye is cut off, in radii of the scene. */
const NEAR = 1e-4;
/** What a key turns (radians), and how much nearer it comes. */
const KEY_TURN = 0.06;
const KEY_ZOOM = 0.9;

export class View {
  constructor(canvas, surface) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true });
    this.scene = new Scene();
    // The pictures' background: sRGB 48.
    this.scene.background = new Color().setRGB(0.03, 0.03, 0.03);
    this.surface = surface;
    this.scene.add(surface.mesh);
    this.camera = new PerspectiveCamera(50, 1, NEAR, 10);
    this.walk = new Walk(this.camera, canvas, () => this.changed());
    this.mode = 'orbit';
    this.waiting = false;
    this.clicked = () => {};
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement);
    this.listen();
  }

  /** Stands where a camera of `cameras.js` stands. */
  stand({ position, target, up, fov }) {
    this.camera.up.set(...up).normalize();
    this.camera.position.set(...position);
    this.camera.lookAt(...target);
    this.fov = fov;
    this.orbit?.dispose();
    // It takes the up axis when it is made.
    this.orbit = new OrbitControls(this.camera, this.canvas);
    this.orbit.addEventListener('change', () => this.changed());
    this.orbit.target.set(...target);
    this.orbit.update();
    this.go(this.mode);
    this.resize();
  }

  /** `orbit` or `walk`. */
  go(mode) {
    if (this.mode === 'walk' && mode === 'orbit') {
      // Round a point ahead, as far as the one before.
      const distance = this.camera.position.distanceTo(this.orbit.target);
      const ahead = this.camera.getWorldDirection(new Vector3());
      this.orbit.target.copy(this.camera.position).addScaledVector(ahead, Math.max(distance, 0.05));
    }
    this.mode = mode;
    this.orbit.enabled = mode === 'orbit';
    this.walk.enabled = mode === 'walk';
  }

  /** Draws again, once, at the next frame. */
  changed() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  draw() {
    const { camera } = this;
    camera.far = camera.position.length() + 2; // the scene has radius 1
    camera.updateProjectionMatrix();
    this.surface.material.uniforms.planes.value.set(camera.near, camera.far);
    this.renderer.render(this.scene, camera);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    if (width === 0 || height === 0 || this.fov === undefined) return;
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.setSize(width, height, false);
    const aspect = width / height;
    // On a narrow screen the width sees what the height would.
    const half = Math.tan(this.fov / 2) / Math.min(1, aspect);
    this.camera.aspect = aspect;
    this.camera.fov = (2 * Math.atan(half) * 180) / Math.PI;
    this.draw();
  }

  /** The ray through a place of the canvas, in its own pixels. */
  ray(x, y) {
    this.camera.updateMatrixWorld();
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const end = new Vector3((2 * x) / width - 1, 1 - (2 * y) / height, 0.5).unproject(this.camera);
    const origin = this.camera.position;
    return [origin.toArray(), end.sub(origin).normalize().toArray()];
  }

  listen() {
    let press = null;
    this.canvas.addEventListener('pointerdown', (event) => {
      press = event.button === 0 ? [event.clientX, event.clientY] : null;
    });
    this.canvas.addEventListener('pointerup', (event) => {
      if (press === null) return;
      const moved = Math.hypot(event.clientX - press[0], event.clientY - press[1]);
      press = null;
      if (moved > CLICK_PIXELS) return;
      const box = this.canvas.getBoundingClientRect();
      this.clicked(...this.ray(event.clientX - box.left, event.clientY - box.top));
    });
    this.canvas.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.key === 'Enter' || event.key === ' ') {
        this.clicked(...this.ray(this.canvas.clientWidth / 2, this.canvas.clientHeight / 2));
      } else if (this.mode === 'orbit') {
        if (!this.orbitKey(event.key)) return;
      } else {
        return;
      }
      event.preventDefault();
    });
  }

  orbitKey(key) {
    const from = this.camera.position.clone().sub(this.orbit.target);
    const up = this.camera.up;
    const right = new Vector3().crossVectors(up, from).normalize();
    if (key === 'ArrowLeft') from.applyAxisAngle(up, KEY_TURN);
    else if (key === 'ArrowRight') from.applyAxisAngle(up, -KEY_TURN);
    else if (key === 'ArrowUp') from.applyAxisAngle(right, -KEY_TURN);
    else if (key === 'ArrowDown') from.applyAxisAngle(right, KEY_TURN);
    else if (key === '+' || key === '=') from.multiplyScalar(KEY_ZOOM);
    else if (key === '-') from.divideScalar(KEY_ZOOM);
    else return false;
    this.camera.position.copy(this.orbit.target).add(from);
    this.orbit.update();
    this.changed();
    return true;
  }
}
