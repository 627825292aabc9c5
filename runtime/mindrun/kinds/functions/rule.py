"""A rule: every edge says its own value."""

from dataclasses import dataclass

from mindrun.kinds.functions.function import Function
from mindrun.kinds.registry import kind


@kind("skill", "rule")
@dataclass(frozen=True, slots=True)
class Rule(Function):
    """No function of its own: every edge of the skill has `at`."""

    has_outputs = False
