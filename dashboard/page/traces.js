// Positions and currents over the last seconds, as envelopes: each 25 ms show their least and most.

import { lineColour } from "./colours.js";
import { dashedLines, fit, makePlot } from "./plot.js";

const WINDOW_S = 20;
const MOST = WINDOW_S * 40;  // buckets
const FILL = "30";  // opacity between least and most: envelopes lie over each other

let time = [];
let rows = { position: [], current: [] };  // least of the first channel, its most, least of the second ...
let plots = null;

const limitLines = (values) => (plot) => dashedLines(plot, "y", values);

export function setUpTraces(rig) {
  plots?.position.destroy();
  plots?.current.destroy();
  time = [];
  const line = (i, label) => ({ label, stroke: lineColour(i), width: 1, points: { show: false } });
  const series = rig.channels.flatMap((name, i) => [line(i, ""), line(i, name)]);
  const bands = rig.channels.map((_, i) => ({ series: [2 * i + 2, 2 * i + 1], fill: lineColour(i) + FILL }));
  rows = { position: series.map(() => []), current: series.map(() => []) };
  const clearance = rig.clearance_m * 1e6;
  // What the coils can carry about the bias, either way.
  const most = Math.min(rig.bias_a, rig.max_coil_current_a - rig.bias_a);
  plots = {
    position: makePlot(document.getElementById("positions"), { series, bands, y: { floor: [-5, 5] }, draw: limitLines([clearance, -clearance]) }),
    current: makePlot(document.getElementById("currents"), { series, bands, y: { floor: [-1.1 * most, 1.1 * most] }, draw: limitLines([most, -most]) }),
  };
}

/** `both` holds least and most in turn; what is no number leaves a gap. */
function addRows(place, both, unit) {
  both.forEach((values, i) => values.forEach((v, k) => place[2 * i + (k % 2)].push(v === null ? null : v / unit)));
}

export function addTraces(tick) {
  if (!plots || !tick.t_ms || tick.t_ms.length === 0) return;
  const newest = tick.t_ms[0] / 1000;
  if (time.length > 0 && newest < time.at(-1)) {
    time.length = 0;
    for (const row of [...rows.position, ...rows.current]) row.length = 0;
  }
  for (const t of tick.t_ms) time.push(t / 1000);
  addRows(rows.position, tick.position_nm, 1000);
  addRows(rows.current, tick.current_ma, 1000);
  const surplus = time.length - MOST;
  if (surplus > 0) for (const row of [time, ...rows.position, ...rows.current]) row.splice(0, surplus);
}

export function drawTraces() {
  if (!plots || time.length < 2) return;
  const end = time.at(-1);
  for (const kind of ["position", "current"]) {
    fit(plots[kind]);
    plots[kind].setData([time, ...rows[kind]], false);
    plots[kind].batch(() => {
      plots[kind].setScale("x", { min: Math.max(end - WINDOW_S, time[0]), max: end });
      plots[kind].setScale("y", { min: null, max: null });
    });
  }
}
