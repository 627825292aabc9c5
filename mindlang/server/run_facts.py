"""What may be written in a fact about how a run begins, and what differs from run to run."""

from collections.abc import Sequence

from mindlang.server.cursor_line import CursorLine
from mindlang.server.offers import NUMBER, Offer, keys, names, numbers, units, units_of, varying_parts, words

SIGNS = ("+", "-")


def starts(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    match [word for word in rest if word not in SIGNS]:
        case []:
            return words("at", "facing")
        case [*_, "facing"] | ["at"] | ["at", _]:
            return numbers(line.view)
        case [*_, "facing", _]:
            return units("deg")
        case ["at", _, _]:
            return words("facing")
    return []


def varies(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    varying = dict(varying_parts(line.view, line.above))
    match [word for word in rest if word not in SIGNS]:
        case []:
            return keys({argument.key: argument for found in varying.values() for argument in found}.values())
        case [_]:
            return [Offer("of", "word")]
        case [argument, "of"]:
            return [part for part, found in varying.items() if argument in (each.key for each in found)]
        case [argument, "of", part, *said]:
            of = [each for name, found in varying.items() if name.label == part for each in found]
            own = [units_of(each) for each in of if each.key == argument and said and said[-1][0] in NUMBER]
            found = [unit for each in own for unit in each]
            return [*found, *words("to")] if said and "to" not in said else found or numbers(line.view)
    return []


def fails(line: CursorLine, rest: Sequence[str]) -> list[Offer]:
    match rest:
        case []:
            return names(line.view, "actuator")
        case [_]:
            return numbers(line.view)
        case [*_, "per"]:
            return [*units("s"), Offer("tick", "word")]
        case [_, *_, "%"] | [_, _] if "per" not in rest:
            return [*(units("%") if rest[-1] != "%" else []), *words("per")]
    return []
