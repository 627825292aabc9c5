"""Drivers, one file each, called as in robot.yaml: what a sensor or an actuator of a mind is wired to."""
