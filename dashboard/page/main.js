// Puts the parts together: messages go to those who keep them, drawing happens at the screen's pace.

import { limitSpeed, wireControls } from "./controls.js";
import { addEvent } from "./events.js";
import { noteExcitation, setUpExcitation, wireExcitation } from "./excitation.js";
import { listen } from "./link.js";
import { drawOrbits, setUpOrbits, showOrbits } from "./orbit.js";
import { drawScope, setUpScope, showScope, wireScope } from "./scope.js";
import { drawSpectrum, setUpSpectrum, showSpectrum } from "./spectrum.js";
import { showConnection, showRig, showTick, showTime, showTrip } from "./state.js";
import { drawTiming, showTiming } from "./timing.js";
import { addTraces, drawTraces, setUpTraces } from "./traces.js";
import { wireViews } from "./views.js";
import { addWaterfall, drawWaterfall, setUpWaterfall } from "./waterfall.js";

const DRAW_EVERY_MS = 100;
let eventsSeen = 0;
let server = 0;
const due = new Set();

const handlers = {
  rig(rig) {
    if (rig.server !== server) eventsSeen = 0;  // amb was started again and counts anew
    server = rig.server;
    showRig(rig);
    if (!rig.channels) return;
    limitSpeed(rig);
    for (const setUp of [setUpOrbits, setUpTraces, setUpSpectrum, setUpWaterfall, setUpExcitation, setUpScope]) setUp(rig);
  },
  tick(tick) {
    showTick(tick);
    if (tick.t_ms?.length) showTime(tick.t_ms.at(-1) / 1000);
    if (tick.orbit_nm) showOrbits(tick.orbit_nm, tick.bias_ma);
    addTraces(tick);
    newest = tick.sent_ns ?? newest;
    due.add(drawOrbits).add(drawTraces);
  },
  spectrum(spectrum) {
    showSpectrum(spectrum);
    addWaterfall(spectrum);
    due.add(drawSpectrum).add(drawWaterfall);
  },
  timing(timing) {
    showTiming(timing);
    due.add(drawTiming);
  },
  log(event) {
    if (event.number <= eventsSeen) return;  // told again after a reconnection
    eventsSeen = event.number;
    addEvent(event);
    noteExcitation(event);
    if (event.severity === 2) showTrip(event);
  },
  scope(state) {
    showScope(state);
    due.add(drawScope);
  },
};

// A page in the background draws nothing: the browser calls no frames then.
let drawn = 0;
let newest = null;  // when the newest figures were sent
function draw(now) {
  requestAnimationFrame(draw);
  if (now - drawn < DRAW_EVERY_MS) return;
  drawn = now;
  for (const part of due) part();
  due.clear();
  if (newest) document.documentElement.dataset.drawn = newest;  // what is in sight now
}

wireControls();
wireExcitation();
wireScope();
const everything = [drawOrbits, drawTraces, drawSpectrum, drawWaterfall, drawTiming, drawScope];
const drawAll = () => everything.forEach((part) => due.add(part));
wireViews(drawAll);
window.addEventListener("resize", drawAll);
listen(handlers, showConnection);
requestAnimationFrame(draw);
