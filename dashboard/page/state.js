// The head of the page: mode, speed, run time and its pace, and the trip's sentence.

const at = (id) => document.getElementById(id);
const CLASS = { levitating: "on", spinning: "on", self_test: "moving", lift: "moving", coast_down: "moving", landing: "moving", tripped: "tripped" };

// A trip's sentence foretells what the controller does next; once that is done it says so.
const RELEASED = " Done: the amplifiers carry no current any more.";
let tripped = "";

export function showRig(rig) {
  const with_ = [rig.controller && `controller ${rig.controller}`, rig.scenario && `scenario ${rig.scenario}`];
  at("rig").textContent = rig.name ? [rig.name, `${Math.round(1 / rig.period_s)} Hz`, ...with_.filter(Boolean)].join(", ") : "–";
  at("rig").title = rig.name ? `${at("rig").textContent}; Levitas ${rig.version}, ${rig.pace}, telemetry of ${rig.source || "lcm"}` : "";
}

// What acts is filled; why another one ended is in its title.
function showBlocks(blocks) {
  at("blocks-figure").hidden = blocks.length === 0;
  at("blocks").textContent = blocks.map((b) => `${b.acts ? "●" : "○"} ${b.name}`).join("  ");
  at("blocks").title = blocks.map((b) => `${b.name}: ${b.acts ? ["acts", b.why].filter(Boolean).join(", ") : b.why ? `ended, ${b.why}` : "waits for its speed and its angle"}`).join("\n");
}

/** `end`: the mode in which the run has ended, from its last event; empty while it runs. */
export function showTick(tick, end) {
  const mode = at("mode");
  const now = end || tick.mode;
  const name = now?.replace("_", " ");
  if (now !== "tripped") at("trip").hidden = true;
  if (now === "tripped" && tick.bias_ma === 0 && !end) at("trip").textContent = tripped + RELEASED;
  mode.className = "mode " + (tick.silent && now !== "tripped" ? "" : CLASS[now] ?? "");
  mode.textContent = !name ? "no controller" : end ? `ended, ${name}` : tick.silent ? "controller silent" : name;
  showBlocks(tick.blocks ?? []);
  at("bias-figure").hidden = !tick.saves_bias;
  if (tick.saves_bias) at("bias").textContent = (tick.bias_ma / 1000).toFixed(2) + " A";
  if (tick.mode) at("speed").textContent = tick.speed_rpm === null ? "not known" : tick.speed_rpm + " rpm";
}

export function showPace(text) {
  at("pace").textContent = text;
}

export function showTime(seconds) {
  at("time").textContent = seconds.toFixed(1) + " s";
}

export function showTrip(event) {
  tripped = event.text;
  at("trip").textContent = event.text;
  at("trip").hidden = false;
}
