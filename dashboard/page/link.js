// The link to the program: an event stream that comes back by itself, and commands that are answered.

const token = new URLSearchParams(location.search).get("token") ?? "";

/** Calls handlers[name](data) for each message; onState("live" | "lost") when that changes. */
export function listen(handlers, onState) {
  let source = null;
  let heard = 0;
  const open = () => {
    source?.close();
    heard = performance.now();
    source = new EventSource(address("events"));
    source.onopen = () => { heard = performance.now(); onState("live"); };
    source.onerror = () => onState("lost");
    for (const [name, handler] of Object.entries(handlers)) {
      source.addEventListener(name, (message) => {
        heard = performance.now();
        onState("live");
        handler(JSON.parse(message.data));
      });
    }
  };
  open();
  // A refused or broken stream is not always tried again by the browser; this always does.
  setInterval(() => {
    if (source.readyState === EventSource.CLOSED || performance.now() - heard > 6000) {
      onState("lost");
      open();
    }
  }, 1000);
}

/** An address of this program, with the token where there is one. */
export const address = (path) => path + (token ? "?token=" + encodeURIComponent(token) : "");

/** {outcome, text}: what the controller said, or that it could not be asked. */
export async function send(path, request) {
  const headers = { "Content-Type": "application/json", "X-Levitas": "1" };
  if (token) headers["X-Levitas-Token"] = token;
  try {
    const answer = await fetch(path, { method: "POST", headers, body: JSON.stringify(request) });
    return await answer.json();
  } catch (problem) {
    return { outcome: "unanswered", text: "amb cannot be reached: " + problem.message };
  }
}
