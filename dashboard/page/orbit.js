// Orbits: where the shaft moves in each bearing, inside its clearance and zones (ISO 14839-2).
//
// x and y are the bearing's control axes, x to the right and y up, as docs/conventions.md sees them:
// a rotor with positive speed turns from x to y, counter-clockwise. The dot is where the shaft was
// when the key phasor passed: it stands still at a constant speed and wanders through a resonance.

import { prepare } from "./canvas.js";
import { lineColour } from "./colours.js";

const ZONES = [[0.5, "#fdf0e6", "C"], [0.4, "#fbf7e3", "B"], [0.3, "#eaf4ef", "A"]];
const HELD = ["levitating", "spinning", "coast_down"];
const KEEP = 10;  // older orbits, fading

let views = [];
let clearance = 0;
let energised = false;  // zones are of a levitated shaft, not of one that lies
let turning = 0;  // sense of rotation of the first shaft: 1 from x to y, -1 from y to x, 0 it stands
let keys = [];  // points of the newest orbit at which the key phasor passed

export function setUpOrbits(rig) {
  const place = document.getElementById("orbits");
  place.replaceChildren();
  clearance = rig.clearance_m * 1e9;
  views = rig.bearings.map((name, bearing) => {
    const canvas = document.createElement("canvas");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", "orbit of bearing " + name);
    const cell = document.createElement("div");
    cell.append(canvas);
    place.append(cell);
    // A geared shaft may turn the other way.
    const sense = Math.sign(rig.speed_ratios?.[bearing] ?? 1);
    const view = { name, canvas, sense, history: [], largest: 0, peak: 0 };
    canvas.title = "dashed: the largest radius since the shaft was lifted; a click begins anew";
    canvas.addEventListener("click", () => { view.peak = 0; });
    return view;
  });
}

function path(context, points, scale) {
  context.beginPath();
  for (let i = 0; i + 1 < points.length; i += 2) context.lineTo(points[i] * scale, -points[i + 1] * scale);
  context.stroke();
}

function drawRings(context, radius) {
  context.fillStyle = "#fff";
  context.strokeStyle = "#1b2733";
  context.lineWidth = 1.5;
  context.beginPath();
  context.arc(0, 0, radius, 0, 7);
  context.fill();
  context.stroke();
  context.lineWidth = 0.7;
  for (const [share, colour, letter] of ZONES) {
    context.fillStyle = colour;
    context.strokeStyle = "#8a97a4";
    context.beginPath();
    context.arc(0, 0, share * radius, 0, 7);
    context.fill();
    context.stroke();
    context.fillStyle = "#5a6775";
    context.font = "9px system-ui, 'DejaVu Sans', sans-serif";
    context.fillText(letter, (share - 0.05) * radius * 0.707 - 3, -(share - 0.05) * radius * 0.707 + 3);
  }
  context.strokeStyle = "#d5dbe1";
  context.beginPath();
  context.moveTo(-radius, 0);
  context.lineTo(radius, 0);
  context.moveTo(0, -radius);
  context.lineTo(0, radius);
  context.stroke();
  context.fillStyle = "#5a6775";
  context.fillText("x", radius - 9, -3);
  context.fillText("y", 4, -radius + 9);
}

/** The largest radius held so far. */
function drawPeak(context, radius) {
  if (!(radius > 1)) return;
  context.globalAlpha = 1;
  context.strokeStyle = "#d55e00";
  context.lineWidth = 1;
  context.setLineDash([3, 3]);
  context.beginPath();
  context.arc(0, 0, radius, 0, 7);
  context.stroke();
  context.setLineDash([]);
}

/** A dot at each passage of the key phasor, the last one filled. */
function drawKeys(context, points, scale) {
  context.lineWidth = 1.2;
  context.strokeStyle = "#1b2733";
  keys.forEach((key, i) => {
    if (2 * key + 1 >= points.length) return;
    context.fillStyle = i === keys.length - 1 ? "#e69f00" : "#fff";
    context.beginPath();
    context.arc(points[2 * key] * scale, -points[2 * key + 1] * scale, 3.5, 0, 7);
    context.fill();
    context.stroke();
  });
}

/** An arrow the way the shaft turns, in the free corner left below the clearance's circle. */
function drawSense(context, x, y, sense) {
  const way = -turning * sense;  // the screen's y points down
  context.strokeStyle = context.fillStyle = "#1b2733";
  context.lineWidth = 1.5;
  context.beginPath();
  context.arc(x, y, 8, 0.75 * Math.PI, 0.75 * Math.PI + way * 1.5 * Math.PI, way < 0);
  context.stroke();
  const end = 0.75 * Math.PI + way * 1.5 * Math.PI;
  const [tipX, tipY] = [x + 8 * Math.cos(end), y + 8 * Math.sin(end)];
  const along = end + (way * Math.PI) / 2;
  context.beginPath();
  for (const turn of [0, 2.4, -2.4]) context.lineTo(tipX + 5 * Math.cos(along + turn), tipY + 5 * Math.sin(along + turn));
  context.fill();
}

