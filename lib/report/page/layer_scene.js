"use strict";
// One run's particles for three.js. Each sphere is a square that faces the eye; its shader casts the ray, so that it is
// round at any distance, hides what lies behind it exactly, and shows a filled face where a cut goes through it.
const sphere_vertex = `
attribute vec3 centre; attribute float radius; attribute vec3 tint; attribute float mark;
varying vec3 v_centre, v_point, v_tint; varying float v_radius, v_mark;
void main() {
  vec3 c = (modelViewMatrix * vec4(centre, 1.0)).xyz;
  float d2 = dot(c, c), far = sqrt(d2 / max(d2 - radius * radius, 1e-6 * d2));
  vec3 w = normalize(c), u = normalize(cross(w, vec3(0.0, 1.0, 0.0))), v = cross(u, w);
  v_centre = c; v_radius = radius; v_tint = tint; v_mark = mark;
  v_point = c + (u * position.x + v * position.y) * radius * far;
  gl_Position = projectionMatrix * vec4(v_point, 1.0);
}`;
const sphere_fragment = `
uniform vec3 cut_low, cut_high; uniform mat4 to_world, projection;
varying vec3 v_centre, v_point, v_tint; varying float v_radius, v_mark;
void main() {
  vec3 ray = normalize(v_point);
  float b = dot(ray, v_centre);
  vec3 away = v_centre - b * ray;
  float disc = v_radius * v_radius - dot(away, away);
  if (disc < 0.0) discard;
  float enter = b - sqrt(disc), leave = b + sqrt(disc);
  vec3 normal = (enter * ray - v_centre) / v_radius;
  vec3 origin = (to_world * vec4(0.0, 0.0, 0.0, 1.0)).xyz, along = (to_world * vec4(ray, 0.0)).xyz;
  float face = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    float step = abs(along[axis]) < 1e-7 ? 1e-7 : along[axis];
    float one = (cut_low[axis] - origin[axis]) / step, two = (cut_high[axis] - origin[axis]) / step;
    float from = min(one, two), to = max(one, two);
    if (from > enter) {
      enter = from; face = 1.0;
      vec3 out_of = vec3(0.0); out_of[axis] = -sign(step);
      normal = normalize((vec4(out_of, 0.0) * to_world).xyz);
    }
    leave = min(leave, to);
  }
  if (enter > leave) discard;
  vec4 clip = projection * vec4(enter * ray, 1.0);
  gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
  vec3 colour = pow(v_tint, vec3(2.2));
  float key = max(dot(normal, normalize(vec3(-0.45, 0.65, 0.75))), 0.0), sky = 0.5 + 0.5 * normal.y;
  float facing = max(dot(normal, -ray), 0.0);
  float light = face > 0.5 ? 0.62 + 0.1 * key : (0.30 + 0.22 * sky + 0.62 * key) * (0.45 + 0.55 * facing);
  colour *= light;
  colour += vec3(0.10) * pow(max(dot(reflect(ray, normal), normalize(vec3(-0.45, 0.65, 0.75))), 0.0), 24.0) * (1.0 - face);
  if (v_mark > 0.5) colour = mix(colour, vec3(1.0, 0.25, 0.05), 0.35 + 0.65 * pow(1.0 - facing, 1.5));
  gl_FragColor = vec4(pow(colour, vec3(1.0 / 2.2)), 1.0);
}`;
const rod_vertex = `
attribute vec3 from, to; attribute vec3 tint; uniform float thickness;
varying vec3 v_tint, v_normal, v_world;
void main() {
  vec3 w = normalize(to - from), u = normalize(cross(w, abs(w.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0))), v = cross(w, u);
  vec3 out_of = u * position.x + v * position.y;
  v_world = mix(from, to, position.z) + out_of * thickness;
  v_normal = (modelViewMatrix * vec4(out_of, 0.0)).xyz; v_tint = tint;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(v_world, 1.0);
}`;
const rod_fragment = `
uniform vec3 cut_low, cut_high; varying vec3 v_tint, v_normal, v_world;
void main() {
  if (any(lessThan(v_world, cut_low)) || any(greaterThan(v_world, cut_high))) discard;
  float light = 0.45 + 0.55 * max(dot(normalize(v_normal), normalize(vec3(-0.45, 0.65, 0.75))), 0.0);
  gl_FragColor = vec4(pow(pow(v_tint, vec3(2.2)) * light, vec3(1.0 / 2.2)), 1.0);
}`;

THREE.ColorManagement.enabled = false;  // colours are the screen's own numbers all the way

const cuts_shared = {cut_low: {value: new THREE.Vector3()}, cut_high: {value: new THREE.Vector3()}};

