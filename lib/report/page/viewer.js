"use strict";
// The 3-D viewer: one canvas, one view a run side by side or a single run; drawn when something changed, and only then.
const viewer_controls = `
<div class="tools">
  <label class="runs">run <select data-is="run"></select></label>
  <label>colour <select data-is="colour"></select></label>
  <span class="views"><button type="button" data-view="side">side</button><button type="button" data-view="oblique">oblique</button><button type="button" data-view="top">top</button></span>
  <label>size <input type="range" data-is="scale" min="0.2" max="1" step="0.05" value="1" aria-label="drawn size of the particles"></label>
  <label><input type="checkbox" data-is="clusters_only"> clusters only</label>
  <label>of at least <input type="number" data-is="smallest" min="2" value="2"></label>
  <label><input type="checkbox" data-is="connections"> connections</label>
  <label>closer than <input type="number" data-is="threshold" min="0" step="any"> nm</label>
  <button type="button" data-is="picture">save picture</button>
</div>
<div class="cuts">${["x", "y", "z"].map(axis => `<span class="cut"><b>${axis}</b>
  <input type="range" data-cut="${axis}0" min="0" max="1000" value="0" aria-label="cut ${axis} from"><input type="range" data-cut="${axis}1" min="0" max="1000" value="1000" aria-label="cut ${axis} to"><output></output></span>`).join("")}</div>
<div class="stage"><canvas tabindex="0" aria-label="3-D view of the layer"></canvas><div class="names"></div><div class="picked" hidden></div></div>
<div class="colours"></div><p class="found note"></p>
<label class="slider"><button type="button" data-is="play" aria-label="play">▶</button><input type="range" data-is="time" min="0" step="1" aria-label="time"><output></output></label>`;

