"""What is asked of a process that steps environments, and what it answers, as frames: numbers and names alone."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.errors import MindError
from mindrun.sim.outside.making import BrokenEnvironmentError, UnknownEnvironmentError
from mindrun.sim.outside.parts import Part, Spaces
from mindrun.work.frame import Frame, FrameError
from mindrun.work.worker import FAILED

SPACES, REGISTERED = "spaces", "registered"  # of the environment of a name, and which names there are
OPEN, BEGIN, STEP, IMAGE, CLOSE = "open", "begin", "step", "image", "close"  # of runs
OBSERVED, CLOSED = "observed", "closed"  # answers

Floats = NDArray[np.float64]


def spaces_frame(spaces: Spaces) -> Frame:
    """What an environment observes and takes."""
    parts = [*spaces.observed.values(), *spaces.acted.values()]
    rows = [[*_rows(each)] for each in (spaces.observed, spaces.acted)]
    about = {"observed": rows[0], "acted": rows[1], "others": list(spaces.others)}
    ends = {name: _joined([getattr(part, name) for part in parts]) for name in ("low", "high")}
    choices = [np.zeros(0, np.int64), *(part.choices for part in parts if part.choices is not None)]
    return Frame(SPACES, about, {**ends, "choices": np.concatenate(choices)})


def spaces_in(frame: Frame) -> Spaces:
    """What an answer says that an environment observes and takes."""
    low, high, choices = (frame.arrays[name] for name in ("low", "high", "choices"))
    found = [dict[str, Part](), dict[str, Part]()]
    for parts, rows in zip(found, (frame.about["observed"], frame.about["acted"]), strict=True):
        for name, shape, dtype, size, are_choices in rows:
            count, choices = (choices[:size], choices[size:]) if are_choices else (None, choices)
            parts[name] = Part(tuple(shape), low[:size], high[:size], np.dtype(dtype), count)
            low, high = low[size:], high[size:]
    return Spaces(found[0], found[1], tuple(frame.about["others"]))


def observed_frame(runs: Sequence[Any]) -> Frame:
    """What some runs have come to."""
    arrays = {
        "observed": np.stack([run.observed for run in runs]),
        "reward": np.array([run.reward for run in runs], np.float64),
        "ended": np.array([[run.is_terminated, run.is_truncated] for run in runs], np.uint8),
    }
    return Frame(OBSERVED, {}, arrays)


def take_observed(frame: Frame, runs: Sequence[Any]) -> None:
    """Put what an answer says of some runs into them."""
    if frame.kind != OBSERVED or len(frame.arrays["reward"]) != len(runs):
        raise FrameError("it is no answer to a step")
    arrays = (frame.arrays[name] for name in ("observed", "reward", "ended"))
    for run, observed, reward, ended in zip(runs, *arrays, strict=True):
        run.observed, run.reward = observed, float(reward)
        run.is_terminated, run.is_truncated = bool(ended[0]), bool(ended[1])


def numbers_of(actions: Sequence[Mapping[str, Any]]) -> Floats:
    """Actions as numbers [actions, numbers], part after part. 64 bits have what any part of an action has."""
    return np.stack([_joined([np.ravel(value) for value in action.values()]) for action in actions])


def action_of(numbers: Floats, parts: Mapping[str, Part]) -> dict[str, Any]:
    """The action that numbers are."""
    action, first = {}, 0
    for name, part in parts.items():
        value = numbers[first : first + len(part.low)].astype(part.dtype).reshape(part.shape)
        action[name] = value if part.shape or part.choices is None else value[()]
        first += len(part.low)
    return action


def image_frame(image: Any) -> Frame:
    """An image, or an empty one where it is none."""
    found = np.asarray(image)
    is_image = found.dtype == np.uint8 and found.ndim == 3
    return Frame(IMAGE, {}, {"image": found if is_image else np.zeros((0, 0, 0), np.uint8)})


def failure_frame(error: MindError) -> Frame:
    """Why something was not done."""
    about = {"message": str(error), "hint": error.hint, "why": getattr(error, "why", "")}
    return Frame(FAILED, {**about, "is_unknown": isinstance(error, UnknownEnvironmentError)})


def failure_in(frame: Frame) -> MindError:
    """Why something was not done, as this process raises it."""
    message, hint, why = (f"{frame.about.get(each, '')}" for each in ("message", "hint", "why"))
    kind = UnknownEnvironmentError if frame.about.get("is_unknown") is True else BrokenEnvironmentError
    return kind(message, hint, why)


def _rows(parts: Mapping[str, Part]) -> Sequence[Any]:
    return [
        [name, list(part.shape), np.dtype(part.dtype).str, len(part.low), part.choices is not None]
        for name, part in parts.items()
    ]


def _joined(arrays: Sequence[NDArray[Any]]) -> Floats:
    found: Floats = np.concatenate([np.zeros(0), *arrays]).astype(np.float64)
    return found
