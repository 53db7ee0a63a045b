// The head of the page: mode, speed, run time, connection, and the trip's sentence.

const at = (id) => document.getElementById(id);
const CLASS = { levitating: "on", spinning: "on", self_test: "moving", lift: "moving", coast_down: "moving", landing: "moving", tripped: "tripped" };

export function showRig(rig) {
  at("rig").textContent = rig.name ? `${rig.name}, ${rig.pace}, ${Math.round(1 / rig.period_s)} Hz, from ${rig.source || "lcm"}` : "–";
}

export function showTick(tick) {
  const mode = at("mode");
  if (tick.silent) {
    mode.textContent = tick.mode ? "controller silent" : "no controller";
    mode.className = "mode";
    return;
  }
  mode.textContent = tick.mode.replace("_", " ");
  mode.className = "mode " + (CLASS[tick.mode] ?? "");
  at("speed").textContent = tick.speed_rpm === null ? "not known" : tick.speed_rpm + " rpm";
  if (tick.mode !== "tripped") at("trip").hidden = true;
}

export function showTime(seconds) {
  at("time").textContent = seconds.toFixed(1) + " s";
}

export function showTrip(event) {
  at("trip").textContent = event.text;
  at("trip").hidden = false;
}

export function showConnection(state) {
  const place = at("connection");
  place.textContent = state === "live" ? "live" : "connection lost, trying again";
  place.className = "connection" + (state === "live" ? "" : " lost");
}
