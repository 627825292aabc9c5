"""Environments by their names: Gymnasium asked, and what it answers in the words of this house."""

import os
import sys
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from difflib import get_close_matches
from functools import cache
from importlib import import_module, invalidate_caches
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any

from mindrun.errors import MindError

NO_TIME_LIMIT = -1  # of steps: how long a run is, the task says
DRAWN = "rgb_array"  # the render mode of an environment that is to be seen
WITHOUT_GREETING = {"PYGAME_HIDE_SUPPORT_PROMPT": "1"}  # which pygame says on standard output
WITHOUT_SCREEN = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}  # pygame looks for neither


class BrokenEnvironmentError(MindError):
    """An environment that cannot be made, or that does what none may do."""


class UnknownEnvironmentError(BrokenEnvironmentError):
    """One that there is not."""


def library() -> ModuleType:
    """The package gymnasium; MindError where it is not installed."""
    try:
        with _silence():
            return import_module("gymnasium")
    except ImportError:
        hint = "Install it: pip install 'mindlang[gymnasium]'."
        raise MindError("a task in gymnasium needs the package gymnasium, which is not installed", hint) from None


def is_there() -> bool:
    """Whether the package gymnasium is installed."""
    return find_spec("gymnasium") is not None


def module_beside(name: str, folder: Path | None) -> Path | None:
    """The file of the module that an environment's name begins with, where it stands in a folder; nothing is run."""
    module, colon, _ = name.partition(":")
    if folder is None or not colon:
        return None
    top = folder / module.partition(".")[0]
    return next((path for path in (top.with_suffix(".py"), top / "__init__.py") if path.is_file()), None)


def make(name: str, folder: Path | None = None, is_seen: bool = False) -> Any:
    """A new environment without the time limit that it is registered with; BrokenEnvironmentError where none is.

    A module before its name is looked for in `folder` first. One that `is_seen` draws itself.
    """
    gymnasium = library()
    if module_beside(name, folder) and str(folder) not in sys.path:
        sys.path.insert(0, str(folder))
        invalidate_caches()
    drawn = {"render_mode": DRAWN} if is_seen else {}
    _set(WITHOUT_SCREEN if is_seen else {})
    try:
        with _silence():
            return gymnasium.make(name, max_episode_steps=NO_TIME_LIMIT, disable_env_checker=True, **drawn)
    except (gymnasium.error.UnregisteredEnv, gymnasium.error.DeprecatedEnv):
        raise UnknownEnvironmentError(
            f"Gymnasium has no environment called {name}.", _instead(name, gymnasium.registry)
        ) from None
    except Exception as error:
        if _lacks_module(error, name):
            hint = f"There is no module {name.partition(':')[0]}, neither installed nor beside the mind."
            raise UnknownEnvironmentError(f"Gymnasium has no environment called {name}.", hint) from None
        cause = error.__cause__ if isinstance(error, ModuleNotFoundError) and error.__cause__ else error
        raise BrokenEnvironmentError(f"The environment {name} cannot be made.", first_line(cause)) from None


def registered() -> list[str]:
    """The names that Gymnasium itself has environments of; none where it is not installed."""
    return sorted(library().registry) if is_there() else []


@cache
def spaces(name: str, folder: Path | None = None) -> tuple[Any, Any]:
    """The spaces of its observations and of its actions."""
    environment = make(name, folder)
    found = environment.observation_space, environment.action_space
    environment.close()
    return found


def first_line(error: BaseException) -> str:
    """What an error of somebody else's code says, short enough for one line."""
    said = next((line.strip() for line in str(error).splitlines() if line.strip()), "")
    return f"{type(error).__name__}: {said}"[:200] if said else type(error).__name__


@contextmanager
def _silence() -> Iterator[None]:
    """No warnings, and nothing on standard output, where the document of a command may go, or an editor listens."""
    _set(WITHOUT_GREETING)
    with warnings.catch_warnings(), redirect_stdout(sys.stderr):
        warnings.simplefilter("ignore")
        yield


def _set(variables: Mapping[str, str]) -> None:
    """What a package asks the system for, where a user has not said otherwise."""
    for name, value in variables.items():
        os.environ.setdefault(name, value)


def _lacks_module(error: BaseException, name: str) -> bool:
    """Whether it is the module before the name that is not there, and not one that this imports."""
    cause = error.__cause__ or error
    module = cause.name if isinstance(cause, ModuleNotFoundError) else None
    return module is not None and f"{name.partition(':')[0]}.".startswith(f"{module}.")


def _instead(name: str, known: Any) -> str:
    module, colon, own = name.partition(":")
    if near := get_close_matches(own if colon else name, list(known), 1):
        return f"Did you mean {module + colon if colon else ''}{near[0]}?"
    if colon:
        return f'{module} has to register it: gymnasium.register("{own}", "{module}:NAME_OF_CLASS").'
    return f"One of another package has its module before it: gymnasium package:{name}."
