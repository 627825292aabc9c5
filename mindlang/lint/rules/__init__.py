"""Lint rules, one a file: docstring = explanation, GOOD and BAD = one example or several, `check` = the rule."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pkgutil import iter_modules

from mindlang.lint.study import Found, Study


@dataclass(frozen=True, slots=True)
class Rule:
    """A rule: its code, its explanation, minds that it has nothing to say of and minds that it does, and its check.

    What is of no use here may be of use `elsewhere`, in a mind that uses this one.
    """

    code: str
    text: str
    good: tuple[str, ...]
    bad: tuple[str, ...]
    check: Callable[[Study], Found]
    elsewhere: bool


@cache
def all_rules() -> dict[str, Rule]:
    """Every rule by its code: the name of its module with dashes."""
    return {rule.code: rule for rule in (_rule(module.name) for module in iter_modules(__path__))}


def _rule(name: str) -> Rule:
    module = import_module(f"{__name__}.{name}")
    text, elsewhere = (module.__doc__ or "").strip(), getattr(module, "ELSEWHERE", False)
    good, bad = ((minds,) if isinstance(minds, str) else minds for minds in (module.GOOD, module.BAD))
    return Rule(name.replace("_", "-"), text, good, bad, module.check, elsewhere)
