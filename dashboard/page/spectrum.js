// Full spectrum: amplitude of the orbit over signed frequency; left backward, right forward whirl.
// How far it reaches is chosen here, for all viewers.

import { lineColour } from "./colours.js";
import { send } from "./link.js";
import { fit, makePlot } from "./plot.js";

const ORDERS = [1, 2, 3];
const LEAST_UM = 0.001;
const RANGES_HZ = [100, 200, 500, 1000, 2000, 5000, 10000];

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

/** Half the sampling rate at most; the amplifiers' reach is named, where the loop ends. */
function offerRanges(rig) {
  const choice = document.getElementById("spectrum-range");
  const highest = 0.5 / rig.period_s;
  choice.replaceChildren(...RANGES_HZ.filter((hz) => hz <= highest).map((hz) => new Option(`±${hz} Hz`, String(hz))));
  const reach = RANGES_HZ.find((hz) => hz >= rig.amplifier_hz && hz <= highest);
  choice.title = reach ? `the amplifiers reach ${Math.round(rig.amplifier_hz)} Hz (−3 dB)` : "";
  for (const option of choice.options) if (Number(option.value) === reach) option.text += ", amplifiers";
  choice.value = "500";
  choice.onchange = () => send("api/spectrum", { highest_hz: Number(choice.value) });
}

export function setUpSpectrum(rig) {
  plot?.destroy();
  offerRanges(rig);
  frequency = [];
  const series = rig.bearings.map((name, i) => ({ label: name, stroke: lineColour(i), width: 1, points: { show: false } }));
  plot = makePlot(document.getElementById("spectrum"), {
    series, draw: orderLines,
    channels: rig.bearings.map((name, i) => ({ name, colour: lineColour(i), series: [i + 1], value: (of) => `${of.data[i + 1][of.cursor.idx]?.toPrecision(3)} µm` })),
    where: (hz) => `${hz.toFixed(1)} Hz` + (speedHz >= 1 ? `, ${(hz / speedHz).toFixed(2)}×` : ""),
    y: { log: true, range: [LEAST_UM, 200], axis: { values: (_, marks) => marks.map((v) => (Math.abs(Math.log10(v) % 1) < 1e-6 ? String(v) : "")) } },
  });
}

/** Another viewer may have chosen. */
function showRange(highest) {
  const choice = document.getElementById("spectrum-range");
  const value = String(RANGES_HZ.find((hz) => hz >= 0.98 * highest));
  if (document.activeElement !== choice && choice.value !== value) choice.value = value;
}

export function showSpectrum(spectrum) {
  const lines = spectrum.amplitude_dnm[0]?.length ?? 0;
  if (lines !== frequency.length || frequency[0] !== -spectrum.highest_hz) {
    frequency = Array.from({ length: lines }, (_, i) => -spectrum.highest_hz + i * spectrum.line_hz);
  }
  showRange(spectrum.highest_hz);
  rows = spectrum.amplitude_dnm.map((row) => row.map((v) => Math.max(v / 1e4, LEAST_UM)));
  speedHz = Math.abs(spectrum.rpm) / 60;
}

export function drawSpectrum() {
  if (!plot || frequency.length === 0) return;
  fit(plot);
  plot.setData([frequency, ...rows]);
}
