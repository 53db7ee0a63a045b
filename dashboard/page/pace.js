// How fast the rig's time runs against the clock: "4.7 × real time". In lockstep that is whatever
// the machine makes of it, held to the clock it is the factor asked for, in real time one.

const SPAN_NS = 2e9;
const LEAST_NS = 5e8;

let seen = [];  // [clock ns, rig s], the last two seconds

/** Takes a tick; the ratio, or null while too little is known. */
export function pace(tick, period_s) {
  if (tick.silent || !tick.sent_ns || !period_s) {
    seen = [];
    return null;
  }
  const point = [tick.sent_ns, tick.cycle * period_s];
  if (seen.length > 0 && point[1] < seen.at(-1)[1]) seen = [];  // another run
  seen.push(point);
  while (seen.length > 2 && point[0] - seen[1][0] >= SPAN_NS) seen.shift();
  const clock_s = (point[0] - seen[0][0]) / 1e9;
  return clock_s * 1e9 < LEAST_NS ? null : (point[1] - seen[0][1]) / clock_s;
}

/** "4.7 × real time"; a dash for null. */
export function paceText(ratio) {
  if (ratio === null) return "–";
  const digits = ratio >= 9.95 ? 0 : ratio >= 0.095 ? 1 : 2;
  return `${ratio.toFixed(digits)} × real time`;
}
