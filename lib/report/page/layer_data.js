"use strict";
// Particles of one run, unpacked from the page: see lib/report/viewer_data.h for the layout.
const bytes_of_base64 = text => {
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
};
const inflate = async bytes =>
  new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());

// Every half-precision number (IEEE 754 binary16).
const half_numbers = new Float32Array(65536);
for (let h = 0; h < 65536; ++h) {
  const exponent = h >> 10 & 31, fraction = h & 1023, sign = h & 32768 ? -1 : 1;
  half_numbers[h] = sign * (exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15));
}

class LayerData {
  constructor(meta) { Object.assign(this, meta); }

  static async unpack(meta, text) {
    const data = new LayerData(meta), bytes = await inflate(bytes_of_base64(text)), n = meta.count;
    let at = 0;
    const view = (Type, length) => {
      const out = new Type(bytes.slice(at, at + length * Type.BYTES_PER_ELEMENT).buffer);
      at += length * Type.BYTES_PER_ELEMENT;
      return out;
    };
    // Low bytes of all numbers, then their high bytes.
    const words = length => {
      const out = new Uint16Array(length);
      for (let i = 0; i < length; ++i) out[i] = bytes[at + i] | bytes[at + length + i] << 8;
      at += 2 * length;
      return out;
    };
    data.id = view(Float64Array, n);
    data.radius = view(Float32Array, n);
    data.run_speed = meta.run_speed ? view(Float32Array, n) : null;
    data.species_of = view(Uint8Array, n);
    data.places = [];
    data.velocities = [];
    for (let k = 0; k < meta.times.length; ++k) {
      const places = words(3 * n), before = data.places[k - 1];
      if (before) for (let i = 0; i < 3 * n; ++i) places[i] += before[i];
      data.places.push(places);
      if (meta.velocity) data.velocities.push(words(3 * n));
    }
    data.cache = new Map();
    return data;
  }

  // Centres, um: x of all, y of all, z of all; x and y inside the cell.
  positions(k) {
    if (this.positions_at === k) return this.positions_now;
    const n = this.count, out = new Float32Array(3 * n), places = this.places[k];
    const low = [0, 0, this.z_low], step = [this.width[0] / 65536, this.width[1] / 65536, this.z_step];
    for (let axis = 0; axis < 3; ++axis)
      for (let i = axis * n; i < (axis + 1) * n; ++i) out[i] = low[axis] + (places[i] + 0.5) * step[axis];
    this.positions_at = k;
    return this.positions_now = out;
  }
  // um/s
  velocity_of(k, i) { return [0, 1, 2].map(axis => half_numbers[this.velocities[k][axis * this.count + i]]); }
  speeds(k) {
    const out = new Float32Array(this.count);
    for (let i = 0; i < this.count; ++i) out[i] = Math.hypot(...this.velocity_of(k, i));
    return out;
  }

  // Nearest periodic image of a separation.
  near_image(d, axis) { return axis < 2 ? d - this.width[axis] * Math.round(d / this.width[axis]) : d; }

  // Pairs whose surfaces are closer than the threshold (um), and the clusters they make. id: the first of each cluster's
  // particles; size: particles in it.
  clusters(k, threshold) {
    const key = k + ":" + threshold;
    if (this.cache.has(key)) return this.cache.get(key);
    if (this.cache.size > 8) this.cache.clear();
    const n = this.count, p = this.positions(k), [width_x, width_y] = this.width, radius = this.radius;
    let most = 0, top = -Infinity, bottom = Infinity;
    for (let i = 0; i < n; ++i) {
      most = Math.max(most, radius[i]);
      top = Math.max(top, p[2 * n + i]), bottom = Math.min(bottom, p[2 * n + i]);
    }
    const reach = 2 * most + threshold, count = w => Math.max(1, Math.floor(w / reach));
    const cells = [count(width_x), count(width_y), count(top - bottom + 1e-9)];
    const cell_of = (v, w, c) => Math.min(c - 1, Math.max(0, Math.floor(v / w * c)));
    const head = new Int32Array(cells[0] * cells[1] * cells[2]).fill(-1), next = new Int32Array(n);
    const place = i => [cell_of(p[i], width_x, cells[0]), cell_of(p[n + i], width_y, cells[1]),
      cell_of(p[2 * n + i] - bottom, top - bottom + 1e-9, cells[2])];
    const parent = new Int32Array(n).map((_, i) => i);
    const root = i => {
      while (parent[i] !== i) i = parent[i] = parent[parent[i]];
      return i;
    };
    const first = [], second = [], gap = [];
    const around = (c, cells_there, periodic) => {
      const out = new Set();
      for (let d = -1; d <= 1; ++d) {
        const at = c + d;
        if (periodic) out.add((at + cells_there) % cells_there);
        else if (at >= 0 && at < cells_there) out.add(at);
      }
      return out;
    };
    for (let i = 0; i < n; ++i) {  // each particle meets those put into the cells before it
      const [cx, cy, cz] = place(i);
      for (const z of around(cz, cells[2], false))
        for (const y of around(cy, cells[1], true))
          for (const x of around(cx, cells[0], true))
            for (let j = head[(z * cells[1] + y) * cells[0] + x]; j >= 0; j = next[j]) {
              const touch = radius[i] + radius[j] + threshold, dz = p[2 * n + j] - p[2 * n + i];
              if (Math.abs(dz) >= touch) continue;
              const dx = this.near_image(p[j] - p[i], 0), dy = this.near_image(p[n + j] - p[n + i], 1);
              const square = dx * dx + dy * dy + dz * dz;
              if (square >= touch * touch) continue;
              first.push(j), second.push(i), gap.push(Math.sqrt(square) - radius[i] - radius[j]);
              const a = root(i), b = root(j);
              if (a !== b) parent[Math.max(a, b)] = Math.min(a, b);
            }
      const cell = (cz * cells[1] + cy) * cells[0] + cx;
      next[i] = head[cell], head[cell] = i;
    }
    const id = new Int32Array(n), size = new Int32Array(n);
    for (let i = 0; i < n; ++i) id[i] = root(i);
    const members = new Int32Array(n);
    for (let i = 0; i < n; ++i) ++members[id[i]];
    for (let i = 0; i < n; ++i) size[i] = members[id[i]];
    const clustered = size.reduce((sum, s) => sum + (s > 1), 0), largest = n ? size.reduce((a, b) => Math.max(a, b), 0) : 0;
    const number = members.reduce((sum, m) => sum + (m > 1), 0);
    const found = {id, size, first, second, gap, clustered, largest, number};
    this.cache.set(key, found);
    return found;
  }
}
