// The elements as one mesh, each with the light of its own side; only fronts are drawn.

import {
  BufferAttribute, BufferGeometry, ClampToEdgeWrapping, DataTexture, FrontSide, GLSL3, LinearFilter, Mesh,
  NoColorSpace, RGBAFormat, ShaderMaterial, Vector2,
} from 'three';
import { FRAGMENT, VERTEX } from './shaders.js';
import { COLOURS, viridisBytes } from './viridis.js';

const CHANNELS = ['rgb', 'r', 'g', 'b', 'mean'];

/** What is drawn, and how. */
export class Surface {
  constructor(light) {
    const map = new DataTexture(viridisBytes(), COLOURS, 1, RGBAFormat);
    Object.assign(map, {
      minFilter: LinearFilter, magFilter: LinearFilter, wrapS: ClampToEdgeWrapping, colorSpace: NoColorSpace,
      needsUpdate: true,
    });
    this.material = new ShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      side: FrontSide,
      uniforms: {
        exposure: { value: 1 }, channel: { value: 0 }, falseColour: { value: false },
        logarithmic: { value: false }, range: { value: new Vector2(0, 1) }, map: { value: map },
        wireframe: { value: false }, picked: { value: -1 }, planes: { value: new Vector2(1, 2) },
      },
    });
    this.mesh = new Mesh(new BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.shading = 'corners';
    this.show(light);
  }

  /** Takes other light, of the same scene or of another. */
  show(light) {
    this.light = light;
    const positions = new Float32Array(9 * light.count);
    const place = [0, 0, 0];
    for (let i = 0; i < 3 * light.count; i++) {
      positions.set(light.corner(Math.trunc(i / 3), i % 3, place), 3 * i);
    }
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.geometry.setAttribute('position', new BufferAttribute(positions, 3));
    this.shade(this.shading);
  }

  /** Interpolates between `corners`, or gives `elements` one value each. */
  shade(shading) {
    this.shading = shading;
    let values = this.light.cornerExitance;
    if (shading === 'elements') {
      values = new Float32Array(9 * this.light.count);
      for (let i = 0; i < values.length; i++) {
        values[i] = this.light.exitance[3 * Math.trunc(i / 9) + (i % 3)];
      }
    }
    this.mesh.geometry.setAttribute('light', new BufferAttribute(values, 3));
  }

  /** Sets any of `exposure`, `channel`, `falseColour`, `logarithmic`, `range`, `wireframe`, `picked`. */
  set(settings) {
    const { uniforms } = this.material;
    for (const [name, value] of Object.entries(settings)) {
      if (name === 'channel') uniforms.channel.value = CHANNELS.indexOf(value);
      else if (name === 'range') uniforms.range.value.set(...value);
      else uniforms[name].value = value;
    }
  }
}
