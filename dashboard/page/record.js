// Record: what the traces show of a stretch of time, as a CSV file in SI units, with the markers.
//
// 25 ms a row, least and most of each channel: enough to see what happened. Every cycle is what
// amb run --record keeps, and, of a moment, the scope.

import { everyRow, newest, oldest } from "./history.js";
import { allMarkers } from "./marker.js";

const button = document.getElementById("record");
let began = null;  // [s] of the run; null: not recording
let rig = null;

const sides = (name, quantity, unit) => ["least", "most"].map((side) => `${quantity}_${name}_${side}_${unit}`);

/** The rows from `from` to `to` as CSV. */
export function csv(from, to) {
  const names = [...rig.channels.flatMap((name) => sides(name, "position", "m")),
    ...rig.channels.flatMap((name) => sides(name, "control_current", "a"))];
  const lines = [["time_s", "speed_rad_per_s", ...names, "marker"].join()];
  const positions = 2 * rig.channels.length;
  const left = allMarkers().filter(({ time }) => time >= from && time <= to);
  const number = (value) => (Number.isNaN(value) ? "" : String(Number(value.toPrecision(7))));
  everyRow(from, to, (time, row) => {
    const here = [];
    while (left.length > 0 && left[0].time <= time) here.push(left.shift().text);
    const values = [...row.subarray(1)].map((value, i) => number(i < positions ? value * 1e-6 : value));
    const marker = here.length > 0 ? `"${here.join("; ").replaceAll('"', '""')}"` : "";
    lines.push([time.toFixed(4), number((row[0] * Math.PI) / 30), ...values, marker].join());
  });
  return lines.join("\r\n") + "\r\n";
}

function save(from, to) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([csv(from, to)], { type: "text/csv" }));
  link.download = `${rig.name}_${from.toFixed(1)}s_to_${to.toFixed(1)}s.csv`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function show() {
  button.setAttribute("aria-pressed", String(began !== null));
  button.textContent = began === null ? "● Record" : "■ Save CSV";
}

/** Another run: what was begun ends with the one before. */
export function setUpRecord(announced) {
  rig = announced;
  began = null;
  show();
}

export function wireRecord() {
  button.addEventListener("click", () => {
    if (!rig || newest() === null) return;
    if (began === null) {
      began = newest();
    } else {
      save(Math.max(began, oldest()), newest());
      began = null;
    }
    show();
  });
}
