"""Lint rules by subject, a function each; what is said of them to people stands in `explaining/rules.md`."""

from functools import cache
from importlib import import_module
from pkgutil import iter_modules

from mindlang.lint.study import RULES, Rule


@cache
def all_rules() -> dict[str, Rule]:
    """Every rule by its code."""
    for module in iter_modules(__path__):
        import_module(f"{__name__}.{module.name}")
    return dict(sorted(RULES.items()))
