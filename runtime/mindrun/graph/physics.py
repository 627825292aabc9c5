"""Which physics a simulated world is computed by: pymunk's, which brings Chipmunk, and our own."""

from importlib.metadata import PackageNotFoundError, version

# One more with each change after which a run of the same seed can be another: how bodies move, what is solid, how a
# world begins, what sensors measure. Weights that were taught before are then said to be taught elsewhere.
WORLD_VERSION = 1


def physics() -> dict[str, str | int]:
    """The versions of both; "" where pymunk is not installed."""
    try:
        found = version("pymunk")
    except PackageNotFoundError:
        found = ""
    return {"pymunk": found, "world": WORLD_VERSION}
