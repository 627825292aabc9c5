"""Expressions: `mindrun.numbers.stack_machine`, compiled."""

from mindrun.numbers import stack_machine
from mindrun.sim.arithmetic import compiled_lane

evaluate = compiled_lane(stack_machine.evaluate)
