"""Kinds of actuators, one file each. `neutral` is sent when nothing influences one and whenever something fails."""
