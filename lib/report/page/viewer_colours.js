"use strict";
// From what is known of the particles to colours, and the legend that explains them.
const rgb_of = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16));
const connection_colour = t => {
  const near = [205, 32, 38], far = [38, 84, 200], w = Math.min(1, Math.max(0, t));
  return near.map((v, c) => Math.round(v + w * (far[c] - v)));
};
const round_number = v => v === 0 ? "0" : (Math.abs(v) >= 1e5 || Math.abs(v) < 1e-3 ? v.toExponential(1) : String(Number(v.toPrecision(3)))).replace("-", "−");
const percentile = (sorted, share) => sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] : 0;

const colourings = {
  size: {label: "diameter", unit: "µm"},
  species: {label: "species"},
  height: {label: "height", unit: "µm"},
  velocity: {label: "speed in this frame", unit: "µm/s"},
  run_velocity: {label: "speed over the whole run", unit: "µm/s"},
  cluster_size: {label: "particles in the cluster"},
  cluster: {label: "cluster, each its own colour"},
};
const colourings_of = data => Object.keys(colourings).filter(name =>
  name === "species" ? data.species.length > 1 : name === "velocity" ? data.velocity : name === "run_velocity" ? data.run_speed !== null : true);

// The values of one colouring in frame k; logarithmic where they span decades.
const values_of = (data, name, k, threshold) => {
  const n = data.count;
  if (name === "size") return {values: data.radius.map(a => 2 * a), log: true};
  if (name === "height") return {values: data.positions(k).subarray(2 * n, 3 * n), low: 0, high: data.z_top};
  if (name === "velocity") return {values: data.speeds(k), log: true, usual: true};
  if (name === "run_velocity") return {values: data.run_speed, log: true, usual: true};
  const {size, largest} = data.clusters(k, threshold);
  return {values: size, log: true, low: 1, high: Math.max(2, largest)};
};

// All runs shown share one scale. Returns colours (3 bytes a particle) one a run, and a legend.
const paint_runs = (runs, name, frames, threshold, palette) => {
  const {scale, tints, alone} = palette;
  if (name === "species" || name === "cluster") {
    const colours = runs.map((data, r) => {
      const out = new Uint8Array(3 * data.count), found = name === "cluster" ? data.clusters(frames[r], threshold) : null;
      for (let i = 0; i < data.count; ++i)
        out.set(found ? (found.size[i] > 1 ? tints[(found.id[i] * 7 + (found.id[i] >> 3)) % tints.length] : alone) : tints[data.species_of[i] % tints.length], 3 * i);
      return out;
    });
    const names = name === "species" ? runs[0].species : [];
    return {colours, legend: {label: colourings[name].label, names: names.map((text, i) => ({text, colour: tints[i % tints.length]}))}};
  }
  const all = runs.map((data, r) => values_of(data, name, frames[r], threshold));
  let low = Infinity, high = -Infinity;
  for (const one of all) {
    const sorted = Float64Array.from(one.values).sort(), positive = one.log ? sorted.filter(v => v > 0) : sorted;
    low = Math.min(low, one.low ?? percentile(positive, one.usual ? 0.02 : 0));
    high = Math.max(high, one.high ?? percentile(positive, one.usual ? 0.98 : 1));
  }
  if (!(high > low)) high = low + (low ? 0.01 * Math.abs(low) : 1);
  const log = all[0].log && low > 0;
  const position = v => Math.min(1, Math.max(0, log ? Math.log(Math.max(v, low) / low) / Math.log(high / low) : (v - low) / (high - low)));
  const colours = runs.map((data, r) => {
    const out = new Uint8Array(3 * data.count), {values} = all[r];
    for (let i = 0; i < data.count; ++i)
      out.set(name === "cluster_size" && values[i] <= 1 ? alone : scale[Math.round(position(values[i]) * (scale.length - 1))], 3 * i);
    return out;
  });
  const marks = [0, 0.5, 1].map(at => ({at, text: round_number(log ? low * (high / low) ** at : low + at * (high - low))}));
  return {colours, legend: {label: colourings[name].label + (colourings[name].unit ? ` (${colourings[name].unit})` : ""), marks}};
};

const show_legend = (element, legend, palette) => {
  const make = (tag, text, style) => {
    const e = document.createElement(tag);
    if (text) e.textContent = text;
    Object.assign(e.style, style ?? {});
    return e;
  };
  element.replaceChildren(make("span", legend.label));
  for (const {text, colour} of legend.names ?? []) {
    const tint = make("span");
    tint.className = "tint";
    tint.append(make("i", "", {background: `rgb(${colour})`}), text);
    element.append(tint);
  }
  if (legend.marks) {
    const bar = make("div");
    bar.className = "bar";
    bar.append(make("i", "", {background: `linear-gradient(90deg,${palette.scale.map(c => `rgb(${c})`).join()})`}));
    for (const {at, text} of legend.marks) bar.append(make("span", text, {left: `${100 * at}%`}));
    element.append(bar);
  }
};
