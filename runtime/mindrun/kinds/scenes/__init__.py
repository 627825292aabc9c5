"""Kinds of scenes, one file each: the borders of a task's world, and where the robot starts."""
