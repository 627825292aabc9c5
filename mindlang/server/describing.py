"""Kinds and their arguments in words, from the docstrings and annotations that they are made of."""

from inspect import cleandoc
from math import inf, isclose
from typing import Any

from mindrun.quantity import Quantity, Reference, Span
from mindrun.registry import Argument, arguments

from mindlang.compiler.diagnostic import a, listed

SHAPE_WORDS = {
    "list": ", several of them",
    "span": ", or a range of them",
    "extent": ", or two of them",
    "place": ", along x and along y",
    "places": ", along x and along y",
}


def kind_card(noun: str, name: str, cls: type[Any]) -> str:
    """A kind with its documentation and its arguments."""
    lines = [f"**{name}**, {a('scene' if noun == 'task' else noun)}", "", cleandoc(cls.__doc__ or "")]
    if parameters := arguments(cls):
        lines += ["", *(f"- {argument_line(parameter)}" for parameter in parameters)]
    return "\n".join(lines)


def argument_card(kind: str, parameter: Argument, cls: type[Any]) -> str:
    """An argument of a kind."""
    return f"{argument_line(parameter)}\n\nof **{kind}**: {cleandoc(cls.__doc__ or '')}"


def argument_line(parameter: Argument) -> str:
    """An argument in a line: what it means, its units, its default."""
    default = "required" if parameter.required else f"default {written(parameter)}"
    return f"`{parameter.key}` {meaning(parameter)} ({default})"


def meaning(parameter: Argument) -> str:
    """What an argument takes."""
    match parameter.type:
        case Reference(noun, words):
            return listed(words) if words else f"the name of {a(noun)}"
        case Quantity() as quantity:
            units = [unit for unit in quantity.units if unit and unit not in quantity.name]
            with_unit = f" in {listed(units)}" if units and "" not in quantity.units else ""
            also = f", also in {listed(units)}" if units and "" in quantity.units else ""
            many = SHAPE_WORDS.get(parameter.shape, "")
            return f"{quantity.name}{with_unit}{also}{many}{_bounds(quantity)}"


def written(parameter: Argument) -> str:
    """The default of an argument as it would be written."""
    value, type_ = parameter.default, parameter.type
    if not isinstance(type_, Quantity):
        return str(value)
    unit, factor = next(iter(type_.units.items()))
    match value:
        case Span(first, last, by):
            text = _figure(first / factor)
            text += f" to {_figure(last / factor)}" if last != first else ""
            text += f" by {_figure(by / factor)}" if by else ""
        case ():
            return "none"
        case tuple():
            text = " ".join(_figure(each / factor) for each in value)
        case _:
            text = _figure(value / factor)
    return "as the scene says" if text == "-1" else f"{text} {unit}".strip()


def _bounds(quantity: Quantity) -> str:
    plain = any(isclose(factor, 1) for unit, factor in quantity.units.items() if unit != "%")
    if not plain or quantity.high == inf or "between" in quantity.name:
        return ""
    return f", {quantity.low:.15g} to {quantity.high:.15g}"


def _figure(number: float) -> str:
    return f"{number:.6g}"
