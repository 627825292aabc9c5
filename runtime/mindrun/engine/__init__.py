"""Equations 1 to 3 on numpy: one tick of the hierarchy, the reference for every other executor."""
