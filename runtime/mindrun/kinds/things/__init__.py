"""Kinds of what a task's world contains."""
