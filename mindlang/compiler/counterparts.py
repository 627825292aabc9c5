"""Which input or output of one skill stands for which of another, told by their names and widths alone."""

from collections.abc import Sequence


def counterparts(of: Sequence[str], among: Sequence[str]) -> dict[str, str] | None:
    """For each of these names the other skill's that it stands for; None where that cannot be told.

    The same name stands for itself. What only one of the two has stands for the only one of the same width that only
    the other one has. Names say their width as in a lock: proximity:10.
    """
    if len(of) != len(among):
        return None
    found = {name: name for name in of if name in among}
    left = {_width(name): name for name in among if name not in of}
    for name in of:
        if name not in found:
            counterpart = left.pop(_width(name), None)
            if counterpart is None:
                return None
            found[name] = counterpart
    return found


def _width(name: str) -> str:
    return name.partition(":")[2]
