// The values at the cursor, or under the finger, in a box beside it; pictures over one and the same
// time have it at one time.
//
// The cursor is an element over the picture: it is moved, and nothing is drawn again for it.

const HIDDEN = { left: -10, top: -10 };
const groups = new Map();  // what is common (name) -> {plots, the one under the pointer}

function join(plot, common) {
  if (!groups.has(common)) groups.set(common, { plots: new Set(), leader: null, leading: false });
  const group = groups.get(common);
  group.plots.add(plot);
  plot.hooks.destroy = [...(plot.hooks.destroy ?? []), () => {
    group.plots.delete(plot);
    if (group.leader === plot) group.leader = null;
    if (group.plots.size === 0) groups.delete(common);
  }];
  return group;
}

/** The others of the group take the leader's cursor: its time, wherever that lies in them. */
function lead(group) {
  if (!group.leader || group.leading) return;
  group.leading = true;
  const { left } = group.leader.cursor;
  const x = group.leader.posToVal(left, "x");
  for (const plot of group.plots) {
    if (plot === group.leader) continue;
    const there = left < 0 ? -1 : plot.valToPos(x, "x");
    plot.setCursor(there >= 0 && there <= plot.over.clientWidth ? { left: there, top: 0 } : HIDDEN);
  }
  group.leading = false;
}

/** `channels`, `where` and `common` as makePlot takes them. */
export function followCursor(plot, channels, where, common) {
  const box = document.createElement("div");
  box.className = "values";
  box.hidden = true;
  plot.over.append(box);
  const group = join(plot, common ?? plot);
  const show = () => {
    const { idx, left } = plot.cursor;
    box.hidden = idx == null || left < 0 || plot.data[0][idx] === undefined;
    if (!box.hidden) {
      const lines = [where(plot.data[0][idx]), ...channels.filter((one) => !one.hidden && one.value).map((one) => `${one.name}  ${one.value(plot)}`)];
      box.textContent = lines.join("\n");
      const right = left > plot.over.clientWidth / 2;  // not under the cursor, not outside
      box.style.left = right ? "" : `${left + 10}px`;
      box.style.right = right ? `${plot.over.clientWidth - left + 10}px` : "";
    }
    lead(group);  // also when one of them was drawn anew: its time has moved on
  };
  plot.hooks.setCursor = [...(plot.hooks.setCursor ?? []), show];
  const touch = (event) => {
    group.leader = plot;
    const place = plot.over.getBoundingClientRect();
    plot.setCursor({ left: event.touches[0].clientX - place.left, top: event.touches[0].clientY - place.top });
  };
  // Before the plot's own listener of the same event moves its cursor.
  plot.root.addEventListener("mousemove", () => { group.leader = plot; }, { capture: true });
  plot.over.addEventListener("touchstart", touch, { passive: true });
  plot.over.addEventListener("touchmove", touch, { passive: true });
  plot.over.addEventListener("touchend", () => plot.setCursor(HIDDEN));
}
