// The online identification beside the loop: how much its parameters still change, and how well they
// predict the next sample. Every message holds the whole history that is kept.

import { lineColour } from "./colours.js";
import { dashedLines, fit, makePlot } from "./plot.js";

const CHANGE_SHOWN = [0.001, 200];  // %

let plots = null;
let newest = null;
let channels = [];

const decades = (_, marks) => marks.map((v) => (Math.abs(Math.log10(v) % 1) < 1e-6 ? String(v) : ""));

export function setUpConvergence(rig) {
  plots?.forEach((plot) => plot.destroy());
  newest = null;
  channels = rig.channels;
  document.getElementById("convergence-now").textContent =
    "Nothing yet: amb identify live, started beside the run, shows its parameters here.";
  const at = (of, i, unit) => `${of.data[i][of.cursor.idx]?.toPrecision(3) ?? "–"} ${unit}`;
  const where = (s) => `${s.toFixed(1)} s`;
  plots = [
    makePlot(document.getElementById("convergence-change"), {
      series: [{ label: "largest change", stroke: lineColour(0), width: 1.5, points: { show: true, size: 5 } }],
      channels: [{ name: "largest change", colour: lineColour(0), series: [1], value: (of) => at(of, 1, "%") }],
      y: { log: true, range: CHANGE_SHOWN, axis: { values: decades } },
      draw: (plot) => { if (newest?.tolerance_percent) dashedLines(plot, "y", [newest.tolerance_percent]); },
      where, common: "convergence",
    }),
    makePlot(document.getElementById("convergence-fit"), {
      series: channels.map((name, i) => ({ label: name, stroke: lineColour(i), width: 1.5, points: { show: true, size: 4 } })),
      channels: channels.map((name, i) => ({ name, colour: lineColour(i), series: [i + 1], value: (of) => at(of, i + 1, "%") })),
      y: { floor: [90, 100] },
      where, common: "convergence",
    }),
  ];
}

function words(told) {
  const errors = told.error_um.map((um, i) => `${channels[i] ?? i} ${um?.toFixed(3) ?? "–"}`).join(", ");
  const gaps = told.gaps ? `${told.gaps} gaps, ${told.missing_rows} rows missing` : "no gaps";
  const anew = told.begun_anew ? `; begun anew ${told.begun_anew} times` : "";
  return `${told.converged ? "✓ converged" : "not converged yet"} after ${told.rows} rows: ${told.change_percent.at(-1) ?? "–"} % (${told.changed}); ` +
    `error of the last second, µm: ${errors}; ${gaps}${anew}`;
}

export function addConvergence(told) {
  if (!told.t_s?.length) return;
  newest = told;
  document.getElementById("convergence-now").textContent = words(told);
}

export function drawConvergence() {
  if (!plots || !newest || document.getElementById("identification").hidden) return;
  // Nothing below the picture's least decade could be seen, and 0 has no logarithm.
  const change = newest.change_percent.map((percent) => (percent === null ? null : Math.max(percent, CHANGE_SHOWN[0])));
  const data = [[newest.t_s, change], [newest.t_s, ...channels.map((_, i) => newest.fit_percent[i] ?? newest.t_s.map(() => null))]];
  plots.forEach((plot, i) => {
    fit(plot);
    plot.setData(data[i]);
  });
}
