// Positions and currents over time, as envelopes: each 25 ms show their least and most.

import { lineColour, lineTint } from "./colours.js";
import { envelopes } from "./history.js";
import { markerLines } from "./marker.js";
import { dashedLines, fit, makePlot } from "./plot.js";
import { timeWindow } from "./time_window.js";

const MOST = 1000;  // points: more than a screen shows, and each 25 ms of 20 s its own

const columns = { position: [], current: [] };
let plots = null;

const over = (values) => (plot) => {
  dashedLines(plot, "y", values);
  markerLines(plot);
};

/** The envelope of channel i as runs of points [x, least, most]; where a value is missing it ends. */
function runsOf(plot, i) {
  const [x, least, most] = [plot.data[0], plot.data[2 * i + 1], plot.data[2 * i + 2]];
  const runs = [[]];
  x.forEach((at, k) => {
    if (least[k] == null || most[k] == null) runs.push([]);
    else runs.at(-1).push([plot.valToPos(at, "x", true), plot.valToPos(least[k], "y", true), plot.valToPos(most[k], "y", true)]);
  });
  return runs.filter((run) => run.length > 1);
}

/** Numbers of the channels; two that are about equally wide keep their order, else they would flicker. */
function widestFirst(plot, runs) {
  const area = runs.map((some) => some.flat().reduce((sum, [, low, high]) => sum + low - high, 0));
  const order = (plot.widest ??= runs.map((_, i) => i));
  for (let last = order.length - 1; last > 0; --last) {
    for (let k = 0; k < last; ++k) {
      if (area[order[k + 1]] > 1.1 * area[order[k]]) [order[k], order[k + 1]] = [order[k + 1], order[k]];
    }
  }
  return order;
}

/**
 * Envelopes filled between least and most, below all lines, the wider ones further back: opaque, so
 * that each keeps its colour where several overlap.
 */
function fillEnvelopes(plot) {
  const runs = Array.from({ length: (plot.series.length - 1) / 2 }, (_, i) => (plot.series[2 * i + 1].show ? runsOf(plot, i) : []));
  const { left, top, width, height } = plot.bbox;
  const context = plot.ctx;
  context.save();
  context.beginPath();
  context.rect(left, top, width, height);
  context.clip();
  for (const i of widestFirst(plot, runs)) {
    context.fillStyle = lineTint(i);
    for (const run of runs[i]) {
      context.beginPath();
      for (const [x, low] of run) context.lineTo(x, low);
      for (const [x, , high] of [...run].reverse()) context.lineTo(x, high);
      context.fill();
    }
  }
  context.restore();
}

export function setUpTraces(rig) {
  plots?.position.destroy();
  plots?.current.destroy();
  // Every second axis is dashed: x and y are told apart without their colours.
  const line = (i, label) => ({ label, stroke: lineColour(i), dash: i % 2 ? [5, 3] : [], width: 1.3, points: { show: false } });
  const series = rig.channels.flatMap((name, i) => [line(i, ""), line(i, name)]);
  const clearance = rig.clearance_m * 1e6;
  // What the coils can carry about the bias, either way.
  const most = Math.min(rig.bias_a, rig.max_coil_current_a - rig.bias_a);
  const values = (plot, i, unit, digits) => {
    const pair = [plot.data[2 * i + 1], plot.data[2 * i + 2]].map((row) => row[plot.cursor.idx]);
    return pair[0] == null ? "–" : `${pair[0].toFixed(digits)} to ${pair[1].toFixed(digits)} ${unit}`;
  };
  const plot = (box, reach, limit, unit, digits) => makePlot(document.getElementById(box), {
    series, under: fillEnvelopes, y: { floor: [-reach, reach] }, draw: over([limit, -limit]),
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
