// A part of the page that did not arrive leaves it without life: its modules load all or none. So
// the page is loaded again, a second later and when the program answers, until all of it is there.
// Not a module, and before every other part: it watches over all of them but itself.

const AGAIN_AFTER_MS = 1000;

function again() {
  setTimeout(() => fetch(location.href).then(() => location.reload(), again), AGAIN_AFTER_MS);
}

// Errors of elements do not rise to the window; it sees them on their way down alone.
window.addEventListener("error", (event) => {
  const part = event.target;
  if (part instanceof HTMLScriptElement || part instanceof HTMLLinkElement) again();
}, true);
