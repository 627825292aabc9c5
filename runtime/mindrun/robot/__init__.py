"""A mind on a robot: what is wired to what, a loop that keeps time, and a guardian that alone moves anything."""
