"""What is said once for the whole mind: the tick, the unit, the master, and for which language a file was written."""

from collections.abc import Mapping, Sequence
from typing import TypeVar

from mindrun.numbers.quantity import LENGTH_OF_UNIT, TICK, Quantity

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.expand import in_place
from mindlang.compiler.names import Names
from mindlang.compiler.resolve.quantities import convert
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import Amount, File, Master, Setting, Tick, Unit, Version

LANGUAGE_VERSION = 1

S = TypeVar("S", bound=Setting)


def settings(file: File, form: type[S]) -> list[S]:
    """The settings of one word in a file."""
    return [setting for setting in file.settings if isinstance(setting, form)]


def tick_seconds(files: Sequence[File], values: Mapping[str, Amount], findings: Findings) -> float:
    """The tick in seconds."""
    return _agreed(files, Tick, TICK, values, findings) or 1.0


def unit_metres(files: Sequence[File], values: Mapping[str, Amount], findings: Findings) -> float | None:
    """How long a unit of the world is on a robot; None where nothing says it."""
    return _agreed(files, Unit, LENGTH_OF_UNIT, values, findings)


def _agreed(
    files: Sequence[File],
    form: type[Tick | Unit],
    quantity: Quantity,
    values: Mapping[str, Amount],
    findings: Findings,
) -> float | None:
    """The value of a setting, on which all files agree."""
    word = form.__name__.lower()
    first: tuple[float, Span] | None = None
    for setting in (setting for file in files for setting in settings(file, form)):
        value = convert(in_place(setting.amount, values), quantity, findings)
        if value and first and value != first[0]:
            label = Label(first[1], "first said here")
            message = f"The {word} differs from the one said before."
            findings.error(f"{word}-differs", setting.span, message, f"Use one {word}.", label)
        if value and not first:
            first = value, setting.span
    return first[0] if first else None


def master(file: File, names: Names, findings: Findings) -> str:
    """The master of the main file; those of used files do not count."""
    found = settings(file, Master)
    for again in found[1:]:
        first = Label(found[0].span, "first said here")
        findings.error("second-master", again.span, "A mind has one master.", "Leave one of the two lines out.", first)
    for setting in found[:1]:
        names.find(setting.name, ("skill",), findings)
    return found[0].name.text if found else ""


def check_versions(files: Sequence[File], findings: Findings) -> None:
    """Report files that were written for another language than this one."""
    for setting in (setting for file in files for setting in settings(file, Version)):
        amount = setting.amount
        if (amount.number, amount.unit, amount.per, amount.name) != (LANGUAGE_VERSION, "", "", ""):
            message = f"This is mind {LANGUAGE_VERSION}, and the file says {setting.span.text.strip()}."
            hint = f"Write mind {LANGUAGE_VERSION}, or take the mindc for which the file was written."
            findings.error("other-version", setting.span, message, hint)
