"""What a driver is and what it can be told, for people: `mindc explain ultrasonic`, and docs/drivers.md."""

from collections.abc import Iterator
from math import isinf

from mindrun.quantity import RATIO, Quantity, Reference
from mindrun.robot.driver_support import ADDRESS

from mindlang.compiler.diagnostic import listed
from mindlang.explaining.reference_section import reference_section
from mindlang.wiring.options import DRIVER, DriverOption, driver_options, drivers

NOUNS = ("sensor", "actuator")
ABOUT = """\
# Drivers

What `driver:` can be in a `robot.yaml` ([robot-yaml.md](robot-yaml.md)), and the options of each; `mindc explain
ultrasonic` prints one of them. Made from the drivers themselves: UPDATE=1 pytest tests/wiring/test_driver_page.py
"""


def driver_names() -> list[str]:
    """All of them, some of which are there for sensors and for actuators."""
    return sorted({name for noun in NOUNS for name in drivers(noun)})


def all_pages() -> str:
    """The pages of all drivers, as Markdown."""
    text = ABOUT
    for noun in NOUNS:
        text += f"\n## For {noun}s\n\n" + "\n".join(driver_page(name, noun) for name in sorted(drivers(noun)))
    return text


def driver_page(name: str, *nouns: str) -> str:
    """What a driver of that name is, for sensors and for actuators, as Markdown."""
    return "\n".join(line for noun in nouns or NOUNS if name in drivers(noun) for line in _lines(name, noun))


def _lines(name: str, noun: str) -> Iterator[str]:
    cls = drivers(noun)[name]
    rows = ((option.key, _what(option), _otherwise(option)) for option in driver_options(cls))
    return reference_section(name, cls, f"{DRIVER}: {name}", rows)


def _what(option: DriverOption) -> str:
    several = "a list, each " if option.shape.endswith("s") else ""
    match option.type:
        case Reference(noun=noun, words=words):
            return several + (listed([f"`{word}`" for word in words]) if words else f"a {noun}")
        case Quantity() as quantity:
            return several + quantity.name + _bounds(quantity)
    raise AssertionError(option.type)


def _bounds(quantity: Quantity) -> str:
    if quantity.name == RATIO.name:  # which says it
        return ""
    unit = _unit(quantity)
    low = "" if isinf(quantity.low) else f"from {quantity.low:g}"
    high = "" if isinf(quantity.high) else f"to {quantity.high:g}"
    said = " ".join(part for part in (low, high, unit) if part)
    return f", {said}" if low or high else f", in {unit}" if unit else ""


def _otherwise(option: DriverOption) -> str:
    match option.default:
        case _ if option.required:
            return "needed"
        case None:
            return "none"
        case bool(flag):
            return str(flag).lower()
        case int(address) if option.type is ADDRESS:
            return f"{address:#04x}"
        case int() | float() as number:
            return f"{number:g} {_unit(option.type)}".strip()
    return str(option.default)


def _unit(kind: Quantity | Reference) -> str:
    """That in which a quantity is counted."""
    return next((unit for unit, factor in getattr(kind, "units", {}).items() if factor == 1.0), "")
