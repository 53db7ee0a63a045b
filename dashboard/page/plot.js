// uPlot with this page's manners: small type, no cursor, size of its box.

const FONT = "11px system-ui, 'DejaVu Sans', sans-serif";

/**
 * options: series, y {floor: [low, high] always shown, log}, x {label values}, draw(plot) on top.
 */
export function makePlot(box, { series, y = {}, x = {}, draw = () => {} }) {
  const range = (plot, low, high) => {
    if (y.range) return y.range;
    const [least, most] = y.floor ?? [0, 1];
    const room = 0.05 * Math.max(high - low, 1e-9);
    return [Math.min(least, (low ?? 0) - room), Math.max(most, (high ?? 0) + room)];
  };
  const axis = { font: FONT, stroke: "#5a6775", grid: { stroke: "#e8ecef", width: 1 }, ticks: { show: false } };
  const options = {
    width: Math.max(box.clientWidth, 120),
    height: Math.max(box.clientHeight, 80),
    cursor: { show: false },
    legend: { show: false },
    padding: [6, 8, 0, 0],
    scales: { x: { time: false, ...x.scale }, y: { range, distr: y.log ? 3 : 1 } },
    axes: [{ ...axis, size: 22, gap: 2 }, { ...axis, size: 44, gap: 2, ...y.axis }],
    series: [{}, ...series],
    hooks: { draw: [draw] },
  };
  const plot = new uPlot(options, [[0], ...series.map(() => [null])], box);
  plot.box = box;
  label(box, series);
  return plot;
}

/** Names of the lines in their colours, top right. */
function label(box, series) {
  box.querySelector(".names")?.remove();
  const names = document.createElement("div");
  names.className = "names";
  for (const one of series) {
    const name = document.createElement("span");
    name.textContent = one.label;
    name.style.color = one.colour ?? one.stroke;
    names.append(name);
  }
  box.append(names);
}

export function fit(plot) {
  const width = plot.box.clientWidth;
  const height = plot.box.clientHeight;
  if (width > 0 && (Math.abs(plot.width - width) > 1 || Math.abs(plot.height - height) > 1)) plot.setSize({ width, height });
}
