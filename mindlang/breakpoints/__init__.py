"""Breakpoints in a file: in which ticks of a run somebody wants to look at it."""

SUFFIX = ".break"  # of the name of such a file
