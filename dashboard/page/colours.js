// Colours that people with colour blindness can tell apart: Okabe & Ito (2008) for lines, and for
// heights a scale that rises in lightness alone would carry it (after viridis, van der Walt & Smith).

export const LINES = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#888888"];
const TINT = 0.28;
export const lineColour = (i) => LINES[i % LINES.length];
/** The colour as a tint on white: no transparency, which would make grey of two that overlap. */
export function lineTint(i) {
  const parts = [1, 3, 5].map((at) => parseInt(lineColour(i).slice(at, at + 2), 16));
  return `rgb(${parts.map((part) => Math.round(255 - TINT * (255 - part))).join(" ")})`;
}
/** Dash patterns say the same as the colours do. */
export const lineDash = (i) => [[], [6, 3], [2, 2], [8, 2, 2, 2]][i % 4];

const STOPS = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];

/** [r, g, b] of a share from 0 to 1. */
export function heat(share) {
  const place = Math.min(Math.max(share, 0), 1) * (STOPS.length - 1);
  const low = Math.min(Math.floor(place), STOPS.length - 2);
  return STOPS[low].map((from, i) => from + (STOPS[low + 1][i] - from) * (place - low));
}
