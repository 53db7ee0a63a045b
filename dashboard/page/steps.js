// Which buttons mean something in the present mode, and what the next step is.
//
// From the mode table (docs/safety.md): a command that would be refused is not offered. The
// emergency stop always is, and everything is where no controller is heard: it may still hear us.

const ALLOWED = {
  off: ["lift"],
  self_test: ["land"],
  lift: ["land"],
  levitating: ["spin", "land"],
  spinning: ["spin", "coast_down", "land"],
  coast_down: ["spin", "coast_down", "land"],
  landing: [],
  tripped: ["reset"],
};
const STANDING = ["land", "reset"];  // only of a rotor that stands
const NEXT = {
  off: "Next: Lift.",
  self_test: "Being tested; lifting follows.",
  lift: "Being lifted.",
  levitating: "Next: Spin, or Land.",
  spinning: "Next: another speed (0 to stop), or Coast.",
  coast_down: "Slowing down. Spin to 0 brakes.",
  landing: "Being lowered.",
  tripped: "Next: Reset, once the rotor stands.",
};
const SILENT = "No controller is heard; commands are sent all the same.";
const ENDED = "The run has ended. The next begins with amb run.";

const next = document.getElementById("next");
const buttons = [...document.querySelectorAll("[data-command]")];
const ofTheRun = [...document.querySelectorAll("#excitation button, #scope button")];
let shown = "";

function turns(tick) {
  return tick.speed_rpm !== null && Math.abs(tick.speed_rpm) >= 1;
}

/** The commands worth a button, and the sentence for the next step. */
export function steps(tick, ended) {
  const all = buttons.map((button) => button.dataset.command);
  if (ended) return [[], ENDED];
  if (tick.silent || !ALLOWED[tick.mode]) return [all, SILENT];
  const open = ALLOWED[tick.mode].filter((command) => !STANDING.includes(command) || !turns(tick));
  return [open, tick.mode === "tripped" && !turns(tick) ? "Next: Reset." : NEXT[tick.mode]];
}

export function showSteps(tick, ended) {
  const [open, sentence] = steps(tick, ended);
  const now = open.join() + sentence;
  if (now === shown) return;
  shown = now;
  for (const button of buttons) button.disabled = !open.includes(button.dataset.command);
  for (const button of ofTheRun) button.disabled = Boolean(ended);
  next.textContent = sentence;
}
