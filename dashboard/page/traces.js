// Positions and currents over time, as envelopes: each 25 ms show their least and most.

import { lineColour } from "./colours.js";
import { envelopes } from "./history.js";
import { markerLines } from "./marker.js";
import { dashedLines, fit, makePlot } from "./plot.js";
import { timeWindow } from "./time_window.js";

const MOST = 1000;  // points: more than a screen shows, and each 25 ms of 20 s its own
const FILL = "30";  // opacity between least and most: envelopes lie over each other

const columns = { position: [], current: [] };
let plots = null;

const over = (values) => (plot) => {
  dashedLines(plot, "y", values);
  markerLines(plot);
};

export function setUpTraces(rig) {
  plots?.position.destroy();
  plots?.current.destroy();
  // Every second axis is dashed: x and y are told apart without their colours.
  const line = (i, label) => ({ label, stroke: lineColour(i), dash: i % 2 ? [5, 3] : [], width: 1, points: { show: false } });
  const series = rig.channels.flatMap((name, i) => [line(i, ""), line(i, name)]);
  const bands = rig.channels.map((_, i) => ({ series: [2 * i + 2, 2 * i + 1], fill: lineColour(i) + FILL }));
  const clearance = rig.clearance_m * 1e6;
  // What the coils can carry about the bias, either way.
  const most = Math.min(rig.bias_a, rig.max_coil_current_a - rig.bias_a);
  const values = (plot, i, unit, digits) => {
    const pair = [plot.data[2 * i + 1], plot.data[2 * i + 2]].map((row) => row[plot.cursor.idx]);
    return pair[0] == null ? "–" : `${pair[0].toFixed(digits)} to ${pair[1].toFixed(digits)} ${unit}`;
  };
  const plot = (box, reach, limit, unit, digits) => makePlot(document.getElementById(box), {
    series, bands, y: { floor: [-reach, reach] }, draw: over([limit, -limit]),
    channels: rig.channels.map((name, i) => ({ name, colour: lineColour(i), series: [2 * i + 1, 2 * i + 2], value: (of) => values(of, i, unit, digits) })),
    where: (x) => `${x.toFixed(3)} s`, common: "run",
  });
  plots = { position: plot("positions", 5, clearance, "µm", 2), current: plot("currents", 1.1 * most, most, "A", 3) };
}

export function drawTraces() {
  const span = plots && timeWindow();
  if (!span || span[1] <= span[0]) return;
  for (const kind of ["position", "current"]) {
    const plot = plots[kind];
    fit(plot);
    plot.setData(envelopes(kind, ...span, MOST, columns[kind]), false);
    plot.batch(() => {
      plot.setScale("x", { min: span[0], max: span[1] });
      plot.setScale("y", { min: null, max: null });
    });
  }
}
