"""Which input or output of one skill stands for which of another."""

from collections.abc import Mapping, Sequence


def counterparts(of: Sequence[str], among: Sequence[str], heirs: Mapping[str, str]) -> dict[str, str] | None:
    """For each of these names the other skill's that it stands for, none where it is new; None if it cannot be told.

    The same name stands for itself, and a skill for the one with whose weights it begins (`heirs`). What else only the
    other one has is stood for by the only one of the same width that the other does not have. Of a width of which
    nothing is missing then, all that is left is new. Names say their width as in a lock: proximity:10.
    """
    found = {name: name for name in of if name in among}
    found |= {name: heirs[name] for name in of if heirs.get(name) in among and heirs[name] not in found}
    if len(set(found.values())) < len(found):
        return None
    own = [name for name in of if name not in found]
    for missing in [name for name in among if name not in found.values()]:
        standing = [name for name in own if _width(name) == _width(missing) and name not in found]
        if len(standing) != 1:
            return None
        found[standing[0]] = missing
    return found


def _width(name: str) -> str:
    return name.partition(":")[2]
