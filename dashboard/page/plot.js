// uPlot with this page's manners: small type, size of its box, values at the cursor, channels that
// can be switched off.

import { followCursor } from "./cursor.js";

const FONT = "11px system-ui, 'DejaVu Sans', sans-serif";

/**
 * options: series, y {floor: [low, high] always shown, log}, x {label values}, draw(plot) on top, under(plot) below the lines,
 * zoomed(plot, min, max) after the time shown has changed: the user may then drag to zoom.
 * channels [{name, colour, series, value(plot)}]: what can be switched, with the numbers of its
 * series, and its text at the cursor; where(x): the cursor's place in words; common: name of what
 * is along x, where several pictures have it and one cursor.
 */
export function makePlot(box, { series, y = {}, x = {}, draw = () => {}, under = () => {}, zoomed = null, channels = null, where = null, common = null }) {
  const range = (plot, low, high) => {
    if (y.range) return y.range;
    const [least, most] = y.floor ?? [0, 1];
    const room = 0.05 * Math.max(high - low, 1e-9);
    return [Math.min(least, (low ?? 0) - room), Math.max(most, (high ?? 0) + room)];
  };
  const axis = { font: FONT, stroke: "#5a6775", grid: { stroke: "#e8ecef", width: 1 }, ticks: { show: false } };
  const options = {
    width: Math.max(box.clientWidth, 120),
    height: Math.max(box.clientHeight, 80),
    cursor: { points: { show: false }, y: false, drag: { x: Boolean(zoomed), y: false } },
    legend: { show: false },
    padding: [6, 16, 0, 0],
    scales: { x: { time: false, ...x.scale }, y: { range, distr: y.log ? 3 : 1 } },
    axes: [{ ...axis, size: 22, gap: 2 }, { ...axis, size: 44, gap: 2, ...y.axis }],
    series: [{}, ...series],
    hooks: {
      drawAxes: [under],
      draw: [draw],
      setScale: zoomed ? [(plot, key) => { if (key === "x" && plot.status === 1) zoomed(plot, plot.scales.x.min, plot.scales.x.max); }] : [],
    },
  };
  const plot = new uPlot(options, [[0], ...series.map(() => [null])], box);
  plot.box = box;
  const shown = channels ?? series.flatMap((one, i) => (one.label ? [{ name: one.label, colour: one.colour ?? one.stroke, series: [i + 1] }] : []));
  label(plot, shown);
  if (where) followCursor(plot, shown, where, common);
  return plot;
}

/**
 * Names of the lines in their colours, in the heading before the box: there they hide nothing. Each
 * is a switch; what was off stays off when the plot is made anew.
 */
function label(plot, channels) {
  const heading = plot.box.previousElementSibling;
  const before = heading.querySelector(".names");
  const off = new Set([...(before?.querySelectorAll("[aria-pressed=false]") ?? [])].map((one) => one.textContent));
  const names = document.createElement("span");
  names.className = "names";
  for (const channel of channels) {
    const name = document.createElement("button");
    name.type = "button";
    name.textContent = channel.name;
    name.title = "show or hide " + channel.name;
    name.style.color = channel.colour;
    const set = (on) => {
      name.setAttribute("aria-pressed", String(on));
      channel.hidden = !on;
      for (const i of channel.series) plot.setSeries(i, { show: on });
    };
    name.addEventListener("click", () => set(channel.hidden));
    names.append(name);
    set(!off.has(channel.name));
  }
  before?.remove();
  heading.append(names);
}

export function fit(plot) {
  const width = plot.box.clientWidth;
  const height = plot.box.clientHeight;
  if (width > 0 && (Math.abs(plot.width - width) > 1 || Math.abs(plot.height - height) > 1)) plot.setSize({ width, height });
}

/** Dashed lines at values of an axis, "x" or "y". */
export function dashedLines(plot, axis, values) {
  const { left, top, width, height } = plot.bbox;
  const context = plot.ctx;
  context.save();
  context.strokeStyle = "#5a6775";
  context.setLineDash([6, 4]);
  for (const value of values) {
    const place = plot.valToPos(value, axis, true);
    const [start, length] = axis === "y" ? [top, height] : [left, width];
    if (!(place >= start && place <= start + length)) continue;
    context.beginPath();
    context.moveTo(axis === "y" ? left : place, axis === "y" ? place : top);
    context.lineTo(axis === "y" ? left + width : place, axis === "y" ? place : top + height);
    context.stroke();
  }
  context.restore();
}
