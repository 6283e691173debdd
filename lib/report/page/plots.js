"use strict";
// Plots: values under the pointer, a legend that switches curves, zoom by dragging, frames and a time line that follow the
// page's clock. The drawing itself stands in the page; this script adds to it.
const plot_ticks = (axis, wanted) => {
  const {low, high} = axis, out = [];
  if (axis.log && high / low > 12) {
    const factors = high / low > 1e4 ? [1] : [1, 2, 5];
    for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
      for (const f of factors) if (f * 10 ** e >= low && f * 10 ** e <= high) out.push(f * 10 ** e);
    return out;
  }
  const rough = (high - low) / wanted, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map(f => f * power).find(s => s >= rough * 0.999);
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) out.push(k * step);
  return out;
};

for (const figure of document.querySelectorAll("figure.plot")) {
  const data = JSON.parse(figure.querySelector("script[type='application/json']").textContent);
  const svg = figure.querySelector("svg"), hover = svg.querySelector(".hover"), tip = figure.querySelector(".tip");
  const slider = figure.querySelector(".slider input"), output = figure.querySelector(".slider output");
  const curves = svg.querySelector(".curves"), ticks = svg.querySelector(".ticks");
  const drawn = {x: {...data.x}, y: {...data.y}};  // the ranges that the curves were drawn for
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
  const element = (name, attributes, parent, content) => {
    const e = document.createElementNS(svg.namespaceURI, name);
    for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
    if (content !== undefined) e.textContent = content;
    parent.append(e);
    return e;
  };

  const path = s => {
    let d = "", down = false;
    for (let i = 0; i < s.y.length; ++i) {
      if (s.y[i] === null) { down = false; continue; }
      const x = place(drawn.x, s.x[i]).toFixed(2), y = place(drawn.y, s.y[i]).toFixed(2);
      if (s.steps) d += (down ? "V" + y : `M${x} ${y}`) + "H" + place(drawn.x, s.x[i + 1]).toFixed(2);
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

  if (slider) {
    const times = data.frames.map(f => f.time);
    clock.follow(time => {
      const k = nearest_index(times, time);
      if (k === frame && Number(slider.value) === k) return;
      frame = k;
      slider.value = k;
      output.textContent = data.frames[k].label;
      data.frames[k].series.forEach((s, i) => group(fixed + i).querySelector(".line").setAttribute("d", path(s)));
      clear();
    });
    slider.addEventListener("input", () => clock.set(times[Number(slider.value)]));
  }
  // The page's time, on plots against time.
  const now = data.x.perMillisecond ? element("path", {class: "now"}, svg) : null;
  const show_now = () => {
    if (!now || clock.time === null) return;
    const p = place(data.x, clock.time * data.x.perMillisecond);
    now.setAttribute("d", p >= data.x.begin - 0.5 && p <= data.x.end + 0.5 ? `M${p} ${data.y.begin}V${data.y.end}` : "");
  };
  clock.follow(show_now);

  // Zoom: the curves are moved and stretched, numbers and grid are set anew.
  const reset = document.createElement("button");
  reset.type = "button", reset.className = "unzoom", reset.textContent = "whole plot", reset.hidden = true;
  figure.querySelector(".canvas").append(reset);
  const zoom_to = (x_range, y_range) => {
    [data.x.low, data.x.high] = x_range, [data.y.low, data.y.high] = y_range;
    const map = axis => {
      const a = place(drawn[axis], data[axis].low), b = place(drawn[axis], data[axis].high), scale = (data[axis].end - data[axis].begin) / (b - a);
      return [scale, data[axis].begin - a * scale];
    };
    const [sx, tx] = map("x"), [sy, ty] = map("y");
    curves.setAttribute("transform", `matrix(${sx} 0 0 ${sy} ${tx} ${ty})`);
    for (const marker of svg.querySelectorAll(".marker-group")) {
      const at = Number(marker.dataset.at), upright = !data.byHeight, to = upright ? at * sx + tx : at * sy + ty;
      const [low, high] = upright ? [data.x.begin, data.x.end] : [data.y.end, data.y.begin];
      marker.setAttribute("transform", upright ? `translate(${to - at} 0)` : `translate(0 ${to - at})`);
      marker.classList.toggle("off", to < low - 1 || to > high + 1);
    }
    ticks.replaceChildren();
    for (const [name, wanted] of [["x", 6], ["y", 5]]) {
      const axis = data[name], values = plot_ticks(axis, wanted), digits = values.length > 1 ? Math.abs(values[1] - values[0]) / 10 ** axis.exponent : 1;
      for (const v of values) {
        const p = place(axis, v), shown = v / 10 ** axis.exponent;
        const label = (axis.log && axis.high / axis.low > 12 ? String(Number(shown.toPrecision(3))) : shown.toFixed(Math.min(12, Math.max(0, Math.ceil(-Math.log10(digits) - 1e-9) + (String(digits / 10 ** Math.floor(Math.log10(digits))).startsWith("2.5") ? 1 : 0))))).replace("-", "−");
        if (name === "x") {
          element("path", {class: "grid", d: `M${p} ${data.y.begin}V${data.y.end}`}, ticks);
          element("text", {class: "tick", x: p, y: data.y.begin + 18, "text-anchor": "middle"}, ticks, label);
        } else {
          element("path", {class: "grid", d: `M${data.x.begin} ${p}H${data.x.end}`}, ticks);
          element("text", {class: "tick", x: data.x.begin - 8, y: p + 4, "text-anchor": "end"}, ticks, label);
        }
      }
    }
    reset.hidden = ["x", "y"].every(a => data[a].low === drawn[a].low && data[a].high === drawn[a].high);
    show_now();
    clear();
  };
  const whole = () => zoom_to([drawn.x.low, drawn.x.high], [drawn.y.low, drawn.y.high]);
  reset.addEventListener("click", whole);
  svg.addEventListener("dblclick", whole);
  const at_pointer = event => {
    const box = svg.getBoundingClientRect(), scale = svg.viewBox.baseVal.width / box.width;
    return [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
  };
  let start = null, frame_box = null;
  const chosen = to => {  // a thin rectangle means one direction only
    const [x0, x1] = [start[0], to[0]].sort((a, b) => a - b), [y0, y1] = [start[1], to[1]].sort((a, b) => a - b);
    const inside = (v, a, b) => Math.min(Math.max(v, Math.min(a, b)), Math.max(a, b));
    const x = x1 - x0 < 14 ? [data.x.begin, data.x.end] : [x0, x1].map(v => inside(v, data.x.begin, data.x.end));
    const y = y1 - y0 < 14 ? [data.y.begin, data.y.end] : [y1, y0].map(v => inside(v, data.y.begin, data.y.end));
    return {x, y, enough: x1 - x0 >= 14 || y1 - y0 >= 14};
  };
  svg.addEventListener("pointerdown", event => {
    if (event.button !== 0 || event.pointerType === "touch") return;
    start = at_pointer(event);
    svg.setPointerCapture(event.pointerId);
    event.preventDefault();
  });
  svg.addEventListener("pointerup", event => {
    if (!start) return;
    const {x, y, enough} = chosen(at_pointer(event));
    start = null;
    frame_box?.remove();
    frame_box = null;
    if (enough && x[1] !== x[0] && y[1] !== y[0]) zoom_to(x.map(p => value(data.x, p)), y.map(p => value(data.y, p)));
  });

  const by = data.byHeight ? "y" : "x", other = data.byHeight ? "x" : "y";
  const middles = s => s.steps && by === "x" ? s.y.map((_, i) => (s.x[i] + s.x[i + 1]) / 2) : s[by];
  const within = (axis, p) => p >= Math.min(axis.begin, axis.end) - 2 && p <= Math.max(axis.begin, axis.end) + 2;
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
    if (!nearest || !within(data[by], place(data[by], nearest.along))) return;
    const p = place(data[by], nearest.along);
    element("path", {class: "cross", d: by === "x" ? `M${p} ${data.y.begin}V${data.y.end}` : `M${data.x.begin} ${p}H${data.x.end}`}, hover);
    const head = document.createElement("b");
    head.textContent = `${data[by].label} ${text(nearest.along, data[by])}`;
    tip.replaceChildren(head);
    for (const pick of picks) {
      if (pick.distance > nearest.distance + 24) continue;
      const colour = getComputedStyle(group(pick.i)).color, v = pick.s[other][pick.k];
      const cx = place(data.x, by === "x" ? pick.along : v), cy = place(data.y, by === "x" ? v : pick.along);
      if (within(data.x, cx) && within(data.y, cy)) element("circle", {class: "pick", r: 4.5, fill: colour, cx, cy}, hover);
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
    const [x, y] = at_pointer(event);
    if (start) {
      clear();
      const c = chosen([x, y]);
      frame_box ??= element("rect", {class: "zoom-box"}, svg);
      const [top, bottom] = [Math.min(...c.y), Math.max(...c.y)];
      for (const [k, v] of Object.entries({x: c.x[0], y: top, width: c.x[1] - c.x[0], height: bottom - top})) frame_box.setAttribute(k, v);
    } else show(by === "x" ? x : y);
  });
  svg.addEventListener("pointerleave", clear);
  svg.addEventListener("blur", clear);
  let key_place = null;
  svg.addEventListener("keydown", event => {
    const step = {ArrowLeft: -8, ArrowRight: 8, ArrowUp: -8, ArrowDown: 8}[event.key];
    if (event.key === "Escape") { key_place = null; clear(); whole(); }
    if (step === undefined) return;
    event.preventDefault();
    const axis = data[by], low = Math.min(axis.begin, axis.end), high = Math.max(axis.begin, axis.end);
    key_place = Math.min(high, Math.max(low, (key_place ?? (low + high) / 2) + step));
    show(key_place);
  });
}
