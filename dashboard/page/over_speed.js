// What turns with the rotor, over its speed: amplitude and phase of each axis at once per
// revolution, the newest of every small step of speed. A run-up draws its resonances.

import { lineColour } from "./colours.js";
import { dashedLines, fit, makePlot } from "./plot.js";

const STEPS = 400;  // of the rig's highest speed

let plots = null;
let step = 1;
let bins = new Map();  // number of the step -> [rpm, amplitudes, phases]
let columns = null;    // made of the bins when drawn
let now = 0;

const speedLine = (plot) => { if (now >= 1) dashedLines(plot, "x", [now]); };

export function setUpOverSpeed(rig) {
  plots?.forEach((plot) => plot.destroy());
  bins = new Map();
  columns = null;
  const highest = rig.max_speed_rpm || 60000;
  step = highest / STEPS;
  const plot = (box, options, digits, unit, y) => makePlot(document.getElementById(box), {
    series: rig.channels.map((name, i) => ({ label: name, stroke: lineColour(i), spanGaps: false, ...options(i) })),
    x: { scale: { range: [0, highest] } }, y, draw: speedLine,
    channels: rig.channels.map((name, i) => ({ name, colour: lineColour(i), series: [i + 1], value: (of) => `${of.data[i + 1][of.cursor.idx]?.toFixed(digits) ?? "–"} ${unit}` })),
    where: (rpm) => `${Math.round(rpm)} rpm`, common: "speed",
  });
  plots = [
    plot("first-amplitude", () => ({ width: 1.5, points: { show: true, size: 4 } }), 2, "µm", { floor: [0, 1] }),
    // Points only: at ±180° a line would cross the picture.
    plot("first-phase", (i) => ({ width: 0, paths: () => null, points: { show: true, size: 5, fill: lineColour(i) } }), 0, "°",
      { range: [-180, 180], axis: { splits: () => [-180, -90, 0, 90, 180] } }),
  ];
}

export function addOverSpeed(spectrum) {
  now = Math.abs(spectrum.rpm);
  if (!spectrum.first_order_nm || now < step / 2) return;
  const amplitude = spectrum.first_order_nm.map((nm) => nm / 1000);
  const phase = spectrum.first_order_ddeg.map((tenths) => tenths / 10);
  bins.set(Math.round(now / step), [now, amplitude, phase]);
  columns = null;
  const note = amplitude.map((um, i) => `${um.toFixed(1)} µm ∠ ${Math.round(phase[i])}°`);
  document.getElementById("first-now").textContent = `${Math.round(now)} rpm: ${note.join(", ")}`;
}

export function drawOverSpeed() {
  if (!plots || bins.size === 0 || document.getElementById("over-speed").hidden) return;
  if (!columns) {
    const rows = [...bins.entries()].sort(([a], [b]) => a - b).map(([, row]) => row);
    const of = (which) => [rows.map(([rpm]) => rpm), ...rows[0][which].map((_, i) => rows.map((row) => row[which][i]))];
    columns = [of(1), of(2)];
  }
  plots.forEach((plot, i) => {
    fit(plot);
    plot.setData(columns[i], false);
    plot.batch(() => {
      plot.setScale("x", { min: null, max: null });
      plot.setScale("y", { min: null, max: null });
    });
  });
}

export function wireOverSpeed(onChange) {
  document.getElementById("first-clear").addEventListener("click", () => {
    bins.clear();
    columns = null;
    for (const plot of plots ?? []) plot.setData(plot.data.map(() => []));
    onChange();
  });
}
