// How exitance becomes a colour: the same scale, shoulder and transfer as in the program's pictures.

export const VERTEX = `
in vec3 light;
out vec3 vLight;
out vec3 vWeights;
flat out int vElement;
out float vDepth;

void main() {
  int corner = gl_VertexID % 3;
  vWeights = vec3(corner == 0, corner == 1, corner == 2);
  vElement = gl_VertexID / 3;
  vLight = light;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vDepth = gl_Position.w;
}`;

export const FRAGMENT = `
precision highp float;
precision highp int;

uniform float exposure;      // display light per exitance
uniform int channel;         // 0: three colours; 1, 2, 3: one of them; 4: their mean
uniform bool falseColour;
uniform bool logarithmic;
uniform vec2 range;          // exitance at the ends of the colour map
uniform sampler2D map;
uniform bool wireframe;
uniform int picked;          // the element that was asked for, or -1
uniform vec2 planes;         // distances of the near plane and the far one

in vec3 vLight;
in vec3 vWeights;
flat in int vElement;
in float vDepth;
out vec4 colour;

const float KNEE = 0.8;      // crates/output/src/tone.rs

vec3 curve(vec3 light) {
  float room = 1.0 - KNEE;
  vec3 over = max(light - KNEE, 0.0) / room;
  return mix(max(light, 0.0), 1.0 - room / (1.0 + over), step(KNEE, light));
}

vec3 srgb(vec3 light) {
  return mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
}

float one(vec3 light) {
  if (channel == 1) return light.r;
  if (channel == 2) return light.g;
  if (channel == 3) return light.b;
  return (light.r + light.g + light.b) / 3.0;
}

vec3 mapped(float value) {
  float share = logarithmic
    ? log(max(value, 1e-37) / range.x) / log(range.y / range.x)
    : (value - range.x) / (range.y - range.x);
  // The middle of the first texel and of the last.
  float size = float(textureSize(map, 0).x);
  return texture(map, vec2((clamp(share, 0.0, 1.0) * (size - 1.0) + 0.5) / size, 0.5)).rgb;
}

void main() {
  vec3 shown = falseColour ? mapped(one(vLight))
    : srgb(curve(exposure * (channel == 0 ? vLight : vec3(one(vLight)))));
  vec3 pixels = vWeights / fwidth(vWeights);
  float near = min(pixels.x, min(pixels.y, pixels.z));
  if (wireframe) {
    vec3 line = dot(shown, vec3(0.3, 0.6, 0.1)) > 0.5 ? vec3(0.0) : vec3(1.0);
    shown = mix(shown, line, 0.55 * (1.0 - smoothstep(0.5, 1.2, near)));
  }
  if (vElement == picked) {
    shown = mix(shown, vec3(1.0, 0.35, 0.1), 1.0 - smoothstep(1.5, 2.5, near));
  }
  colour = vec4(shown, 1.0);
  // In its logarithm, depth is as fine far away as it is near, for its distance: lamps hang a millimetre
  // below ceilings.
  gl_FragDepth = log(vDepth / planes.x) / log(planes.y / planes.x);
}`;
