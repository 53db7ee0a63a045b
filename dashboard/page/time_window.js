// Which stretch of the run the traces show: the newest seconds, or, held, any of the last ten
// minutes. Holding stops the pictures, not the run, nor its record.

import { newest, oldest } from "./history.js";

const at = (id) => document.getElementById(id);
let held = null;  // end of the stretch [s]; null: the newest
let length = 20;
let changed = () => {};

export const isHeld = () => held !== null;

/** [from, to] in seconds of the run; null before anything came. */
export function timeWindow() {
  const end = newest();
  if (end === null) return null;
  const to = held === null ? end : Math.max(oldest(), Math.min(held, end));
  return [Math.max(to - length, oldest()), to];
}

function show() {
  at("hold").setAttribute("aria-pressed", String(isHeld()));
  at("hold").textContent = isHeld() ? "▶ Live" : "❚❚ Hold";
  document.body.classList.toggle("held", isHeld());
  moveSlider();
  changed();
}

/** The slider spans what is kept; it stands at its end while the newest is shown. */
export function moveSlider() {
  const slider = at("back");
  const [first, last] = [oldest() ?? 0, newest() ?? 0];
  slider.min = first.toFixed(2);
  slider.max = last.toFixed(2);
  slider.value = (held ?? last).toFixed(2);
  const ago = held === null ? 0 : last - held;
  at("ago").textContent = ago < 0.05 ? "now" : `${ago.toFixed(1)} s ago`;
}

export function releaseTime() {
  held = null;
  show();
}

export function wireTime(onChange) {
  changed = onChange;
  at("hold").addEventListener("click", () => {
    held = isHeld() ? null : newest();
    show();
  });
  at("back").addEventListener("input", () => {
    held = Number(at("back").value);
    show();
  });
  at("window").addEventListener("change", () => {
    length = Number(at("window").value);
    changed();
  });
}
