"""Environments made by their names: Gymnasium is called, and its errors become errors of this program."""

import os
import sys
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, redirect_stdout, suppress
from importlib import import_module, invalidate_caches
from importlib.util import find_spec
from pathlib import Path
from types import ModuleType
from typing import Any

from mindrun.errors import MindError, nearest
from mindrun.kinds.environment import module_beside

NO_TIME_LIMIT = -1  # of steps: how long a run is, the task says
DRAWN = "rgb_array"  # the render mode of an environment that is to be seen
WITHOUT_GREETING = {"PYGAME_HIDE_SUPPORT_PROMPT": "1"}  # which pygame says on standard output
GAVE_NO_NUMBER = "gave what is no number"  # what is said of an environment where its own observation or reward is NaN
WITHOUT_SCREEN = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}  # pygame looks for neither

_texts: dict[Path, bytes] = {}  # of the modules beside minds, as this program has them: Python imports each once


class BrokenEnvironmentError(MindError):
    """An environment that cannot be made, or that does what none may do; `why` is what it said to that itself."""

    def __init__(self, message: str, hint: str = "", why: str = "") -> None:
        super().__init__(message, hint)
        self.why = why


class UnknownEnvironmentError(BrokenEnvironmentError):
    """An environment that does not exist."""


def library() -> ModuleType:
    """The package gymnasium; MindError where it is not installed."""
    if (known := sys.modules.get("gymnasium")) is not None:
        return known
    try:
        with _silence():
            return import_module("gymnasium")
    except ImportError:
        hint = "Install it: pip install 'mindlang[gymnasium]'."
        raise MindError("a task in gymnasium needs the package gymnasium, which is not installed", hint) from None


def is_there() -> bool:
    """True if the package gymnasium is installed."""
    return find_spec("gymnasium") is not None


def make(name: str, folder: Path | None = None, is_seen: bool = False) -> Any:
    """A new environment without the time limit that it is registered with; BrokenEnvironmentError where none is.

    A module before its name is looked for in `folder` first. One that `is_seen` draws itself.
    """
    gymnasium = library()
    if (path := module_beside(name, folder)) is not None:
        _refuse_another(name, path)
        if str(folder) not in sys.path:
            sys.path.insert(0, str(folder))
            invalidate_caches()
    drawn = {"render_mode": DRAWN} if is_seen else {}
    _set(WITHOUT_SCREEN if is_seen else {})
    try:
        with _silence(), foreign_code():
            newest = _newest(name, gymnasium)
            if newest is None:
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
    hint = f"Say which version: gymnasium {newest}."
    raise UnknownEnvironmentError(f"Gymnasium has no environment called {name}.", hint)


def registered() -> list[str]:
    """The names that Gymnasium itself has environments of; none where it is not installed."""
    return sorted(library().registry) if is_there() else []


def spaces_in(name: str, environment: Any) -> tuple[Any, Any]:
    """The spaces of its observations and of its actions; BrokenEnvironmentError where it has none."""
    try:
        with foreign_code():
            return environment.observation_space, environment.action_space
    except Exception as error:
        message = f"The environment {name} does not say what it observes and takes."
        raise BrokenEnvironmentError(message, first_line(error)) from error


def close(environment: Any) -> None:
    """Give back what it holds: windows, processes, files. Whatever it says to that is of no use to anybody."""
    with suppress(Exception), foreign_code():
        environment.close()


@contextmanager
def foreign_code() -> Iterator[None]:
    """A context for somebody else's code: what it raises is an `Exception`, sys.exit too. Ctrl-C stays what it is.

    A child that it has forked, and that comes back to here, ends as it was to.
    """
    process = os.getpid()
    try:
        yield
    except (Exception, KeyboardInterrupt):
        raise
    except BaseException as error:
        if os.getpid() != process:
            raise
        raise RuntimeError(first_line(error)) from error


def first_line(error: BaseException) -> str:
    """The type and the first line of an error of somebody else's code, in up to 200 characters."""
    try:
        lines = str(error).splitlines()
    except Exception:  # it is somebody else's code that says it
        lines = []
    said = next((line.strip() for line in lines if line.strip()), "")
    return f"{type(error).__name__}: {said}"[:200] if said else type(error).__name__


@contextmanager
def _silence() -> Iterator[None]:
    """A context without warnings or standard output, where the document of a command may go, or an editor listens."""
    _set(WITHOUT_GREETING)
    with warnings.catch_warnings(), redirect_stdout(sys.stderr):
        warnings.simplefilter("ignore")
        yield


def _newest(name: str, gymnasium: Any) -> str | None:
    """The newest version of a name that says none; None where it says one, or where there is none."""
    module, colon, own = name.rpartition(":")
    if colon:
        import_module(module)  # registers it
    registration = gymnasium.envs.registration
    space, plain, version = registration.parse_env_id(own)
    if version is not None or (highest := registration.find_highest_version(space, plain)) is None:
        return None
    return f"{module}{colon}{registration.get_env_id(space, plain, highest)}"


def _refuse_another(name: str, path: Path) -> None:
    """Raise BrokenEnvironmentError where this program has another module of that name, or an older text of this one."""
    module, text = name.partition(":")[0].partition(".")[0], path.read_bytes()
    message = f"The environment {name} cannot be made."
    if (loaded := sys.modules.get(module)) is not None:
        file = getattr(loaded, "__file__", None)
        if file is None or not path.samefile(file):
            hint = f"There is another module called {module} here ({file or 'of Python'}): give this one another name."
            raise BrokenEnvironmentError(message, hint)
    if _texts.setdefault(path.resolve(), text) != text:
        hint = f"{path.name} has changed since this program has imported it: begin the program again."
        raise BrokenEnvironmentError(message, hint)


def _set(variables: Mapping[str, str]) -> None:
    """Set environment variables that a package reads, where a user has not set them."""
    for name, value in variables.items():
        os.environ.setdefault(name, value)


def _lacks_module(error: BaseException, name: str) -> bool:
    """True if an error says that the module before a name is missing, and not one that this imports."""
    cause = error.__cause__ or error
    module = cause.name if isinstance(cause, ModuleNotFoundError) else None
    return module is not None and f"{name.partition(':')[0]}.".startswith(f"{module}.")


def _instead(name: str, known: Any) -> str:
    module, colon, own = name.partition(":")
    if near := nearest(own if colon else name, known):
        return f"Did you mean {module + colon if colon else ''}{near}?"
    if colon:
        return f'{module} has to register it: gymnasium.register("{own}", "{module}:NAME_OF_CLASS").'
    return f"One of another package has its module before it: gymnasium package:{name}."
