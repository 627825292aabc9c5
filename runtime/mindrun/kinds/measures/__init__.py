"""Kinds of measures: numbers for rewards, taken every tick after the step by `sim/lanes/judge.py`."""

from mindrun.kinds.measures.change import Change
from mindrun.kinds.measures.forward import Forward
from mindrun.kinds.measures.measure import MeasureKind
from mindrun.kinds.measures.progress import Advance, Progress, Retreat
from mindrun.kinds.registry import register_all

register_all(__name__, __path__)

__all__ = ["Advance", "Change", "Forward", "MeasureKind", "Progress", "Retreat"]
