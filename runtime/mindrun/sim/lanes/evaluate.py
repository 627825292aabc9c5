"""Expressions: a postfix program over all lanes at once, in float64."""

from mindrun.sim.codes import ADD, DIVIDE, EACH, MEASURE, MULTIPLY, NEGATE, NUMBER, READING, SUBTRACT
from mindrun.sim.compiling import compiled


@compiled
def evaluate(codes, readings, measures, each, stack, active, count, everywhere):
    """Leave the program's values for the lanes active[0..count] in stack[0]; `each` is the row "for each" is at.

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
        elif op == NEGATE:
            for k in range(count):
                stack[top - 1, k] = -stack[top - 1, k]
        else:
            top -= 1
            combine(op, stack[top - 1], stack[top], count)


@compiled
def pick(row, out, active, count, everywhere):
    """The values of a row in some lanes, side by side."""
    if everywhere:
        for k in range(count):
            out[k] = row[k]
    else:
        for k in range(count):
            out[k] = row[active[k]]


@compiled
def combine(op, left, right, count):
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
