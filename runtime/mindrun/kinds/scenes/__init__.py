"""Kinds of scenes: the borders of a task's world, and where the robot starts."""
