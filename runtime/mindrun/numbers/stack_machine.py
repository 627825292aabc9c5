"""Expressions in the simulator: a postfix program over all lanes at once, in float64.

Plain functions, which `sim/` compiles: those of sensors that are computed call them, too.
"""

from math import inf, isfinite, isnan, nan
from typing import Any

NUMBER, READING, EACH, MEASURE, COMMAND, NEGATE, ADD, SUBTRACT, MULTIPLY, DIVIDE = range(10)
LESS, LESS_EQUAL, GREATER, GREATER_EQUAL, LEAST, GREATEST, WHEN, OTHERWISE = range(10, 18)

OPERATIONS = {
    "number": NUMBER, "reading": READING, "each": EACH, "measure": MEASURE, "command": COMMAND, "negate": NEGATE,
    "+": ADD, "-": SUBTRACT, "*": MULTIPLY, "/": DIVIDE,
    "<": LESS, "<=": LESS_EQUAL, ">": GREATER, ">=": GREATER_EQUAL,
    "least": LEAST, "greatest": GREATEST, "and": LEAST, "or": GREATEST,
    "when": WHEN, "otherwise": OTHERWISE,
}  # fmt: skip


def evaluate(
    codes: Any,
    readings: Any,
    measures: Any,
    commands: Any,
    each: Any,
    stack: Any,
    active: Any,
    count: Any,
    everywhere: Any,
) -> None:
    """Leave the program's values for the lanes active[0..count] in stack[0]; `each` is the row of an "each" reading.

    With `everywhere` those are the lanes 0..count.
    """
    top = 0
    for i in range(len(codes)):
        op, arg, value = codes[i].op, codes[i].arg, codes[i].value
        if op == NUMBER:
            for k in range(count):
                stack[top, k] = value
            top += 1
        elif op in (READING, EACH):
            pick(readings[each if op == EACH else arg], stack[top], active, count, everywhere)
            top += 1
        elif op == MEASURE:
            pick(measures[arg], stack[top], active, count, everywhere)
            top += 1
        elif op == COMMAND:
            pick(commands[arg], stack[top], active, count, everywhere)
            top += 1
        elif op == NEGATE:
            for k in range(count):
                stack[top - 1, k] = -stack[top - 1, k]
        else:
            top -= 1
            combine(op, stack[top - 1], stack[top], count)


def pick(row: Any, out: Any, active: Any, count: Any, everywhere: Any) -> None:
    """Copy the values of a row in some lanes to `out`, side by side."""
    if everywhere:
        for k in range(count):
            out[k] = row[k]
    else:
        for k in range(count):
            out[k] = row[active[k]]


def combine(op: Any, left: Any, right: Any, count: Any) -> None:
    """left = left op right."""
    if op == ADD:
        for k in range(count):
            left[k] = left[k] + right[k]
    elif op == SUBTRACT:
        for k in range(count):
            left[k] = left[k] - right[k]
    elif op == MULTIPLY:
        for k in range(count):
            left[k] = left[k] * right[k]
    elif op == DIVIDE:
        for k in range(count):
            left[k] = left[k] / right[k]
    elif op == LEAST:
        for k in range(count):
            left[k] = right[k] if right[k] < left[k] or isnan(right[k]) else left[k]
    elif op == GREATEST:
        for k in range(count):
            left[k] = right[k] if right[k] > left[k] or isnan(right[k]) else left[k]
    elif op == WHEN:
        for k in range(count):
            value = left[k] if right[k] > 0 and isfinite(left[k]) else nan
            left[k] = inf if right[k] == 0 else value
    elif op == OTHERWISE:
        for k in range(count):
            left[k] = right[k] if left[k] == inf else left[k]
    else:
        compare(op, left, right, count)


def compare(op: Any, left: Any, right: Any, count: Any) -> None:
    """left = 1 where left op right, else 0; NaN where one of the two is NaN."""
    if op == LESS:
        for k in range(count):
            left[k] = _held(left[k] < right[k], left[k], right[k])
    elif op == LESS_EQUAL:
        for k in range(count):
            left[k] = _held(left[k] <= right[k], left[k], right[k])
    elif op == GREATER:
        for k in range(count):
            left[k] = _held(left[k] > right[k], left[k], right[k])
    else:
        for k in range(count):
            left[k] = _held(left[k] >= right[k], left[k], right[k])


def _held(holds: Any, a: Any, b: Any) -> Any:
    """A comparison as 1, 0 or NaN; without a branch, so that lanes go side by side."""
    found = 1.0 if holds else 0.0
    return nan if (a != a) | (b != b) else found
