"""A rate for each tick in a file that leaves the tick to others.

`drain 0.00005` is what the battery loses in a tick, however long that is, and here the minds that use the file say how
long: with twice the tick, the battery lasts twice as long. `drain 0.003 per s` stays what it is, and `per tick` says that
it is meant so.
"""

from collections.abc import Iterator

from mindrun.quantity import Quantity
from mindrun.registry import arguments, kinds

from mindlang.analysis.study import Finding, Found, Study
from mindlang.compiler.syntax import Amount, Argument, Declaration, Name, Numbers, Tick

PARTS = "-- parts.mind --\nsensor battery is battery drain {}\n"
USE = 'use "parts.mind"\nskill Go is rule\n  reads battery\n  drives left_wheel at battery\n'
GOOD = (USE + PARTS.format("0.003 per s"), USE + PARTS.format("0.00005 per tick"))
BAD = (USE + PARTS.format("0.00005"),)


def check(study: Study) -> Found:
    """Rates of used files that do not say for how long they are."""
    for file in study.mind.files:
        if any(isinstance(setting, Tick) for setting in file.settings):
            continue
        for argument in (each for declaration in file.declarations for each in _rates(declaration)):
            if not _said_per(study, argument):
                said = f"{argument.key.text} {argument.value.span.text}"
                hint = f"Write how much it is in a second, such as {argument.key.text} 0.003 per s, or {said} per tick."
                message = "This is for each tick, and how long that is, is said elsewhere."
                yield Finding(argument.value.span, message, hint)


def _rates(declaration: Declaration) -> Iterator[Argument]:
    """The arguments of a declaration that are rates."""
    phrase = declaration.header.phrase
    cls = kinds(declaration.header.noun.text).get(phrase.kind.text) if phrase else None
    if phrase and cls:
        rates = {each.key for each in arguments(cls) if isinstance(each.type, Quantity) and each.type.rate}
        yield from (argument for argument in phrase.arguments if argument.key.text in rates)


def _said_per(study: Study, argument: Argument) -> bool:
    """Whether a rate says for how long it is, itself or where its number is declared."""
    match argument.value:
        case Numbers(amounts=(Amount(per=per, name=""),)):
            return bool(per)
        case Numbers(amounts=(Amount(name=name),)) | Name(text=name):
            return bool(study.mind.numbers[name][2])
    return True
