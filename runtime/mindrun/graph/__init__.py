"""The compiled hierarchy, its weights, and the bundle that brings both to a robot."""
