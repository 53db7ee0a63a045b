// A part of the page that did not arrive leaves it without life: its modules load all or none. So
// the page is loaded again, a second later, until all of it is there. Not a module, and before every
// other part: what it watches over may be any of them.

const AGAIN_AFTER_MS = 1000;

// Errors of elements do not rise to the window; it sees them on their way down alone.
window.addEventListener("error", (event) => {
  const part = event.target;
  if (part instanceof HTMLScriptElement || part instanceof HTMLLinkElement) {
    setTimeout(() => location.reload(), AGAIN_AFTER_MS);
  }
}, true);
