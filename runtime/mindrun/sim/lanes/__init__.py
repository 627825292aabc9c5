"""One tick of many worlds in lockstep: sense, think, act, step, judge. Every quantity is an array [row, lane]."""
