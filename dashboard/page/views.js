// Which of the page's views is shown; head and emergency stop belong to all of them.

const views = () => document.querySelectorAll("main");
const buttons = () => document.querySelectorAll("[data-view]");

function show(name) {
  for (const view of views()) view.hidden = view.id !== name;
  for (const button of buttons()) button.setAttribute("aria-pressed", String(button.dataset.view === name));
}

/** onChange is called after another view has come up: what it shows has a size only then. */
export function wireViews(onChange) {
  for (const button of buttons()) {
    button.addEventListener("click", () => {
      show(button.dataset.view);
      onChange();
    });
  }
  const follow = () => {
    const asked = location.hash.slice(1);
    if (![...views()].some((view) => view.id === asked)) return false;
    show(asked);
    return true;
  };
  follow();
  window.addEventListener("hashchange", () => { if (follow()) onChange(); });
}
