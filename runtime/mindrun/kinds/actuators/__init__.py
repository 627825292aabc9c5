"""Kinds of actuators. `neutral` is sent when nothing influences one and whenever something fails."""
