// Buttons and keys. Nothing is assumed: the answer line shows what the controller said.

import { ended } from "./freshness.js";
import { send } from "./link.js";

/** Sends a request and shows on the line what came of it; its outcome. */
export async function ask(line, path, request, doing) {
  line.className = "answer wait";
  line.textContent = doing + " …";
  const reply = await send(path, request);
  line.className = "answer " + (reply.outcome === "accepted" ? "good" : "bad");
  const nobody = reply.outcome === "unanswered" && ended();
  line.textContent = `${reply.outcome}: ${nobody ? "the run has ended, nothing is there to act" : reply.text}`;
  return reply.outcome;
}

const answer = document.getElementById("answer");
const command = (request) => ask(answer, "api/command", request, request.command.replace("_", " "));
const stop = () => command({ command: "emergency_stop" });

export function wireControls() {
  document.getElementById("stop").addEventListener("click", stop);
  // Before anything else on the page can take the key, also inside an input.
  window.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    event.preventDefault();
    stop();
  }, { capture: true });
  for (const button of document.querySelectorAll("button[type=button][data-command]")) {
    button.addEventListener("click", () => command({ command: button.dataset.command }));
  }
  document.getElementById("spin").addEventListener("submit", (event) => {
    event.preventDefault();
    command({
      command: "spin",
      speed_rpm: Number(document.getElementById("rpm").value),
      acceleration_rpm_per_s: Number(document.getElementById("ramp").value),
    });
  });
}

/** The rig's own limit for the speed field. */
export function limitSpeed(rig) {
  if (!rig.max_speed_rpm) return;
  const rpm = document.getElementById("rpm");
  rpm.max = Math.round(rig.max_speed_rpm);
  document.getElementById("rpm-most").textContent = `of ${rpm.max}`;
}

/** Whoever commanded a speed, the field says it: pressed as it stands, Spin changes nothing. */
export function noteSpeed(event) {
  const asked = /^command spin to (\d+) rpm/.exec(event.text);
  const rpm = document.getElementById("rpm");
  if (asked && document.activeElement !== rpm) rpm.value = asked[1];
}
