// Buttons and keys. Nothing is assumed: the answer line shows what the controller said.

import { send } from "./link.js";

const answer = document.getElementById("answer");

async function ask(request) {
  answer.className = "answer wait";
  answer.textContent = request.command.replace("_", " ") + " …";
  const reply = await send(request);
  answer.className = "answer " + (reply.outcome === "accepted" ? "good" : "bad");
  answer.textContent = `${reply.outcome}: ${reply.text}`;
}

const stop = () => ask({ command: "emergency_stop" });

export function wireControls() {
  document.getElementById("stop").addEventListener("click", stop);
  // Before anything else on the page can take the key, also inside an input.
  window.addEventListener("keydown", (event) => {
    if (event.key !== "Escape") return;
    event.preventDefault();
    stop();
  }, { capture: true });
  for (const button of document.querySelectorAll("button[data-command]")) {
    button.addEventListener("click", () => ask({ command: button.dataset.command }));
  }
  document.getElementById("spin").addEventListener("submit", (event) => {
    event.preventDefault();
    ask({
      command: "spin",
      speed_rpm: Number(document.getElementById("rpm").value),
      acceleration_rpm_per_s: Number(document.getElementById("ramp").value),
    });
  });
}

/** The rig's own limit for the speed field. */
export function limitSpeed(rig) {
  if (rig.max_speed_rpm) document.getElementById("rpm").max = Math.round(rig.max_speed_rpm);
}