// A substrate that is not flat, lit once: heights at the corners of an even mesh.
const ground_mesh = ({mesh, heights}, w, d) => {
  const corners = [], colours = [], index = [], row = mesh + 1, light = new THREE.Vector3(-0.45, 0.65, 0.75).normalize();
  const at = (i, j) => heights[i * row + j];
  const near = i => [Math.max(0, i - 1), Math.min(mesh, i + 1)];
  for (let i = 0; i <= mesh; ++i)
    for (let j = 0; j <= mesh; ++j) {
      const [a, b] = near(i), [c, e] = near(j);
      corners.push(w * i / mesh, d * j / mesh, at(i, j));
      const normal = new THREE.Vector3(-(at(b, j) - at(a, j)) * mesh / (w * (b - a)), -(at(i, e) - at(i, c)) * mesh / (d * (e - c)), 1).normalize();
      const shade = 0.55 + 0.45 * Math.max(0, normal.dot(light));
      colours.push(0.82 * shade, 0.77 * shade, 0.69 * shade);
      if (i < mesh && j < mesh) {
        const k = i * row + j;
        index.push(k, k + row, k + 1, k + 1, k + row, k + row + 1);
      }
    }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(corners), 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(colours), 3));
  geometry.setIndex(index);
  return new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({vertexColors: true, side: THREE.DoubleSide}));
};

