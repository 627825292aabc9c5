"""The units of kinds: the lane function of each sensor and each skill, compiled when a mind first uses it."""

from threading import Lock
from typing import Any

from mindrun.sim.codes import SENSOR, SKILL, Tables
from mindrun.sim.state import MindState, Senses
from mindrun.sim.units import UNITS, Form, Unit

read = Form((Tables, Senses, int, int, SENSOR), None)
compute = Form((Tables, MindState, SKILL, int), int)

_MAKING = Lock()


def unit_of(kind: Any, form: Form) -> Unit:
    """The unit of a kind's lane function: `read` is the form of a sensor's, `compute` that of a skill's function."""
    lane = kind.lane
    with _MAKING:  # there is never another one: tables have the place of its slot
        return UNITS.get(f"{lane.__module__}.{lane.__qualname__}") or Unit(lane, form, lambda tables: True)
