// What happened, newest first; the program's own sentences.

const MOST = 200;
const CLASS = ["", "warning", "trip-event"];
const list = document.getElementById("events");

/** The sentence without its numbers; those in names (x1, b2) stay. */
const words = (text) => text.replace(/(?<!\w)-?\d[\d.]*(?!\w)/g, "#");

/** A warning that comes again with other numbers is one line with a count: it buries nothing. */
function folded(event) {
  const top = list.firstChild;
  if (event.severity !== 1 || top?.dataset.words !== words(event.text)) return false;
  top.dataset.times = Number(top.dataset.times) + 1;
  top.lastChild.textContent = `${event.text} (${top.dataset.times} times, last at ${event.time_s.toFixed(3)} s)`;
  return true;
}

export function addEvent(event) {
  if (folded(event)) return;
  const line = document.createElement("li");
  if (event.severity === 1) {
    line.dataset.words = words(event.text);
    line.dataset.times = 1;
  }
  line.className = CLASS[event.severity] ?? "";
  const time = document.createElement("time");
  time.textContent = event.time_s.toFixed(3) + " s";
  line.append(time, event.text);
  list.prepend(line);
  while (list.children.length > MOST) list.lastChild.remove();
}
