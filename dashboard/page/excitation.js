// Test signals: the form asks, the controller decides. Whether one runs is read from its events.

import { ask } from "./controls.js";

// Beside amplitude and time, by kind: [key, label, value]. Keys are those of scenario files.
const KINDS = {
  chirp: [["from_hz", "from, Hz", 10], ["to_hz", "to, Hz", 400], ["repeat_s", "sweep, s", 2]],
  multisine: [["from_hz", "from, Hz", 10], ["to_hz", "to, Hz", 400], ["repeat_s", "period, s", 1]],
  stepped_sine: [["from_hz", "from, Hz", 20], ["to_hz", "to, Hz", 200], ["frequencies", "steps", 10], ["dwell_s", "each, s", 0.5]],
  prbs: [["order", "order", 12], ["divisor", "cycles/bit", 4]],
  impulse: [["width_ms", "width, ms", 1], ["every_s", "every, s", 0.5]],
};

const form = document.getElementById("excitation");
const line = document.getElementById("excitation-answer");
const field = (name) => form.elements[name];

function showFields() {
  const labels = KINDS[field("signal").value].map(([key, text, value]) => {
    const label = document.createElement("label");
    const input = document.createElement("input");
    Object.assign(input, { name: key, type: "number", step: "any", min: "0", value, required: true });
    label.append(text + " ", input);
    return label;
  });
  document.getElementById("signal-fields").replaceChildren(...labels);
}

const intoCurrent = () => field("point").value === "control_current";

function showUnit() {
  document.getElementById("amplitude-unit").textContent = intoCurrent() ? "amplitude, A" : "amplitude, µm";
  field("amplitude").value = intoCurrent() ? 0.1 : 2;
}

function request() {
  const signal = field("signal").value;
  const one = { channel: field("channel").value, signal, point: field("point").value };
  one[intoCurrent() ? "amplitude_a" : "amplitude_um"] = Number(field("amplitude").value);
  for (const [key] of KINDS[signal]) one[key] = Number(field(key).value);
  return { hold_s: Number(field("hold_s").value), orbit_limit_um: Number(field("orbit_limit_um").value), excitation: [one] };
}

export function wireExcitation() {
  field("signal").replaceChildren(...Object.keys(KINDS).map((kind) => new Option(kind.replace("_", " "), kind)));
  field("signal").addEventListener("change", showFields);
  field("point").addEventListener("change", showUnit);
  showFields();
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    ask(line, "api/excitation", request(), "start");
  });
  document.getElementById("excitation-end").addEventListener("click", () =>
    ask(line, "api/command", { command: "end_excitation" }, "end"));
}

export function setUpExcitation(rig) {
  field("channel").replaceChildren(...rig.channels.map((name) => new Option(name)));
  field("orbit_limit_um").value = Math.round(rig.clearance_m * 0.3 * 1e6);  // zone A, as in scenario files
  showRunning(false);
}

function showRunning(running) {
  document.getElementById("excited").hidden = !running;
}

/** The controller's own word on test signals; a trip ends them, too. */
export function noteExcitation(event) {
  if (event.text.startsWith("command excite (")) showRunning(true);
  if (event.text.startsWith("command end_excitation (") || event.severity === 2) showRunning(false);
}
