"use strict";
// The one time that everything on the page shows: sliders, curves, pictures and the viewer follow it. Milliseconds.
const clock = {
  time: null,
  listeners: [],
  set(time) {
    this.time = time;
    for (const follow of this.listeners) follow(time);
  },
  follow(listener) { this.listeners.push(listener); },
};
const nearest_index = (times, time) => {
  let best = 0;
  times.forEach((t, k) => { if (Math.abs(t - time) < Math.abs(times[best] - time)) best = k; });
  return best;
};
for (const row of document.querySelectorAll(".pictures")) {
  const pictures = [...row.querySelectorAll("[data-time]")], times = pictures.map(p => Number(p.dataset.time));
  if (pictures.length > 1)
    clock.follow(time => pictures.forEach((p, k) => p.classList.toggle("now", k === nearest_index(times, time))));
}
