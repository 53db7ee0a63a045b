// Whether what is shown is still true: what is old is dimmed, and said to be old.
//
// live      a controller is heard
// silent    amb is there, but no controller has been heard for a second
// lost      amb is not there
// ended     the run is over; what is shown is its end

const place = document.getElementById("connection");
let since = performance.now();
let state = "";
let link = "lost";
let silent = false;
let over = "";

function text() {
  const seconds = Math.round((performance.now() - since) / 1000);
  switch (state) {
    case "lost": return "connection lost, trying again";
    case "ended": return "run ended";
    case "silent": return `no data for ${seconds} s`;
    default: return "live";
  }
}

function tell() {
  const now = link === "lost" ? "lost" : over ? "ended" : silent ? "silent" : "live";
  if (now !== state) {
    state = now;
    since = performance.now();
    document.body.dataset.state = state;
    place.className = "connection" + (state === "lost" || state === "silent" ? " lost" : "");
  }
  const words = text();
  if (place.textContent !== words) place.textContent = words;
}

/** "live" or "lost": whether amb answers. */
export function showConnection(now) {
  link = now;
  tell();
}

export function showSilence(now) {
  silent = now;
  tell();
}

/** The sentence of the end; empty: another run has begun. */
export function showEnd(sentence) {
  over = sentence;
  const banner = document.getElementById("ended");
  banner.hidden = !sentence;
  banner.textContent = sentence && `${sentence} This page stays until Ctrl-C in the run's terminal.`;
  tell();
}

export const ended = () => over !== "";

setInterval(tell, 1000);
