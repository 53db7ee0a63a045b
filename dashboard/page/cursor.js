// The values at the cursor, or under the finger, in a box beside it.

/** `channels` and `where` as makePlot takes them. */
export function followCursor(plot, channels, where) {
  const box = document.createElement("div");
  box.className = "values";
  box.hidden = true;
  plot.over.append(box);
  const show = () => {
    const { idx, left } = plot.cursor;
    box.hidden = idx == null || left < 0 || plot.data[0][idx] === undefined;
    if (box.hidden) return;
    const lines = [where(plot.data[0][idx]), ...channels.filter((one) => !one.hidden && one.value).map((one) => `${one.name}  ${one.value(plot)}`)];
    box.textContent = lines.join("\n");
    const right = left > plot.over.clientWidth / 2;  // not under the cursor, not outside
    box.style.left = right ? "" : `${left + 10}px`;
    box.style.right = right ? `${plot.over.clientWidth - left + 10}px` : "";
  };
  plot.hooks.setCursor = [...(plot.hooks.setCursor ?? []), show];
  const touch = (event) => {
    const place = plot.over.getBoundingClientRect();
    plot.setCursor({ left: event.touches[0].clientX - place.left, top: event.touches[0].clientY - place.top });
  };
  plot.over.addEventListener("touchstart", touch, { passive: true });
  plot.over.addEventListener("touchmove", touch, { passive: true });
  plot.over.addEventListener("touchend", () => plot.setCursor({ left: -10, top: -10 }));
}
