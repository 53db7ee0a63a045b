// What happened, newest first; the program's own sentences.

const MOST = 200;
const CLASS = ["", "warning", "trip-event"];
const list = document.getElementById("events");

export function addEvent(event) {
  const line = document.createElement("li");
  line.className = CLASS[event.severity] ?? "";
  const time = document.createElement("time");
  time.textContent = event.time_s.toFixed(3) + " s";
  line.append(time, event.text);
  list.prepend(line);
  while (list.children.length > MOST) list.lastChild.remove();
}