class Viewer {
  constructor(figure, context, canvas, runs, palette) {
    this.figure = figure, this.canvas = canvas, this.runs = runs, this.palette = palette;
    this.parts = Object.fromEntries([...figure.querySelectorAll("[data-is]")].map(e => [e.dataset.is, e]));
    this.layers = runs.map(data => new LayerScene(data));
    this.frames = runs.map(data => data.times.length - 1);
    this.longest = runs.reduce((a, b) => (b.times.at(-1) > a.times.at(-1) ? b : a));
    this.picked = {run: 0, i: -1};
    this.coarseness = 1, this.moved_at = -Infinity;
    this.renderer = new THREE.WebGLRenderer({canvas, context, antialias: true});
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setScissorTest(true);
    this.camera = new THREE.PerspectiveCamera(26, 1, 0.1, 1e4);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.draw_soon());
    this.declare_controls();
    this.pick_view("oblique");
    this.show_time(clock.time ?? this.longest.times.at(-1));
    new ResizeObserver(() => this.draw_soon()).observe(canvas.parentElement);
    matchMedia("(prefers-color-scheme:dark)").addEventListener("change", () => this.draw_soon());
  }

  get shown() { return this.parts.run.value === "all" ? this.runs.map((_, r) => r) : [Number(this.parts.run.value)]; }
  get threshold() { return Math.max(0, Number(this.parts.threshold.value) || 0) / 1000; }
  get one() { return this.runs[this.shown[0]]; }

  declare_controls() {
    const {parts, figure, runs} = this, option = (value, text) => new Option(text, value);
    if (runs.length > 1) parts.run.append(option("all", "all, side by side"));
    runs.forEach((data, r) => parts.run.append(option(String(r), data.name || "layer")));
    figure.querySelector(".runs").hidden = runs.length < 2;
    const names = Object.keys(colourings).filter(name => runs.every(data => colourings_of(data).includes(name)));
    for (const name of names) parts.colour.append(option(name, colourings[name].label));
    parts.threshold.value = Number((1000 * runs[0].threshold).toPrecision(4));
    parts.run.addEventListener("change", () => { this.choose(0, -1); this.pick_view(this.view); this.update(); });
    for (const name of ["colour", "smallest", "threshold"]) parts[name].addEventListener("change", () => this.update());
    for (const name of ["clusters_only", "connections", "scale"]) parts[name].addEventListener("input", () => this.update());
    for (const button of figure.querySelectorAll("[data-view]")) button.addEventListener("click", () => this.pick_view(button.dataset.view));
    for (const input of figure.querySelectorAll("[data-cut]")) input.addEventListener("input", () => { this.cut(); this.draw_soon(); });
    const times = this.longest.times;
    parts.time.max = times.length - 1;
    figure.querySelector("label.slider").hidden = times.length < 2;
    parts.time.addEventListener("input", () => clock.set(times[Number(parts.time.value)]));
    parts.play.addEventListener("click", () => this.play());
    parts.picture.addEventListener("click", () => this.save());
    clock.follow(time => this.show_time(time));
    let down = null;
    this.canvas.addEventListener("pointerdown", event => { down = [event.clientX, event.clientY]; });
    this.canvas.addEventListener("pointerup", event => {
      if (down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) this.pick(event);
    });
  }

  show_time(time) {
    this.frames = this.runs.map(data => nearest_index(data.times, time));
    const k = nearest_index(this.longest.times, time);
    this.parts.time.value = k;
    this.figure.querySelector("label.slider output").textContent = this.longest.labels[k];
    this.update();
  }

  play() {
    const last = this.longest.times.length - 1;
    if (this.playing) {
      clearInterval(this.playing);
      this.playing = null;
    } else {
      if (Number(this.parts.time.value) === last) clock.set(this.longest.times[0]);
      this.playing = setInterval(() => {
        const k = Number(this.parts.time.value);
        if (k === last) this.play();
        else clock.set(this.longest.times[k + 1]);
      }, 120);
    }
    this.parts.play.textContent = this.playing ? "❚❚" : "▶";
  }

  // Colours, what is drawn, connections: after a change of time or of a control.
  update() {
    const {parts, shown, threshold} = this, name = parts.colour.value;
    const only = parts.clusters_only.checked, rods = parts.connections.checked;
    const needs = only || rods || name.startsWith("cluster");
    const smallest = Math.max(2, Number(parts.smallest.value) || 2);
    const {colours, legend} = paint_runs(shown.map(r => this.runs[r]), name, shown.map(r => this.frames[r]), threshold, this.palette);
    const words = [];
    shown.forEach((r, at) => {
      const k = this.frames[r], found = needs ? this.runs[r].clusters(k, threshold) : null;
      const visible = only ? i => found.size[i] >= smallest : () => true;
      this.layers[r].place(k, visible, Number(parts.scale.value));
      this.layers[r].paint(colours[at]);
      this.layers[r].connect(k, rods ? found : null, threshold, visible);
      if (found) words.push(`${this.runs.length > 1 ? this.runs[r].name + ": " : ""}${found.number} clusters, ${found.clustered} of ${this.runs[r].count} particles in them, the largest has ${found.largest}; ${found.first.length} connections`);
    });
    show_legend(this.figure.querySelector(".colours"), legend, this.palette);
    this.figure.querySelector(".found").textContent = words.join(". ");
    this.cut();
    this.tell();
    this.draw_soon();
  }

  cut() {
    const size = [Math.max(...this.runs.map(d => d.width[0])), Math.max(...this.runs.map(d => d.width[1])), Math.max(...this.runs.map(d => d.z_top))];
    ["x", "y", "z"].forEach((axis, a) => {
      const [from, to] = [0, 1].map(end => Number(this.figure.querySelector(`[data-cut="${axis}${end}"]`).value));
      // At its end a cut takes nothing away, not even what sticks out of the cell.
      cuts_shared.cut_low.value.setComponent(a, from <= 0 ? -1e4 : from / 1000 * size[a]);
      cuts_shared.cut_high.value.setComponent(a, to >= 1000 ? 1e4 : to / 1000 * size[a]);
      this.figure.querySelectorAll(".cut output")[a].textContent = `${round_number(from / 1000 * size[a])} to ${round_number(to / 1000 * size[a])} µm`;
    });
  }

  pick_view(view) {
    this.view = view;
    const {width: [w, d], z_top: h} = this.one, count = this.shown.length, columns = Math.min(count, 4);
    const [wide, high] = [this.canvas.clientWidth / columns || 1, this.canvas.clientHeight / Math.ceil(count / columns) || 1];
    const angle = {side: [-90, 2], oblique: [-58, 24], top: [-90, 89.9]}[view].map(a => a * Math.PI / 180);
    const target = new THREE.Vector3(w / 2, d / 2, h / 2);
    const away = new THREE.Vector3(Math.cos(angle[0]) * Math.cos(angle[1]), Math.sin(angle[0]) * Math.cos(angle[1]), Math.sin(angle[1]));
    const [across, up] = view === "top" ? [w, d] : [view === "side" ? w : 0.85 * w + 0.55 * d, view === "side" ? h : h + 0.4 * Math.max(w, d)];
    const tan = Math.tan(13 * Math.PI / 180), depth = view === "top" ? h : d;
    const distance = 1.06 * Math.max(up / 2 / tan, across / 2 / tan / (wide / high)) + depth / 2;
    this.camera.position.copy(target).addScaledVector(away, distance);
    this.camera.near = distance / 100;
    this.camera.far = distance * 10;
    this.controls.target.copy(target);
    this.controls.update();
    this.draw_soon();
  }

  // Where each shown run is drawn, in CSS pixels from the lower left.
  panes() {
    const count = this.shown.length, columns = Math.min(count, 4), rows = Math.ceil(count / columns);
    const [w, h] = [this.canvas.clientWidth / columns, this.canvas.clientHeight / rows];
    return this.shown.map((r, at) => ({r, x: (at % columns) * w, y: (rows - 1 - Math.floor(at / columns)) * h, w, h}));
  }

  // While it moves at most at the screen's pixels, coarser where the machine does not keep up; then once finely: twice the
  // screen's pixels, for smooth edges.
  draw_soon() {
    this.changed_at = (this.changed_at ?? 0) + 1;
    if (!this.waiting) this.waiting = requestAnimationFrame(now => {
      this.waiting = null;
      const since = now - this.moved_at;
      this.moved_at = now;
      if (since < 1500) this.coarseness = Math.min(1, Math.max(0.25, this.coarseness * (since > 70 ? 0.75 : since < 25 ? 1.2 : 1)));
      this.draw(this.coarseness);
    });
    clearTimeout(this.settled);
    this.settled = setTimeout(() => {
      this.draw(2);
      this.settled_at = this.changed_at;
    }, 160);
  }

  draw(fineness) {
    const stage = this.canvas.parentElement, w = stage.clientWidth, h = stage.clientHeight;
    if (!w || !h) return;
    this.renderer.setPixelRatio(Math.min(4, fineness * devicePixelRatio));
    this.renderer.setSize(w, h, false);
    const paper = getComputedStyle(stage).backgroundColor.match(/[\d.]+/g).slice(0, 3).map(v => v / 255);
    for (const {r, x, y, w: width, h: height} of this.panes()) {
      this.layers[r].scene.background = new THREE.Color(...paper);
      this.renderer.setViewport(x, y, width, height);
      this.renderer.setScissor(x, y, width, height);
      this.camera.aspect = width / height;
      this.camera.updateProjectionMatrix();
      this.renderer.render(this.layers[r].scene, this.camera);
    }
    const names = stage.querySelector(".names");
    names.replaceChildren(...(this.runs.length < 2 ? [] : this.panes().map(p => {
      const e = document.createElement("span");
      e.textContent = this.runs[p.r].name + (this.runs[p.r].times.length > 1 ? ", " + this.runs[p.r].labels[this.frames[p.r]] : "");
      e.style.left = p.x + 10 + "px", e.style.top = this.canvas.clientHeight - p.y - p.h + 8 + "px";
      return e;
    })));
  }

  pick(event) {
    const box = this.canvas.getBoundingClientRect(), x = event.clientX - box.left, y = box.bottom - event.clientY;
    for (const p of this.panes()) {
      if (x < p.x || x >= p.x + p.w || y < p.y || y >= p.y + p.h) continue;
      this.camera.aspect = p.w / p.h;
      this.camera.updateProjectionMatrix();
      const far = new THREE.Vector3(2 * (x - p.x) / p.w - 1, 2 * (y - p.y) / p.h - 1, 0.5).unproject(this.camera);
      const i = this.layers[p.r].hit(this.camera.position, far.sub(this.camera.position).normalize());
      this.choose(p.r, i);
    }
  }

  choose(run, i) {
    this.picked = {run, i};
    this.layers.forEach((layer, r) => layer.choose(r === run ? i : -1));
    this.tell();
    this.draw_soon();
  }

  // The numbers of the picked particle.
  tell() {
    const {run, i} = this.picked, box = this.figure.querySelector(".picked"), data = this.runs[run], k = this.frames[run];
    box.hidden = i < 0;
    if (i < 0) return;
    const n = data.count, p = data.positions(k), found = data.clusters(k, this.threshold), row = v => v.map(round_number).join(", ");
    const lines = [["particle", data.id[i]], ["diameter", round_number(2 * data.radius[i]) + " µm"]];
    if (data.species.length) lines.push(["species", data.species[data.species_of[i]]]);
    lines.push(["position", row([p[i], p[n + i], p[2 * n + i]]) + " µm"]);
    if (data.velocity) {
      const v = data.velocity_of(k, i);
      lines.push(["velocity", row(v) + " µm/s"], ["speed", round_number(Math.hypot(...v)) + " µm/s"]);
    }
    if (data.run_speed) lines.push(["over the run", round_number(data.run_speed[i]) + " µm/s"]);
    lines.push(["cluster", found.size[i] > 1 ? `of ${found.size[i]} particles` : "alone"]);
    box.replaceChildren(...lines.flatMap(([name, value]) => {
      const dt = document.createElement("dt"), dd = document.createElement("dd");
      dt.textContent = name, dd.textContent = value;
      return [dt, dd];
    }));
  }

  save() {
    this.draw(2);
    const link = document.createElement("a");
    link.download = "layer.png";
    link.href = this.canvas.toDataURL("image/png");
    link.click();
  }
}

