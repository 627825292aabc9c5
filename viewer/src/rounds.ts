/** Curves of directions, which begin anew at 0 after 1. */

import type uPlot from "uplot";

/** Between which pixels a direction goes round, from 1 to 0 or back: no line is drawn there, nor where there were gaps. */
export function rounds(plot: uPlot, series: number, first: number, last: number, gaps: uPlot.Series.Gaps): uPlot.Series.Gaps {
  const [times, values] = [plot.data[0], plot.data[series]];
  for (let i = first + 1; i <= last; i++)
    if (Math.abs(values[i]! - values[i - 1]!) > 0.5) gaps.push([plot.valToPos(times[i - 1], "x", true), plot.valToPos(times[i], "x", true)]);
  return gaps.sort(([one], [other]) => one - other);
}
