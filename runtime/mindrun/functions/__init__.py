"""Kinds of internal functions (Eq. 1): what turns a skill's inputs into its outputs. One kind a file."""

from mindrun.functions.function import Function
from mindrun.functions.mlp import Mlp
from mindrun.functions.procedure import Procedure
from mindrun.functions.rule import Rule
from mindrun.registry import register_all

register_all(__name__, __path__)

__all__ = ["Function", "Mlp", "Procedure", "Rule"]
