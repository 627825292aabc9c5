"""Falsification: the layouts of a task on which a mind fails, and the ranges of its numbers where it fails most."""
