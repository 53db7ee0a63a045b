// Loop timing: how often each duration occurred since the start, on logarithmic axes.

import { prepare } from "./canvas.js";
import { lineColour } from "./colours.js";

const ROWS = [["compute", 0], ["latency", 1], ["wakeup", 2]];

let newest = null;
let period_ns = 0;

export function setUpTiming(rig) {
  newest = null;
  period_ns = Math.round(rig.period_s * 1e9);
}

export function showTiming(timing) {
  newest = timing;
  const us = (ns) => (ns / 1000).toFixed(ns < 10000 ? 1 : 0) + " µs";
  const parts = [`p99 ${us(timing.compute_p99_ns ?? 0)}`];
  if (timing.latency_p99_ns > 0) parts.push(`latency ${us(timing.latency_p99_ns)}`);
  parts.push(`skipped ${timing.skipped ?? 0}`);
  document.getElementById("timing-note").textContent = parts.join(", ");
}

const text = (ns) => (ns < 1e3 ? ns + " ns" : ns < 1e6 ? ns / 1e3 + " µs" : ns / 1e6 + " ms");

export function drawTiming() {
  if (!newest?.edge_ns?.length) return;
  const [context, width, height] = prepare(document.getElementById("timing"));
  const used = ROWS.filter(([name]) => newest[name].some((n) => n > 0));
  const bottom = height - 16;
  const low = Math.log10(Math.max(newest.edge_ns[0] / 1.2, 1));
  const high = Math.max(Math.log10(newest.edge_ns.at(-1)), low + 0.5);
  const x = (ns) => ((Math.log10(Math.max(ns, 1)) - low) / (high - low)) * width;
  const most = Math.log10(1 + Math.max(...used.flatMap(([name]) => newest[name])));
  context.strokeStyle = "#d5dbe1";
  context.fillStyle = "#5a6775";
  for (let decade = Math.ceil(low); decade <= high; ++decade) {
    const place = x(10 ** decade);
    context.fillStyle = "#d5dbe1";
    context.fillRect(place, 0, 0.6, bottom);
    context.fillStyle = "#5a6775";
    if (place + 38 < width) context.fillText(text(10 ** decade), place + 2, height - 4);
  }
  const y = (count) => bottom - (Math.log10(1 + count) / most) * (bottom - 8);
  for (let decade = 0; 10 ** decade < 10 ** most; decade += most > 5 ? 2 : 1) {
    const place = y(10 ** decade);
    context.fillStyle = "#d5dbe1";
    context.fillRect(0, place, width, 0.6);
    context.fillStyle = "#5a6775";
    if (place < 11 + 13 * used.length + 8) continue;  // the names of the lines stand there
    context.textAlign = "right";
    context.fillText(decade < 4 ? String(10 ** decade) : `10${[..."" + decade].map((d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]).join("")}`, width - 4, place - 2);
  }
  context.textAlign = "left";
  if (period_ns > 0 && x(period_ns) < width) {
    context.fillStyle = "#1b2733";
    for (let y0 = 0; y0 < bottom; y0 += 6) context.fillRect(x(period_ns), y0, 1.2, 3);
    context.save();
    context.translate(x(period_ns) + 10, bottom - 4);
    context.rotate(-Math.PI / 2);
    context.fillText("period", 0, 0);
    context.restore();
  }
  used.forEach(([name, colour], i) => {
    context.strokeStyle = lineColour(colour);
    context.fillStyle = lineColour(colour);
    context.lineWidth = 1.6;
    context.beginPath();
    context.moveTo(x(newest.edge_ns[0] / 1.2), bottom);
    newest.edge_ns.forEach((edge, bin) => {
      const height = y(newest[name][bin]);
      context.lineTo(x(bin === 0 ? edge / 1.2 : newest.edge_ns[bin - 1]), height);
      context.lineTo(x(edge), height);
    });
    context.stroke();
    context.textAlign = "right";
    context.fillText(name, width - 4, 11 + 13 * i);
    context.textAlign = "left";
  });
}
