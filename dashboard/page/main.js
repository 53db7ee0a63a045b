// Puts the parts together: messages go to those who keep them, drawing happens at the screen's pace.

import { limitSpeed, noteSpeed, wireControls } from "./controls.js";
import { addEvent } from "./events.js";
import { noteExcitation, setUpExcitation, wireExcitation } from "./excitation.js";
import { ended, showConnection, showEnd, showSilence } from "./freshness.js";
import { addHistory, newest as past, setUpHistory } from "./history.js";
import { addConvergence, drawConvergence, setUpConvergence } from "./convergence.js";
import { listen } from "./link.js";
import { forgetMarkers, wireMarker } from "./marker.js";
import { drawOrbits, setUpOrbits, showOrbits } from "./orbit.js";
import { addOverSpeed, drawOverSpeed, setUpOverSpeed, wireOverSpeed } from "./over_speed.js";
import { pace, paceText } from "./pace.js";
import { setUpRecord, wireRecord } from "./record.js";
import { drawScope, setUpScope, showScope, wireScope } from "./scope.js";
import { drawSpectrum, setUpSpectrum, showSpectrum } from "./spectrum.js";
import { showPace, showRig, showTick, showTime, showTrip } from "./state.js";
import { showSteps } from "./steps.js";
import { isHeld, moveSlider, releaseTime, wireTime } from "./time_window.js";
import { drawTiming, setUpTiming, showTiming } from "./timing.js";
import { drawTraces, setUpTraces } from "./traces.js";
import { wireViews } from "./views.js";
import { addWaterfall, drawWaterfall, setUpWaterfall } from "./waterfall.js";

const DRAW_EVERY_MS = 100;
const SET_UPS = [setUpOrbits, setUpTraces, setUpSpectrum, setUpWaterfall, setUpOverSpeed, setUpExcitation, setUpScope, setUpRecord, setUpTiming, setUpConvergence];
let eventsSeen = 0;
let server = 0;
let run = 0;
let period_s = 0;
let lastMode = "";  // of the newest event: the last state may be a hundred cycles older
const due = new Set();

const handlers = {
  rig(rig) {
    if (rig.server !== server) {  // amb was started again and counts anew
      eventsSeen = 0;
      showEnd("");
    }
    const another = rig.server !== server || rig.run !== run;
    [server, run] = [rig.server, rig.run];
    showRig(rig);
    if (!rig.channels) return;
    period_s = rig.period_s;
    limitSpeed(rig);
    // The same run after a lost connection: what is shown of it stays, what was missed is fetched.
    if (another) {
      forgetMarkers();
      for (const setUp of SET_UPS) setUp(rig);
      releaseTime();
    }
    setUpHistory(rig).then(() => {
      if (past() !== null) showTime(past());
      moveSlider();
      due.add(drawTraces);
    });
  },
  tick(tick) {
    showTick(tick, ended() ? lastMode : "");
    showSilence(tick.silent);
    showSteps(tick, ended());
    showPace(paceText(pace(tick, period_s)));
    if (tick.t_ms?.length) showTime(tick.t_ms.at(-1) / 1000);
    addHistory(tick);
    moveSlider();
    newest = tick.sent_ns ?? newest;
    if (isHeld()) return;
    if (tick.orbit_nm) showOrbits(tick);
    due.add(drawOrbits).add(drawTraces);
  },
  spectrum(spectrum) {
    addWaterfall(spectrum);
    addOverSpeed(spectrum);
    if (isHeld()) return;
    showSpectrum(spectrum);
    due.add(drawSpectrum).add(drawWaterfall).add(drawOverSpeed);
  },
  end(end) {
    showEnd(end.text);
  },
  timing(timing) {
    showTiming(timing);
    due.add(drawTiming);
  },
  log(event) {
    if (event.number <= eventsSeen) return;  // told again after a reconnection
    eventsSeen = event.number;
    if (event.severity === 2 || event.text.includes(" -> ")) lastMode = event.mode;  // not of a warning
    addEvent(event);
    noteExcitation(event);
    noteSpeed(event);
    if (event.severity === 2) showTrip(event);
  },
  convergence(convergence) {
    addConvergence(convergence);
    due.add(drawConvergence);
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

const everything = [drawOrbits, drawTraces, drawSpectrum, drawWaterfall, drawOverSpeed, drawTiming, drawScope, drawConvergence];
const drawAll = () => everything.forEach((part) => due.add(part));
wireControls();
wireExcitation();
wireMarker(drawAll);
wireOverSpeed(drawAll);
wireRecord();
wireScope();
wireTime(drawAll);
wireViews(drawAll);
window.addEventListener("resize", drawAll);
listen(handlers, showConnection);
requestAnimationFrame(draw);
