"""It fails when it is imported."""

FRACTION = 1 / 0