const start_viewer = async figure => {
  const apology = text => { figure.querySelector(".viewer-missing").textContent = text; figure.classList.add("missing"); figure.hidden = false; };
  const body = figure.querySelector(".viewer-body");
  const canvas_there = document.createElement("canvas").getContext("webgl2") !== null;
  if (!canvas_there) return apology("This browser shows no WebGL 2, which the interactive view needs. The pictures of this page show the layer.");
  if (typeof DecompressionStream === "undefined") return apology("This browser is too old for the interactive view. The pictures of this page show the layer.");
  figure.hidden = false;
  body.innerHTML = viewer_controls;
  const {runs, scale, tints, alone} = JSON.parse(figure.querySelector(".layers").textContent);
  const palette = {scale: scale.map(rgb_of), tints: tints.map(rgb_of), alone: rgb_of(alone)};
  const packed = [...figure.querySelectorAll(".packed")];
  const data = await Promise.all(runs.map((meta, r) => LayerData.unpack(meta, packed[r].textContent)));
  packed.forEach(e => e.remove());
  const canvas = body.querySelector("canvas"), context = canvas.getContext("webgl2", {antialias: true});
  figure.viewer = new Viewer(figure, context, canvas, data, palette);
  figure.dataset.ready = "yes";
};
for (const figure of document.querySelectorAll("figure.viewer")) start_viewer(figure);
