// The scope: one for all viewers, as it runs in the program. The page asks, shows its state, and
// fetches a capture when there is a new one.

import { lineColour } from "./colours.js";
import { ask } from "./controls.js";
import { address } from "./link.js";
import { dashedLines, fit, makePlot } from "./plot.js";

const form = document.getElementById("scope");
const line = document.getElementById("scope-answer");
const field = (name) => form.elements[name];

let rig = null;
let shown = 0;
let wanted = 0;
let plots = [];
let zooming = false;

const isLevel = () => ["position", "current"].includes(field("source").value);

function showFields() {
  for (const label of form.querySelectorAll(".level")) label.hidden = !isLevel();
  field("level").required = isLevel();
  const position = field("source").value === "position";
  document.getElementById("level-unit").textContent = position ? "level, µm" : "level, A";
  field("level").value = position ? 10 : 0.2;
}

function request() {
  const source = field("source").value;
  const asked = {
    do: "arm", source, length_ms: Number(field("length_ms").value), before_percent: Number(field("before_percent").value),
  };
  if (isLevel()) {
    const level = Number(field("level").value);
    Object.assign(asked, { channel: field("channel").value, edge: field("edge").value });
    asked[source === "position" ? "level_um" : "level_a"] = level;
  }
  return asked;
}

export function wireScope() {
  field("source").addEventListener("change", showFields);
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    ask(line, "api/scope", request(), "arm");
  });
  document.getElementById("scope-stop").addEventListener("click", () => ask(line, "api/scope", { do: "stop" }, "stop"));
  document.getElementById("capture-csv").href = address("api/scope.csv");
  for (const button of document.querySelectorAll("[data-zoom]")) {
    button.addEventListener("click", () => zoom(button.dataset.zoom));
  }
}

export function setUpScope(announced) {
  rig = announced;
  field("channel").replaceChildren(...rig.channels.map((name) => new Option(name)));
}

function condition(settings) {
  if (!settings || settings.source === "now") return "the next cycle";
  if (settings.source === "trip") return "a trip";
  const verb = { rising: "rises above", falling: "falls below", either: "passes" }[settings.edge];
  const level = settings.source === "position" ? `${+(settings.level * 1e6).toFixed(3)} µm` : `${+settings.level.toFixed(4)} A`;
  return `${settings.source} ${settings.channel} ${verb} ${level}`;
}

export async function showScope(state) {
  const gaps = state.given_up > 0 ? `; ${state.given_up} cut by a gap` : "";
  const what = {
    idle: "stopped", armed: `armed: waits until ${condition(state.settings)}${gaps}`,
    triggered: "triggered, recording", captured: `captured${gaps}`,
  }[state.state];
  line.className = "answer " + (state.state === "captured" ? "good" : state.state === "idle" ? "" : "wait");
  line.textContent = what;
  if (state.capture === 0 || state.capture === wanted) return;
  wanted = state.capture;
  const answer = await fetch(address("api/scope.json"));
  if (answer.ok) showCapture(await answer.json());
}

function showCapture(capture) {
  shown = capture.number;
  const settings = capture.settings;
  const step = capture.period_s * 1e3;
  const time = Array.from({ length: settings.samples }, (_, i) => (i - settings.before) * step);
  document.getElementById("capture-what").textContent =
    `${capture.number}: ${condition(settings)}; cycle ${capture.trigger_cycle}, ${settings.samples} cycles`;
  document.getElementById("capture-tools").hidden = false;
  for (const plot of plots) plot.destroy();
  plots = [
    plotOf("position", capture, time, capture.position_nm, 1e3, settings.level * 1e6),
    plotOf("current", capture, time, capture.current_ua, 1e6, settings.level),
  ];
}

function plotOf(kind, capture, time, rows, unit, level) {
  const series = capture.channels.map((name, i) => ({ label: name, stroke: lineColour(i), width: 1.2, points: { show: false } }));
  const lines = capture.settings.source === kind ? [level] : [];
  const plot = makePlot(document.getElementById("capture-" + kind), {
    series, y: { floor: kind === "position" ? [-1, 1] : [-0.05, 0.05] }, zoomed: followZoom,
    channels: capture.channels.map((name, i) => ({ name, colour: lineColour(i), series: [i + 1], value: (of) => (kind === "position" ? `${of.data[i + 1][of.cursor.idx]?.toFixed(3)} µm` : `${of.data[i + 1][of.cursor.idx]?.toFixed(4)} A`) })),
    where: (ms) => `${ms.toFixed(2)} ms`, common: "capture",
    draw: (chart) => { dashedLines(chart, "y", lines); dashedLines(chart, "x", [0]); },
  });
  plot.setData([time, ...rows.map((row) => row.map((v) => (v === null ? null : v / unit)))]);
  return plot;
}

/** Both pictures show the same time. */
function followZoom(plot, min, max) {
  if (zooming) return;
  zooming = true;
  for (const other of plots) if (other !== plot) other.setScale("x", { min, max });
  zooming = false;
}

function zoom(how) {
  if (plots.length === 0) return;
  const time = plots[0].data[0];
  const { min, max } = plots[0].scales.x;
  const middle = (min + max) / 2;
  const half = ((max - min) / 2) * Number(how);
  const range = how === "all" ? [time[0], time.at(-1)] : [Math.max(middle - half, time[0]), Math.min(middle + half, time.at(-1))];
  if (range[1] - range[0] > 4 * (time[1] - time[0])) plots[0].setScale("x", { min: range[0], max: range[1] });
}

export function drawScope() {
  for (const plot of plots) fit(plot);
}

/** Number of the capture in the pictures; for those who wait for one. */
export const shownCapture = () => shown;
