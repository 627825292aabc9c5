"""Kinds of measures: numbers for rewards, taken every tick after the step by `sim/lanes/judge.py`."""

from mindrun.measures.change import Change
from mindrun.measures.forward import Forward
from mindrun.measures.measure import MeasureKind
from mindrun.measures.progress import Advance, Progress, Retreat
from mindrun.registry import register_all

register_all(__name__, __path__)

__all__ = ["Advance", "Change", "Forward", "MeasureKind", "Progress", "Retreat"]
