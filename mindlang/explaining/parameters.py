"""Arguments of kinds and options of drivers in words: what each takes, and its default."""

from typing import Any

from mindrun.kinds.registry import Argument
from mindrun.numbers.quantity import FARTHEST_UNITS, UNSAID, Quantity, Reference, Span
from mindrun.robot.driver_support import ADDRESS

from mindlang.compiler.diagnostic import a, listed
from mindlang.explaining.article import Parameter
from mindlang.robot.options import DriverOption

Asked = Argument | DriverOption
SHAPES = {
    "list": "several, each {}",
    "numbers": "a list, each {}",
    "words": "a list, each {}",
    "texts": "a list, each {}",
    "place": "two numbers, each {}",
    "places": "places, each number {}",
    "alternatives": "places, each number {}",
    "region": "{}, or two corners of a rectangle",
    "span": "{}, or a range of it",
    "extent": "{}, or two",
}
DECLARED = ("thing", "sensor", "servo", "skill")  # what has a name in a mind
LEAST_SAID, MOST_SAID, MOST_DEGREES = 1e-3, 99_999.0, 360.0  # bounds beyond these are for machines
UNLIMITED_NAMES = ("between", "at least", "up to")  # of quantities that say their bounds themselves


def parameter(asked: Asked, purpose: str = "") -> Parameter:
    """An argument or option in words: what it is for, where that is known, and what it takes."""
    return Parameter(asked.key, meaning(asked), None if asked.required else _default(asked), purpose)


def meaning(asked: Asked) -> str:
    """The values that an argument takes, in words."""
    shape = SHAPES.get(asked.shape, "{}")
    match asked.type:
        case Reference(noun, words) if words:
            return shape.format(listed(words))
        case Reference(noun):
            return shape.format(f"the name of {a(noun)}" if noun in DECLARED else a(noun))
        case Quantity() as quantity:
            share = ", or in %" if {"%", ""} <= quantity.units.keys() else ""
            rate = ", or so much per s" if quantity.rate else ""
            return shape.format(quantity.name) + share + rate + _bounds(quantity)


def _bounds(quantity: Quantity) -> str:
    """The bounds of a quantity in its own unit, where a person would ask for them."""
    unit, factor = _unit(quantity)
    low, high = quantity.low / factor, quantity.high / factor
    most = MOST_DEGREES if unit == "deg" else MOST_SAID
    said = [f"from {low:g}"] if low == 0 or LEAST_SAID <= abs(low) <= most else []
    said += [f"to {high:g}"] if abs(high) <= most else []
    if any(word in quantity.name for word in UNLIMITED_NAMES) or not (said or unit):
        return ""
    return ", " + " ".join([*said, unit] if said else ["in", unit]).strip()


def _unit(type_: Quantity | Reference) -> tuple[str, float]:
    """The unit in which it is said: the one that is stored, or the first."""
    units = type_.units if isinstance(type_, Quantity) else {}
    stored = ((unit, factor) for unit, factor in units.items() if factor == 1.0)
    return next(stored, next(((unit, factor) for unit, factor in units.items() if unit != "%"), ("", 1.0)))


def _default(asked: Asked) -> str:
    """The default as it would be written."""
    match asked.default:
        case bool(flag):
            return str(flag).lower()
        case None | () | "":
            return "none"
        case float(number) if number == FARTHEST_UNITS:
            return "however far"
        case Span() as span if span == UNSAID:
            return "as the scene says"
        case Span(first, last, by):
            step = f" by {_figures(asked, by)}" if by else ""
            least, most = _figures(asked, first), _figures(asked, last)
            return least if first == last else f"{least} to {most}{step}"
        case int(address) if asked.type is ADDRESS:
            return f"{address:#04x}"
        case int() | float() as number:
            return _figures(asked, number)
        case tuple() as numbers:
            return _figures(asked, *numbers)
    return str(asked.default)


def _figures(asked: Asked, *numbers: Any) -> str:
    unit, factor = _unit(asked.type)
    figures = [f"{each / factor:g}" for each in numbers]
    return " ".join([*figures, unit.removesuffix("s") if unit == "ticks" and figures == ["1"] else unit]).strip()
