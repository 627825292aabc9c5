"""Kinds of sensors, by subject. On a robot a driver reads those that measure, and the engine computes the others.

Every reading is a real number in 0..1. `range` and `dead_zone` are as for a range finder where a kind has them.
"""
