"""A rule: every edge says its own value."""

from dataclasses import dataclass

from mindrun.registry import kind


@kind("skill", "rule")
@dataclass(frozen=True, slots=True)
class Rule:
    """No function of its own: every edge of the skill has `at`."""
