"""What the names of numbers stand for: `number sight is 12`."""

from msgspec.structs import replace
from networkx import DiGraph

from mindlang.compiler.diagnostic import Findings, Label
from mindlang.compiler.hierarchy import circles, ends_first
from mindlang.compiler.names import Names
from mindlang.compiler.syntax import Amount


def numbers(names: Names, findings: Findings) -> dict[str, Amount]:
    """The amount that each name stands for; one that stands for itself in the end is reported, and left out."""
    graph = DiGraph()
    graph.add_nodes_from(names.numbers)
    for name, number in names.numbers.items():
        if other := number.amount.name:
            graph.add_edge(name, other)
    for circle in circles(graph):
        _refuse_circle([*circle, circle[0]], names, findings)
    found: dict[str, Amount] = {}
    for name in (each for each in ends_first(graph) if each in names.numbers):
        amount = names.numbers[name].amount
        if not amount.name:
            found[name] = amount
        elif names.find(amount.constant, ("number",), findings) and amount.name in found:
            found[name] = instead(amount, found[amount.name])
    return found


def instead(use: Amount, value: Amount) -> Amount:
    """What a name with its sign stands for, in the place where it stands."""
    return replace(value, number=use.number * value.number, span=use.span, said=value.said or value.span)


def _refuse_circle(path: list[str], names: Names, findings: Findings) -> None:
    span = names.numbers[path[0]].span
    labels = [Label(names.numbers[name].span, "through this one") for name in path[1:-1]]
    message = f"A number stands for itself: {' → '.join(path)}."
    findings.error("number-circle", span, message, "Write a number in one of the lines.", *labels)
