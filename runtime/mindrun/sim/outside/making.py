"""Environments by their names: Gymnasium asked, and what it answers in the words of this house."""

import warnings
from difflib import get_close_matches
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from types import ModuleType
from typing import Any

from mindrun.errors import MindError

NO_TIME_LIMIT = -1  # of steps: how long a run is, the task says


class BrokenEnvironmentError(MindError):
    """An environment that there is not, or that does what none may do."""


def library() -> ModuleType:
    """The package gymnasium; MindError where it is not installed."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return import_module("gymnasium")
    except ImportError:
        hint = "Install it: pip install 'mindlang[gymnasium]'."
        raise MindError("a task in gymnasium needs the package gymnasium, which is not installed", hint) from None


def is_there() -> bool:
    """Whether the package gymnasium is installed."""
    return find_spec("gymnasium") is not None


def make(name: str) -> Any:
    """A new environment without the time limit that it is registered with; BrokenEnvironmentError where none is."""
    gymnasium = library()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return gymnasium.make(name, max_episode_steps=NO_TIME_LIMIT, disable_env_checker=True)
    except (gymnasium.error.UnregisteredEnv, ModuleNotFoundError) as error:
        raise BrokenEnvironmentError(
            f"Gymnasium has no environment called {name}.", _instead(gymnasium, name, error)
        ) from None
    except Exception as error:
        raise BrokenEnvironmentError(f"The environment {name} cannot be made.", first_line(error)) from None


@cache
def spaces(name: str) -> tuple[Any, Any]:
    """The spaces of its observations and of its actions."""
    environment = make(name)
    environment.close()
    return environment.observation_space, environment.action_space


def first_line(error: BaseException) -> str:
    """What an error of somebody else's code says, short enough for one line."""
    said = next((line.strip() for line in str(error).splitlines() if line.strip()), "")
    return f"{type(error).__name__}: {said}"[:200] if said else type(error).__name__


def _instead(gymnasium: ModuleType, name: str, error: Exception) -> str:
    near = get_close_matches(name, list(gymnasium.registry), 1)
    if near:
        return f"Did you mean {near[0]}?"
    missing = f"{first_line(error)}. " if isinstance(error, ModuleNotFoundError) else ""
    return f"{missing}One of another package has its module before it: gymnasium package:{name.rpartition(':')[2]}."
