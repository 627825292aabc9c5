"""A rate for each tick in a file that leaves the tick to others.

`drain 0.00005` is what the battery loses in a tick, however long that is, and here the minds that use the file say how
long: with twice the tick, the battery lasts twice as long. `drain 0.003 per s` stays what it is, and `per tick` says
that it is meant so.
"""

from collections.abc import Iterator

from mindrun.kinds.registry import arguments, kinds
from mindrun.numbers.quantity import Quantity

from mindlang.compiler.diagnostic import Label
from mindlang.compiler.syntax import Amount, Argument, Declaration, Name, Numbers, Tick, Use, of_form
from mindlang.lint.study import Finding, Found, Study

PARTS = "-- parts.mind --\nsensor battery is battery drain {}\n"
USE = 'use "parts.mind"\nskill Go is rule\n  reads battery\n  drives left_wheel at battery\n'
GOOD = (USE + PARTS.format("0.003 per s"), USE + PARTS.format("0.00005 per tick"))
BAD = USE + PARTS.format("0.00005")


def check(study: Study) -> Found:
    main, *others = study.mind.files
    uses = {(use.span.source.folder / use.path).resolve(): use for use in reversed(of_form(main.settings, Use))}
    for file in (file for file in others if not of_form(file.settings, Tick)):
        use = uses.get(file.source.path)
        bare = [rate for each in file.declarations for rate in _rates(each) if not _tells_time(study, rate)]
        if use and bare:
            labels = (Label(argument.span, "for each tick, however long that is") for argument in bare)
            hint = "Write there how much it is in a second, such as drain 0.003 per s, or add per tick."
            yield Finding(use.span, f"What {use.path} says for each tick depends on the tick here.", hint, (*labels,))


def _rates(declaration: Declaration) -> Iterator[Argument]:
    """The arguments of a declaration that are rates."""
    phrase = declaration.header.phrase
    cls = kinds(declaration.header.noun.text).get(phrase.kind.text) if phrase else None
    if phrase and cls:
        rates = {each.key for each in arguments(cls) if isinstance(each.type, Quantity) and each.type.rate}
        yield from (argument for argument in phrase.arguments if argument.key.text in rates)


def _tells_time(study: Study, argument: Argument) -> bool:
    """True if a rate says per which time it is, itself or where its number is declared."""
    match argument.value:
        case Numbers(amounts=(Amount(per=per, name=""),)):
            return bool(per)
        case Numbers(amounts=(Amount(name=name),)) | Name(text=name):
            return bool(study.mind.numbers[name][2])
    return True
