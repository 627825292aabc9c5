"""Worlds that are environments of Gymnasium: their spaces, steppers in this or another process, and rollouts."""
