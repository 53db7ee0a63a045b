// The envelopes of the last ten minutes, in a ring of fixed size, and what a plot draws of them.
//
// A row: time, speed, then least and most of each channel, positions [um] before currents [A]. amb
// keeps the same rows, so a page that is opened late begins with them (dashboard/history.hpp).

import { address } from "./link.js";

const ROWS = 24000;  // 25 ms each

let axes = 0;
let width = 0;
let times = new Float64Array(0);
let values = new Float32Array(0);
let taken = 0;  // rows since the start; the newest is number taken - 1
let waiting = null;  // ticks that came while amb's rows were on their way

const kept = () => Math.min(taken, ROWS);
const at = (row) => row % ROWS;
export const newest = () => (taken > 0 ? times[at(taken - 1)] : null);
export const oldest = () => (taken > 0 ? times[at(taken - kept())] : null);

function put(time, row) {
  times[at(taken)] = time;
  values.set(row, at(taken) * width);
  ++taken;
}

function begin(channels) {
  axes = channels;
  width = 1 + 4 * axes;
  if (values.length !== ROWS * width) {
    times = new Float64Array(ROWS);
    values = new Float32Array(ROWS * width);
  }
  taken = 0;
}

function take(bytes) {
  if (bytes.byteLength < 8) return;
  const first = new DataView(bytes).getFloat64(0, true);
  const numbers = new Float32Array(bytes, 8);
  for (let i = 0; i + width < numbers.length; i += width + 1) {
    put(first + numbers[i], numbers.subarray(i + 1, i + 1 + width));
  }
}

/** Begins anew, with what amb has kept of this run. */
export async function setUpHistory(rig) {
  begin(rig.channels.length);
  const mine = (waiting = []);
  try {
    const answer = await fetch(address("api/history"), { cache: "no-store" });
    if (mine !== waiting) return;  // another run, meanwhile
    if (answer.ok) take(await answer.arrayBuffer());
  } catch {
    // Without it the history begins now.
  }
  if (mine !== waiting) return;
  waiting = null;
  mine.forEach(addHistory);
}

export function addHistory(tick) {
  if (!tick.t_ms?.length || tick.position_nm.length !== axes) return;
  if (waiting) return void waiting.push(tick);
  if (taken > 0 && tick.t_ms.at(-1) / 1000 < newest() - 1) begin(axes);  // the run began again
  const row = new Float32Array(width);
  tick.t_ms.forEach((ms, i) => {
    if (taken > 0 && ms / 1000 <= newest()) return;
    const both = (channels, unit, place) => channels.forEach((channel, axis) => {
      for (const side of [0, 1]) row[place + 2 * axis + side] = (channel[2 * i + side] ?? NaN) / unit;
    });
    row[0] = tick.rpm[i] ?? NaN;
    both(tick.position_nm, 1000, 1);
    both(tick.current_ma, 1000, 1 + 2 * axes);
    put(ms / 1000, row);
  });
}

/** Number of the first row at or after a time. */
function rowAt(time) {
  let low = taken - kept();
  let high = taken;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[at(middle)] < time) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Calls each(time, row) for every row from `from` to `to`; the row is only lent. */
export function everyRow(from, to, each) {
  for (let row = rowAt(from); row < taken && times[at(row)] <= to; ++row) {
    each(times[at(row)], values.subarray(at(row) * width, (at(row) + 1) * width));
  }
}

/**
 * Columns of a plot: time, then least and most of each channel of "position" or "current", in at
 * most `most` points; each point is the envelope of the rows that it stands for. Fills `columns`.
 */
export function envelopes(kind, from, to, most, columns) {
  const first = rowAt(from);
  const last = rowAt(to);
  const group = Math.max(1, Math.ceil((last - first) / most));
  const place = kind === "position" ? 1 : 1 + 2 * axes;
  for (let c = 0; c <= 2 * axes; ++c) columns[c] ??= [];
  let point = 0;
  // Groups lie at multiples of their size: else the picture would shimmer as it moves.
  for (let row = first - (first % group); row < last; row += group) {
    const until = Math.min(row + group, last);
    const from = Math.max(row, first);
    columns[0][point] = times[at(until - 1)];
    for (let c = 0; c < 2 * axes; ++c) {
      let value = NaN;
      for (let r = from; r < until; ++r) {
        const next = values[at(r) * width + place + c];
        if (!(c % 2 === 0 ? value <= next : value >= next)) value = Number.isNaN(next) ? value : next;
      }
      columns[c + 1][point] = Number.isNaN(value) ? null : value;
    }
    ++point;
  }
  for (const column of columns) column.length = point;  // written over: ten times a second anew is litter
  return columns;
}
