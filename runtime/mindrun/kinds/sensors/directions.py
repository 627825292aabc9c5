"""Which sensors read a direction, which goes round."""

from collections.abc import Mapping, Set

from mindrun.kinds.sensors.sensor import SensorKind


def directions(kinds: Mapping[str, SensorKind]) -> Set[str]:
    """The sensors whose reading is a direction: those that say so, and those that derive one from such a source."""
    onward: dict[str, list[str]] = {}
    for name, kind in kinds.items():
        for source in kind.sources:
            onward.setdefault(source, []).append(name)
    found = {name for name, kind in kinds.items() if kind.goes_round(())}
    waiting = [*found]
    while waiting:
        new = {name for name in onward.get(waiting.pop(), ()) if kinds[name].goes_round(found)} - found
        found |= new
        waiting += new
    return found
