"""The units of kinds: the lane function of each sensor, skill and memory, compiled when a mind first uses it."""

from threading import Lock
from typing import Any

from mindrun.sim.codes import MEMORY, SENSOR, SKILL, Tables
from mindrun.sim.state import MindState, Senses
from mindrun.sim.units import UNITS, Form, Unit

read = Form((Tables, Senses, int, int, SENSOR), None)
compute = Form((Tables, MindState, SKILL, int), int)
remember = Form((Tables, MindState, MEMORY, int), None)

_MAKING = Lock()


def unit_of(kind: Any, form: Form) -> Unit:
    """The unit of a kind's lane function, of the form `read` for a sensor, `compute` for a skill, or `remember`."""
    lane = kind.lane
    with _MAKING:  # there is never another one: tables have the place of its slot
        return UNITS.get(f"{lane.__module__}.{lane.__qualname__}") or Unit(lane, form, lambda tables: True)
