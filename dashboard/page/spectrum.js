// Full spectrum: amplitude of the orbit over signed frequency; left backward, right forward whirl.

import { lineColour } from "./colours.js";
import { fit, makePlot } from "./plot.js";

const ORDERS = [1, 2, 3];
const LEAST_UM = 0.001;

let plot = null;
let frequency = [];
let rows = [];
let speedHz = 0;

function orderLines(chart) {
  if (speedHz < 1) return;
  const context = chart.ctx;
  context.save();
  context.strokeStyle = "#5a6775";
  context.fillStyle = "#1b2733";
  context.setLineDash([4, 4]);
  for (const order of ORDERS) {
    for (const sign of [-1, 1]) {
      const x = chart.valToPos(sign * order * speedHz, "x", true);
      if (x < chart.bbox.left || x > chart.bbox.left + chart.bbox.width) continue;
      context.beginPath();
      context.moveTo(x, chart.bbox.top);
      context.lineTo(x, chart.bbox.top + chart.bbox.height);
      context.stroke();
      context.textAlign = sign < 0 ? "right" : "left";  // outwards, so that the two do not meet
      context.fillText(`${sign < 0 ? "−" : ""}${order}×`, x + 2 * sign, chart.bbox.top + chart.bbox.height - 6 - 14 * (order - 1));
    }
  }
  context.restore();
}

export function setUpSpectrum(rig) {
  plot?.destroy();
  frequency = [];
  const series = rig.bearings.map((name, i) => ({ label: name, stroke: lineColour(i), width: 1, points: { show: false } }));
  plot = makePlot(document.getElementById("spectrum"), {
    series, draw: orderLines,
    y: { log: true, range: [LEAST_UM, 200], axis: { values: (_, marks) => marks.map((v) => (Math.abs(Math.log10(v) % 1) < 1e-6 ? String(v) : "")) } },
  });
}

export function showSpectrum(spectrum) {
  const lines = spectrum.amplitude_dnm[0]?.length ?? 0;
  if (lines !== frequency.length) {
    frequency = Array.from({ length: lines }, (_, i) => -spectrum.highest_hz + i * spectrum.line_hz);
  }
  rows = spectrum.amplitude_dnm.map((row) => row.map((v) => Math.max(v / 1e4, LEAST_UM)));
  speedHz = Math.abs(spectrum.rpm) / 60;
}

export function drawSpectrum() {
  if (!plot || frequency.length === 0) return;
  fit(plot);
  plot.setData([frequency, ...rows]);
}
