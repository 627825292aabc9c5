"""Frames, pipes and a process behind them: what `sim.outside` steps its environments with."""
