"""A number of ticks in words."""


def ticks(count: int) -> str:
    """1 tick, or 1,200 ticks."""
    return "1 tick" if count == 1 else f"{count:,} ticks"
