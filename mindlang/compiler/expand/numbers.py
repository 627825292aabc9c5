"""What the names of numbers stand for: `number sight is 12`."""

from dataclasses import replace

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.names import Names
from mindlang.compiler.syntax import Amount


def numbers(names: Names, findings: Findings) -> dict[str, Amount]:
    """The amount that each name stands for; one that stands for itself in the end is reported, and left out."""
    found: dict[str, Amount] = {}
    done: set[str] = set()
    for name in names.numbers:
        path: list[str] = []
        while name in names.numbers and name not in done:
            done.add(name)
            path.append(name)
            name = names.numbers[name].amount.name
        if name in path:
            _refuse_circle([*path[path.index(name) :], name], names, findings)
        for each in reversed(path):
            amount = names.numbers[each].amount
            if not amount.name:
                found[each] = amount
            elif names.find(amount.constant, ("number",), findings) and amount.name in found:
                found[each] = instead(amount, found[amount.name])
    return found


def instead(use: Amount, value: Amount) -> Amount:
    """What a name with its sign stands for, in the place where it stands."""
    return replace(value, number=use.number * value.number, span=use.span, said=value.said or value.span)


def _refuse_circle(path: list[str], names: Names, findings: Findings) -> None:
    span = names.numbers[path[0]].span
    labels = [Label(names.numbers[name].span, "through this one") for name in path[1:-1]]
    message = f"A number stands for itself: {' → '.join(path)}."
    findings.error("number-circle", span, message, "Write a number in one of the lines.", *labels)
