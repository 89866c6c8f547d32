// The light of a solution as the program packs it, little-endian (`frame.rs` writes it).
//
// Bytes: arrays of four-byte numbers, then the header: JSON that names each with its type, offset and
// count. Then the header's length, a u32.

const TYPES = { f32: Float32Array, u32: Uint32Array };
const LITTLE = new Uint8Array(Uint32Array.of(1).buffer)[0] === 1;

/** Bytes of base64 text. */
export function fromBase64(text) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}

/** Reads a packed solution. */
export function decode(buffer) {
  if (!LITTLE) throw new Error('this page needs a little-endian machine');
  const end = buffer.byteLength - 4;
  const length = new DataView(buffer).getUint32(end, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, end - length, length)));
  const arrays = {};
  for (const { name, type, offset, count } of header.arrays) {
    arrays[name] = new TYPES[type](buffer, offset, count);
  }
  return new Light(header, arrays);
}

/** A lit scene: its elements, what they are made of, and the light that leaves them. */
export class Light {
  constructor(header, arrays) {
    Object.assign(this, header, arrays);
    /** How many elements there are. */
    this.count = this.areas.length;
  }

  /** Corner `corner` of an element, in the page's own units. */
  corner(element, corner, into) {
    const at = 3 * this.vertices[3 * element + corner];
    for (let c = 0; c < 3; c++) into[c] = this.positions[at + c];
    return into;
  }

  /** A place of the page in the file's units. */
  toFile(place) {
    return place.map((p, axis) => this.centre[axis] + p * this.scale);
  }

  /** A place of the file in the page's units. */
  fromFile(place) {
    return place.map((p, axis) => (p - this.centre[axis]) / this.scale);
  }

  /** Mean exitance of an element. */
  mean(element) {
    return Array.from(this.exitance.subarray(3 * element, 3 * element + 3));
  }

  /** Exitance at a place of an element, given by its barycentric weights. */
  at(element, weights) {
    return [0, 1, 2].map((channel) =>
      weights.reduce((sum, w, corner) => sum + w * this.cornerExitance[9 * element + 3 * corner + channel], 0));
  }

  /** Area of an element, in the file's unit of length squared. */
  area(element) {
    return this.areas[element] * this.scale * this.scale;
  }

  /** Whether it lies on the back of its triangle. */
  isBack(element) {
    return this.backs[element] !== 0;
  }

  material(element) {
    return this.materials[this.triangleMaterials[this.triangles[element]]];
  }

  group(element) {
    return this.groups[this.triangleGroups[this.triangles[element]]];
  }
}
