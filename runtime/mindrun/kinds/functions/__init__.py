"""Kinds of internal functions (Eq. 1): what turns a skill's inputs into its outputs. One kind a file."""

from mindrun.kinds.functions.function import Function
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.procedure import Procedure
from mindrun.kinds.functions.rule import Rule
from mindrun.kinds.registry import register_all

register_all(__name__, __path__)

__all__ = ["Function", "Mlp", "Procedure", "Rule"]
