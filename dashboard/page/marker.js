// Markers: instants that somebody wants to find again. The text is this page's own: a line in the
// traces and the events, and a column of what is saved. The instant is the controller's, too: its
// command `mark` asks the rig for nothing and stands in the session, with its cycle.

import { addEvent } from "./events.js";
import { newest } from "./history.js";
import { send } from "./link.js";

const MOST = 200;
let markers = [];  // {time, text}

export const allMarkers = () => markers;
export const forgetMarkers = () => { markers = []; };

export function mark() {
  const time = newest();
  if (time === null) return;
  const field = document.getElementById("marker-text");
  const text = field.value.trim() || `marker ${markers.length + 1}`;
  field.value = "";
  markers.push({ time, text });
  if (markers.length > MOST) markers.shift();
  addEvent({ time_s: time, severity: 0, text: "⚑ " + text });
  // Nobody waits for its answer: the controller's own event says that it is in the session.
  send("api/command", { command: "mark" });
}

/** Draws them into a plot over time. */
export function markerLines(plot) {
  const { left, top, width, height } = plot.bbox;
  const context = plot.ctx;
  context.save();
  context.fillStyle = context.strokeStyle = "#7b3294";
  context.font = "11px system-ui, 'DejaVu Sans', sans-serif";
  for (const { time, text } of markers) {
    const x = plot.valToPos(time, "x", true);
    if (!(x >= left && x <= left + width)) continue;
    context.fillRect(x, top, 1.5, height);
    context.textAlign = x > left + 0.7 * width ? "right" : "left";
    context.fillText(text, x + (context.textAlign === "left" ? 4 : -4), top + 12);
  }
  context.restore();
}

export function wireMarker(onMark) {
  document.getElementById("marker").addEventListener("submit", (event) => {
    event.preventDefault();
    mark();
    onMark();
  });
}
