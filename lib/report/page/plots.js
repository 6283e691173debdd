"use strict";
const sliders = [];
for (const figure of document.querySelectorAll("figure.plot")) {
  const data = JSON.parse(figure.querySelector("script[type='application/json']").textContent);
  const svg = figure.querySelector("svg"), hover = svg.querySelector(".hover"), tip = figure.querySelector(".tip");
  const slider = figure.querySelector(".slider input"), output = figure.querySelector(".slider output");
  const fixed = data.series.length, off = new Set();
  let frame = data.frames.length - 1;

  const place = (axis, v) => {
    const t = axis.log ? Math.log(Math.max(v, axis.low / 1e3) / axis.low) / Math.log(axis.high / axis.low) : (v - axis.low) / (axis.high - axis.low);
    return axis.begin + t * (axis.end - axis.begin);
  };
  const value = (axis, p) => {
    const t = (p - axis.begin) / (axis.end - axis.begin);
    return axis.log ? axis.low * Math.pow(axis.high / axis.low, t) : axis.low + t * (axis.high - axis.low);
  };
  const text = (v, axis) => {
    if (v === null || v === undefined) return "–";
    const size = Math.abs(v);
    const number = v === 0 ? "0" : size >= 1e6 || size < 1e-3 ? v.toExponential(2) : String(Number(v.toPrecision(4)));
    return number.replace("-", "−") + (axis.unit ? " " + axis.unit : "");
  };
  const all = () => frame < 0 ? data.series : data.series.concat(data.frames[frame].series);
  const group = i => svg.querySelector(`g[data-series="${i}"]`);

  const path = s => {
    let d = "", down = false;
    for (let i = 0; i < s.y.length; ++i) {
      if (s.y[i] === null) { down = false; continue; }
      const x = place(data.x, s.x[i]).toFixed(2), y = place(data.y, s.y[i]).toFixed(2);
      if (s.steps) d += (down ? "V" + y : `M${x} ${y}`) + "H" + place(data.x, s.x[i + 1]).toFixed(2);
      else d += (down ? "L" : "M") + x + " " + y;
      down = true;
    }
    return d;
  };
  const clear = () => { hover.replaceChildren(); tip.hidden = true; };

  for (const key of figure.querySelectorAll(".key"))
    key.addEventListener("click", () => {
      const i = Number(key.dataset.series), shown = off.delete(i);
      if (!shown) off.add(i);
      key.setAttribute("aria-pressed", String(shown));
      group(i).classList.toggle("off", !shown);
      clear();
    });

  // Sliders over the same times move together.
  if (slider) {
    const times = data.frames.map(f => f.label).join();
    const go_to = k => {
      frame = k;
      slider.value = k;
      output.textContent = data.frames[k].label;
      data.frames[k].series.forEach((s, i) => group(fixed + i).querySelector(".line").setAttribute("d", path(s)));
      clear();
    };
    sliders.push({times, go_to});
    slider.addEventListener("input", () => sliders.filter(s => s.times === times).forEach(s => s.go_to(Number(slider.value))));
  }

  const draw = (name, attributes) => {
    const element = document.createElementNS(svg.namespaceURI, name);
    for (const [k, v] of Object.entries(attributes)) element.setAttribute(k, v);
    hover.append(element);
  };
  const by = data.byHeight ? "y" : "x", other = data.byHeight ? "x" : "y";
  const middles = s => s.steps && by === "x" ? s.y.map((_, i) => (s.x[i] + s.x[i + 1]) / 2) : s[by];
  // The points nearest to the wanted place along the axis that is read, one a visible series.
  const show = at => {
    clear();
    const series = all(), picks = [];
    let nearest = null;
    series.forEach((s, i) => {
      if (off.has(i) || !s.y.length) return;
      const along = middles(s);
      let best = -1, distance = Infinity;
      for (let k = 0; k < along.length; ++k) {
        if (s.y[k] === null || s.y[k] === undefined) continue;
        const d = Math.abs(place(data[by], along[k]) - at);
        if (d < distance) { distance = d; best = k; }
      }
      if (best < 0) return;
      picks.push({s, i, k: best, along: along[best], distance});
      if (nearest === null || distance < nearest.distance) nearest = picks[picks.length - 1];
    });
    if (!nearest) return;
    const p = place(data[by], nearest.along);
    draw("path", {class: "cross", d: by === "x" ? `M${p} ${data.y.begin}V${data.y.end}` : `M${data.x.begin} ${p}H${data.x.end}`});
    const head = document.createElement("b");
    head.textContent = `${data[by].label} ${text(nearest.along, data[by])}`;
    tip.replaceChildren(head);
    for (const pick of picks) {
      if (pick.distance > nearest.distance + 24) continue;
      const colour = getComputedStyle(group(pick.i)).color, v = pick.s[other][pick.k];
      draw("circle", {class: "pick", r: 4.5, fill: colour, cx: place(data.x, by === "x" ? pick.along : v), cy: place(data.y, by === "x" ? v : pick.along)});
      const row = document.createElement("span"), dot = document.createElement("i"), number = document.createElement("b");
      dot.style.background = colour;
      number.textContent = text(v, data[other]);
      row.append(dot, pick.s.name || data[other].label, number);
      tip.append(row);
    }
    tip.hidden = false;
    const box = svg.getBoundingClientRect(), scale = box.width / svg.viewBox.baseVal.width;
    const x = (by === "x" ? p : (data.x.begin + data.x.end) / 2) * scale, y = by === "y" ? p * scale : 8;
    const left = by === "x" ? (x + 14 + tip.offsetWidth > box.width ? x - 14 - tip.offsetWidth : x + 14) : box.width - tip.offsetWidth - 12;
    tip.style.left = Math.max(0, left) + "px";
    tip.style.top = Math.max(0, Math.min(by === "y" ? y + 10 : y, box.height - tip.offsetHeight)) + "px";
  };
  svg.addEventListener("pointermove", event => {
    const box = svg.getBoundingClientRect(), scale = svg.viewBox.baseVal.width / box.width;
    show(by === "x" ? (event.clientX - box.left) * scale : (event.clientY - box.top) * scale);
  });
  svg.addEventListener("pointerleave", clear);
  svg.addEventListener("blur", clear);
  let key_place = null;
  svg.addEventListener("keydown", event => {
    const step = {ArrowLeft: -8, ArrowRight: 8, ArrowUp: -8, ArrowDown: 8}[event.key];
    if (event.key === "Escape") { key_place = null; clear(); }
    if (step === undefined) return;
    event.preventDefault();
    const axis = data[by], low = Math.min(axis.begin, axis.end), high = Math.max(axis.begin, axis.end);
    key_place = Math.min(high, Math.max(low, (key_place ?? (low + high) / 2) + step));
    show(key_place);
  });
}
