"""A rule, which computes nothing: every edge says its own value."""

from mindrun.kinds.functions.function import Function
from mindrun.kinds.registry import kind


@kind("skill", "rule")
class Rule(Function):
    """No function of its own: every edge of the skill has `at`."""

    has_outputs = False
