"""Kinds of internal functions (Eq. 1): what turns a skill's inputs into its outputs."""

from mindrun.functions.mlp import Mlp
from mindrun.functions.procedure import Procedure
from mindrun.functions.rule import Rule

Function = Mlp | Rule | Procedure

__all__ = ["Function", "Mlp", "Procedure", "Rule"]