class LayerScene {
  constructor(data) {
    this.data = data;
    const n = data.count;
    this.scene = new THREE.Scene();
    const square = new THREE.InstancedBufferGeometry();
    square.setAttribute("position", new THREE.BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0]), 3));
    square.setIndex([0, 1, 2, 0, 2, 3]);
    const add = (name, Type, width, normalised) => {
      const attribute = new THREE.InstancedBufferAttribute(new Type(n * width), width, normalised);
      attribute.setUsage(THREE.DynamicDrawUsage);
      square.setAttribute(name, attribute);
      return attribute;
    };
    this.centre = add("centre", Float32Array, 3, false);
    this.radius = add("radius", Float32Array, 1, false);
    this.tint = add("tint", Uint8Array, 3, true);
    this.mark = add("mark", Uint8Array, 1, false);
    square.instanceCount = n;
    const material = new THREE.ShaderMaterial({
      vertexShader: sphere_vertex, fragmentShader: sphere_fragment,
      uniforms: {...cuts_shared, to_world: {value: null}, projection: {value: null}},
    });
    this.spheres = new THREE.Mesh(square, material);
    this.spheres.frustumCulled = false;
    this.spheres.onBeforeRender = (renderer, scene, camera) => {
      material.uniforms.to_world.value = camera.matrixWorld;
      material.uniforms.projection.value = camera.projectionMatrix;
      material.uniformsNeedUpdate = true;
    };
    this.scene.add(this.spheres);

    const sides = 6, ring = [], index = [];
    for (let s = 0; s < sides; ++s)
      for (const end of [0, 1]) ring.push(Math.cos(2 * Math.PI * s / sides), Math.sin(2 * Math.PI * s / sides), end);
    for (let s = 0; s < sides; ++s) {
      const a = 2 * s, b = 2 * ((s + 1) % sides);
      index.push(a, b, a + 1, b, b + 1, a + 1);
    }
    this.rod_shape = {ring: new THREE.BufferAttribute(new Float32Array(ring), 3), index};
    this.rod_material = new THREE.ShaderMaterial({
      vertexShader: rod_vertex, fragmentShader: rod_fragment, side: THREE.DoubleSide,
      uniforms: {...cuts_shared, thickness: {value: 0.05}},
    });
    this.rods = null;

    const [w, d] = data.width;
    this.frame_box = new THREE.LineSegments(new THREE.EdgesGeometry(new THREE.BoxGeometry(1, 1, 1)),
      new THREE.LineBasicMaterial({color: 0x8a94a3}));
    this.scene.add(this.frame_box);
    if (data.substrate) {
      const slab = new THREE.Mesh(new THREE.BoxGeometry(w, d, 0.02 * data.z_top), new THREE.MeshBasicMaterial({color: 0x9b948a}));
      slab.position.set(w / 2, d / 2, -0.01 * data.z_top);
      this.scene.add(slab);
      if (data.ground) this.scene.add(ground_mesh(data.ground, w, d));
    }
    this.surface = new THREE.Mesh(new THREE.PlaneGeometry(w, d),
      new THREE.MeshBasicMaterial({color: 0x4a90d9, transparent: true, opacity: 0.16, side: THREE.DoubleSide, depthWrite: false}));
    this.surface.visible = data.free_surface;
    this.scene.add(this.surface);
    this.trail = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial({color: 0xff5a1f, depthTest: false}));
    this.trail.frustumCulled = false;
    this.scene.add(this.trail);
  }

  // shown(i): is this particle drawn; scale: of the drawn radii.
  place(k, shown, scale) {
    const {data} = this, n = data.count, p = data.positions(k), centre = this.centre.array;
    for (let i = 0; i < n; ++i) {
      centre[3 * i] = p[i], centre[3 * i + 1] = p[n + i], centre[3 * i + 2] = p[2 * n + i];
      this.radius.array[i] = shown(i) ? data.radius[i] * scale : 0;
    }
    this.centre.needsUpdate = this.radius.needsUpdate = true;
    const height = data.heights[k], [w, d] = data.width;
    this.frame_box.scale.set(w, d, height);
    this.frame_box.position.set(w / 2, d / 2, height / 2);
    this.surface.position.set(w / 2, d / 2, height);
  }

  paint(colours) {
    this.tint.array.set(colours);
    this.tint.needsUpdate = true;
  }

  // Rods between connected particles: red where they touch, blue at the threshold.
  connect(k, found, threshold, shown) {
    if (this.rods) {
      this.rods.geometry.dispose();
      this.scene.remove(this.rods);
      this.rods = null;
    }
    if (!found) return;
    const {data} = this, n = data.count, p = data.positions(k), kept = [];
    for (let c = 0; c < found.first.length; ++c) if (shown(found.first[c])) kept.push(c);
    const from = new Float32Array(3 * kept.length), to = new Float32Array(3 * kept.length), tint = new Uint8Array(3 * kept.length);
    kept.forEach((c, at) => {
      for (let axis = 0; axis < 3; ++axis) {
        const a = p[axis * n + found.first[c]];
        from[3 * at + axis] = a;
        to[3 * at + axis] = a + data.near_image(p[axis * n + found.second[c]] - a, axis);
      }
      tint.set(connection_colour(found.gap[c] / threshold), 3 * at);
    });
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute("position", this.rod_shape.ring);
    geometry.setIndex(this.rod_shape.index);
    geometry.setAttribute("from", new THREE.InstancedBufferAttribute(from, 3));
    geometry.setAttribute("to", new THREE.InstancedBufferAttribute(to, 3));
    geometry.setAttribute("tint", new THREE.InstancedBufferAttribute(tint, 3, true));
    geometry.instanceCount = kept.length;
    this.rod_material.uniforms.thickness.value = 0.12 * data.mean_radius;
    this.rods = new THREE.Mesh(geometry, this.rod_material);
    this.rods.frustumCulled = false;
    this.scene.add(this.rods);
  }

  // Marks a particle and draws its way through all frames, -1: none.
  choose(i) {
    this.mark.array.fill(0);
    if (i >= 0) this.mark.array[i] = 1;
    this.mark.needsUpdate = true;
    const {data} = this, n = data.count, way = [];
    for (let k = 0; i >= 0 && k < data.places.length; ++k)
      for (let axis = 0; axis < 3; ++axis) {
        const width = axis < 2 ? data.width[axis] : 0, place = data.places[k][axis * n + i] + 0.5;
        const at = axis < 2 ? place * width / 65536 : data.z_low + place * data.z_step, before = way[way.length - 3];
        way.push(k === 0 ? at : before + data.near_image(at - before, axis));
      }
    this.trail.geometry.dispose();
    this.trail.geometry = new THREE.BufferGeometry();
    this.trail.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(way), 3));
    this.trail.visible = way.length > 3;
  }

  // The shown particle that a ray meets first, or -1.
  hit(origin, direction) {
    const n = this.data.count, low = cuts_shared.cut_low.value, high = cuts_shared.cut_high.value;
    let best = -1, nearest = Infinity;
    const o = [origin.x, origin.y, origin.z], d = [direction.x, direction.y, direction.z];
    let box_in = 0, box_out = Infinity;
    for (let axis = 0; axis < 3; ++axis) {
      const step = Math.abs(d[axis]) < 1e-9 ? 1e-9 : d[axis];
      const one = (low.getComponent(axis) - o[axis]) / step, two = (high.getComponent(axis) - o[axis]) / step;
      box_in = Math.max(box_in, Math.min(one, two)), box_out = Math.min(box_out, Math.max(one, two));
    }
    for (let i = 0; i < n; ++i) {
      const r = this.radius.array[i];
      if (r === 0) continue;
      const x = this.centre.array[3 * i] - o[0], y = this.centre.array[3 * i + 1] - o[1], z = this.centre.array[3 * i + 2] - o[2];
      const b = x * d[0] + y * d[1] + z * d[2], disc = r * r - (x * x + y * y + z * z - b * b);
      if (disc < 0) continue;
      const enter = Math.max(b - Math.sqrt(disc), box_in), leave = Math.min(b + Math.sqrt(disc), box_out);
      if (enter <= leave && enter < nearest) nearest = enter, best = i;
    }
    return best;
  }
}
