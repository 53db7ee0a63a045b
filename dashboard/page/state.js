// The head of the page: mode, speed, run time and its pace, and the trip's sentence.

const at = (id) => document.getElementById(id);
const CLASS = { levitating: "on", spinning: "on", self_test: "moving", lift: "moving", coast_down: "moving", landing: "moving", tripped: "tripped" };

export function showRig(rig) {
  at("rig").title = rig.name ? `Levitas ${rig.version}, telemetry of ${rig.source || "lcm"}` : "";
  at("rig").textContent = rig.name ? `${rig.name}, ${Math.round(1 / rig.period_s)} Hz, ${rig.pace}` : "–";
}

export function showTick(tick, ended) {
  const mode = at("mode");
  const name = tick.mode?.replace("_", " ");
  if (tick.mode !== "tripped") at("trip").hidden = true;
  mode.className = "mode " + (tick.silent && tick.mode !== "tripped" ? "" : CLASS[tick.mode] ?? "");
  if (tick.silent) {
    mode.textContent = !name ? "no controller" : ended ? `ended, ${name}` : "controller silent";
    return;
  }
  mode.textContent = name;
  at("speed").textContent = tick.speed_rpm === null ? "not known" : tick.speed_rpm + " rpm";
}

export function showPace(text) {
  at("pace").textContent = text;
}

export function showTime(seconds) {
  at("time").textContent = seconds.toFixed(1) + " s";
}

export function showTrip(event) {
  at("trip").textContent = event.text;
  at("trip").hidden = false;
}
