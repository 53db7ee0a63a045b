// Waterfall: one full spectrum after the other, the newest at the bottom; a run-up draws its orders
// as slanted lines. Colour is the logarithm of the amplitude, from 1 nm to 100 um.

import { prepare } from "./canvas.js";
import { heat } from "./colours.js";

const ROWS = 240;  // one minute
const FEWEST = 40;  // rows that fill the picture at first
const DECADES = 5;  // from 1 nm to 100 um
const LEFT = 62;
const BOTTOM = 18;

let bearings = [];
let shown = 0;
let history = [];

export function setUpWaterfall(rig) {
  bearings = rig.bearings;
  history = [];
  const choice = document.getElementById("waterfall-bearing");
  choice.replaceChildren(...bearings.map((name, i) => new Option(name, String(i))));
  shown = 0;
  choice.onchange = () => { shown = Number(choice.value); drawWaterfall(); };
}

function rowPixels(row) {
  const pixels = new Uint8ClampedArray(row.length * 4);
  row.forEach((tenths, i) => {
    const share = Math.log10(Math.max(tenths, 1) / 10) / DECADES;
    pixels.set([...heat(share), 255], 4 * i);
  });
  return pixels;
}

export function addWaterfall(spectrum) {
  history.push({
    rows: spectrum.amplitude_dnm.map(rowPixels), rpm: spectrum.rpm, time: spectrum.t_ms / 1000, highest: spectrum.highest_hz,
  });
  if (history.length > ROWS) history.shift();
}

function drawScale(context, width, height, highest) {
  context.fillStyle = "#1b2733";
  context.textAlign = "center";
  const step = highest > 500 ? 200 : 100;
  for (let f = -Math.floor(highest / step) * step; f <= highest; f += step) {
    context.fillText(f + (f === 0 ? " Hz" : ""), LEFT + ((f + highest) / (2 * highest)) * (width - LEFT), height - 5);
  }
  context.textAlign = "right";
  const lines = height - BOTTOM;
  const rows = Math.max(history.length, FEWEST);
  for (let mark = 0; mark < 4; ++mark) {
    const entry = history[history.length - 1 - Math.round((mark / 4) * rows)];
    if (entry) context.fillText(`${Math.round(entry.rpm)} rpm`, LEFT - 4, lines - (mark / 4) * lines - 3);
  }
  context.textAlign = "left";
  drawHeat(context, width, lines);
}

/** Which colour stands for which amplitude: a strip in the upper right corner. */
function drawHeat(context, width, lines) {
  const strip = Math.min(120, width / 4);
  const left = width - strip - 48;
  if (lines < 60) return;
  context.fillStyle = "rgb(255 255 255 / 85%)";
  context.fillRect(left - 36, 4, strip + 84, 18);
  for (let x = 0; x < strip; ++x) {
    context.fillStyle = `rgb(${heat(x / strip).map(Math.round).join(" ")})`;
    context.fillRect(left + x, 7, 1.5, 12);
  }
  context.fillStyle = "#1b2733";
  context.fillText("1 nm", left - 32, 17);
  context.fillText("100 µm", left + strip + 3, 17);
}

export function drawWaterfall() {
  const newest = history.at(-1);
  const [context, width, height] = prepare(document.getElementById("waterfall"));
  if (!newest || !newest.rows[shown]) return;
  const lines = newest.rows[shown].length / 4;
  const rows = Math.max(history.length, FEWEST);
  const picture = new ImageData(lines, rows);
  history.forEach((entry, i) => {
    const row = entry.rows[shown];
    if (row.length === 4 * lines) picture.data.set(row, 4 * lines * (rows - history.length + i));
  });
  const raw = new OffscreenCanvas(lines, rows);
  raw.getContext("2d").putImageData(picture, 0, 0);
  context.imageSmoothingEnabled = false;
  context.fillStyle = "#eef1f4";  // not yet
  context.fillRect(LEFT, 0, width - LEFT, height - BOTTOM);
  context.drawImage(raw, LEFT, 0, width - LEFT, height - BOTTOM);
  drawScale(context, width, height, newest.highest);
}
