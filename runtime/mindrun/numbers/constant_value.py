"""What an expression of numbers alone comes to, as `mindrun.numbers.evaluation` has it, without numpy."""

from array import array
from collections.abc import Callable, Mapping
from math import copysign, inf, isnan, nan
from operator import ge, gt, le, lt

from mindrun.numbers.expression import Program, fold

COMPARISONS: Mapping[str, Callable[[float, float], bool]] = {"<": lt, "<=": le, ">": gt, ">=": ge}


def constant_value(program: Program) -> float:
    """Its value in float64; inf or NaN for a division by zero."""
    return fold(program, _leaf, _negated, _combined)


def single(value: float) -> float:
    """The float32 that is nearest, inf where it is beyond all of them."""
    return array("f", [value])[0]


def _leaf(_: str, number: float) -> float:
    return float(number)


def _negated(value: float) -> float:
    return -value


def _combined(operator: str, left: float, right: float) -> float:
    match operator:
        case "+":
            return left + right
        case "-":
            return left - right
        case "*":
            return left * right
        case "/":
            return _quotient(left, right)
        case "least" | "and":
            return right if right < left or isnan(right) else left
        case "greatest" | "or":
            return right if right > left or isnan(right) else left
    return nan if isnan(left) or isnan(right) else float(COMPARISONS[operator](left, right))


def _quotient(left: float, right: float) -> float:
    if right:
        return left / right
    return nan if isnan(left) or not left else copysign(inf, left) * copysign(1.0, right)