/**
 * An orbit that is small beside the clearance is drawn again, enlarged: below the clearance where
 * `top` leaves room, else in the corner.
 */
function drawEnlarged(context, view, width, height, top) {
  const newest = view.history.at(-1);
  let middle = [0, 0];
  for (let i = 0; i < newest.length; i += 2) middle = [middle[0] + newest[i], middle[1] + newest[i + 1]];
  middle = middle.map((sum) => (2 * sum) / newest.length);
  let reach = 1;
  for (let i = 0; i < newest.length; i += 2) reach = Math.max(reach, Math.hypot(newest[i] - middle[0], newest[i + 1] - middle[1]));
  const nice = [1, 2, 5, 10, 20, 50, 100, 200, 500].find((step) => step * 1000 >= reach) ?? 1000;
  const below = Math.min(width, height - top - 20) / 2 - 4;
  const roomy = below > 0.2 * Math.min(width, height);
  const half = roomy ? below : Math.min(width, height) * 0.2;
  const centre = roomy ? [width / 2, top + 20 + half] : [width - half - 4, height - half - 4];
  context.save();
  context.translate(...centre);
  context.fillStyle = "#fff";
  context.strokeStyle = "#8a97a4";
  context.fillRect(-half, -half, 2 * half, 2 * half);
  context.strokeRect(-half, -half, 2 * half, 2 * half);
  context.beginPath();
  context.rect(-half, -half, 2 * half, 2 * half);
  context.clip();
  context.strokeStyle = lineColour(0);
  context.lineWidth = 1.2;
  const scale = half / (nice * 1000);
  context.translate(-middle[0] * scale, middle[1] * scale);
  path(context, newest, scale);
  drawKeys(context, newest, scale);
  context.restore();
  context.fillStyle = "#5a6775";
  context.textAlign = "right";
  context.fillText(`±${nice} µm`, centre[0] + half - 2, centre[1] - half - 4);
  context.textAlign = "left";
}

export function showOrbits(tick) {
  const orbits = tick.orbit_nm;
  energised = tick.bias_ma > 0 && !tick.silent;
  keys = tick.orbit_key ?? [];
  turning = keys.length > 0 ? Math.sign(tick.speed_rpm) : 0;
  views.forEach((view, i) => {
    const points = orbits[i];
    if (!points || points.length < 4 || points.includes(null)) return;
    view.history.push(points);
    if (view.history.length > KEEP) view.history.shift();
    view.largest = 0;
    for (let k = 0; k < points.length; k += 2) view.largest = Math.max(view.largest, Math.hypot(points[k], points[k + 1]));
    const held = HELD.includes(tick.mode) && !tick.silent;
    if (tick.mode === "lift") view.peak = 0;
    if (held) view.peak = Math.max(view.peak, view.largest);
  });
}

export function drawOrbits() {
  for (const view of views) {
    const [context, width, height] = prepare(view.canvas);
    const radius = Math.min(width, height - 18) / 2 - 3;
    if (radius < 20) continue;
    context.save();
    context.translate(width / 2, radius + 18);
    drawRings(context, radius);
    view.history.forEach((points, age) => {
      context.strokeStyle = lineColour(0);
      context.globalAlpha = 0.12 + (0.88 * (age + 1)) / view.history.length;
      context.lineWidth = age === view.history.length - 1 ? 1.8 : 1;
      path(context, points, radius / clearance);
    });
    drawPeak(context, (view.peak / clearance) * radius);
    context.restore();
    if (turning !== 0) drawSense(context, width / 2 - 0.86 * radius, 18 + 1.86 * radius, view.sense);
    const share = view.largest / clearance;
    const zone = !energised ? "" : ", zone " + (share < 0.3 ? "A" : share < 0.4 ? "B" : share < 0.5 ? "C" : "D");
    context.fillStyle = "#1b2733";
    context.font = "600 12px system-ui, 'DejaVu Sans', sans-serif";
    context.fillText(view.name.toUpperCase(), 4, 12);
    context.font = "11px system-ui, 'DejaVu Sans', sans-serif";
    if (view.history.length > 0) {
      context.textAlign = "right";
      context.fillText(`${(view.largest / 1000).toFixed(1)} µm${zone}`, width - 4, 12);
      context.textAlign = "left";
      drawEnlarged(context, view, width, height, 2 * radius + 18);
    }
  }
}
