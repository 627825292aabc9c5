"""Which environments are stepped in which process: the one place that knows."""

import sys
from functools import cache
from pathlib import Path

from mindrun.errors import MindError
from mindrun.sim.outside import apart, making
from mindrun.sim.outside.here import Here
from mindrun.sim.outside.parts import Spaces
from mindrun.sim.outside.stepper import Stepper


def stepper_for(environment: str, folder: Path | None = None) -> Stepper:
    """A process of its own, but for what this program has registered itself: no other one knows that."""
    if not making.is_there():
        making.library()  # says what to install
    return Here(environment, folder) if is_own(environment) else apart.Apart(environment, folder)


@cache
def known_spaces(environment: str) -> Spaces:
    """What an environment without a module before its name observes and takes; BrokenEnvironmentError where none."""
    return Here(environment).spaces if is_own(environment) else apart.spaces_of(_process(), environment)


def is_own(environment: str) -> bool:
    """Whether this program alone may know an environment: it has registered that name, or others that are like it."""
    gymnasium = sys.modules.get("gymnasium")
    module, _, name = environment.rpartition(":")
    return gymnasium is not None and (name in gymnasium.registry or not module) and name not in _registered()


@cache
def _registered() -> frozenset[str]:
    try:
        return frozenset(apart.registered(_process()))
    except MindError:  # one of the packages beside Gymnasium ends the process
        return frozenset()


@cache
def _process() -> apart.EnvironmentProcess:
    """The one that is asked what environments are like, again and again while a mind is written."""
    return apart.EnvironmentProcess()
