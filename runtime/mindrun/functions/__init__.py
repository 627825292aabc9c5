"""Kinds of internal functions (Eq. 1): what turns a skill's inputs into its outputs. One kind a file."""

from importlib import import_module
from pkgutil import iter_modules

from mindrun.functions.function import Compute, Function
from mindrun.functions.mlp import Mlp
from mindrun.functions.procedure import Procedure
from mindrun.functions.rule import Rule

for _module in iter_modules(__path__):
    import_module(f"{__name__}.{_module.name}")

__all__ = ["Compute", "Function", "Mlp", "Procedure", "Rule"]
