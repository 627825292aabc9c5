"""What each kind of body, actuator, sensor and thing is, and its arguments, for people: docs/kinds.md."""

from collections.abc import Iterator
from math import isinf

import mindrun.graph  # noqa: F401  (it knows all kinds)
from mindrun.quantity import Quantity, Reference, Span
from mindrun.registry import Argument, arguments, kinds

from mindlang.explaining.reference_section import reference_section

NOUNS = {"body": "Bodies", "actuator": "Actuators", "sensor": "Sensors", "content": "Things", "task": "Worlds"}
NAMED = ("thing", "sensor")
SEVERAL = {"list": "several, each ", "places": "places, each number ", "place": "two numbers, each ", "span": ""}
LEAST_SAID, MOST_SAID = 1e-3, 1e5  # bounds beyond these are for machines
ABOUT = """\
# Kinds

What stands behind `is` in a `.mind` ([language.md](language.md)), what its readings or commands mean, and what it
takes. Made from the kinds themselves: UPDATE=1 pytest tests/explain/test_kind_reference.py
"""


def all_kinds() -> str:
    """The pages of all kinds, as Markdown."""
    text = ABOUT
    for noun, title in NOUNS.items():
        text += f"\n## {title}\n\n" + "\n".join("\n".join(_lines(noun, name)) for name in sorted(kinds(noun)))
    return text


def _lines(noun: str, name: str) -> Iterator[str]:
    cls = kinds(noun)[name]
    rows = ((each.key, _what(each), _otherwise(each)) for each in arguments(cls))
    return reference_section(name, cls, name, rows)


def _what(argument: Argument) -> str:
    match argument.type:
        case Reference(noun=noun, words=words):
            name = f"the name of a {noun}" if noun in NAMED else f"a{'n' * (noun[0] in 'aeiou')} {noun}"
            return " or ".join(f"`{word}`" for word in words) if words else name
        case Quantity() as quantity:
            return SEVERAL.get(argument.shape, "") + quantity.name + _bounds(quantity)
    raise AssertionError(argument.type)


def _bounds(quantity: Quantity) -> str:
    """From where to where it can be, in its own unit, as far as a person would ask."""
    unit, factor = _unit(quantity)
    low, high = quantity.low / factor, quantity.high / factor
    said = [f"from {low:g}"] if not isinf(low) and (low == 0 or LEAST_SAID <= abs(low) < MOST_SAID) else []
    said += [f"to {high:g}"] if not isinf(high) and abs(high) < MOST_SAID else []
    if "between" in quantity.name or not (said or unit):
        return ""
    return ", " + " ".join([*said, unit] if said else ["in", unit]).strip()


def _unit(quantity: Quantity) -> tuple[str, float]:
    return next(((unit, factor) for unit, factor in quantity.units.items() if unit != "%"), ("", 1.0))


def _otherwise(argument: Argument) -> str:
    match argument.default:
        case _ if argument.required:
            return "needed"
        case None | () | Span(-1.0, -1.0):
            return "not said"
        case Span(first, last):
            return f"{first:g}" if first == last else f"{first:g} to {last:g}"
        case bool() | str() as word:
            return str(word)
        case int() | float() | tuple() as value:
            unit, factor = _unit(argument.type) if isinstance(argument.type, Quantity) else ("", 1.0)
            several = value if isinstance(value, tuple) else (value,)
            return " ".join([*(f"{each / factor:g}" for each in several), unit]).strip()
    raise AssertionError(argument.default)
