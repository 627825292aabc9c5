"""A simulated world at real time, behind a socket: a process of its own, because the controller opens the sensors and
the guardian the actuators."""
