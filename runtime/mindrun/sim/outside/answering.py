"""What a process that steps environments answers."""

from contextlib import suppress
from ctypes import CDLL
from pathlib import Path
from typing import Any

from mindrun.errors import MindError
from mindrun.sim.outside import making
from mindrun.sim.outside.episode import Episode
from mindrun.sim.outside.here import Here
from mindrun.sim.outside.questions import (
    BEGIN,
    CLOSE,
    CLOSED,
    IMAGE,
    OPEN,
    REGISTERED,
    SPACES,
    STEP,
    action_of,
    failure_frame,
    image_frame,
    observed_frame,
    spaces_frame,
)
from mindrun.work.frame import Frame, unpack
from mindrun.work.last_step import LastStep
from mindrun.work.worker import answer_to


class Answering:
    """Steps environments as it is asked, and writes down each step before it is made."""

    def __init__(self, last_step: LastStep) -> None:
        self._last_step = last_step
        self._here: dict[tuple[str, Path | None], Here] = {}
        self._runs: dict[int, tuple[Here, Episode]] = {}
        self.at_work: Any = None  # a step may take as long as it likes: who asks can stop it

    def answer(self, data: bytes) -> bytes:
        """The answer to a frame; whatever is wrong is an answer, too."""
        try:
            found = self._answer(unpack(data))
        except MindError as error:
            found = failure_frame(error)
        except Exception as error:
            found = failure_frame(MindError(f"a question to an environment failed: {type(error).__name__}: {error}"))
        with suppress(OSError):
            CDLL(None).fflush(None)  # C keeps back what does not go to a terminal
        return answer_to(data, found)

    def _answer(self, asked: Frame) -> Frame:
        match asked.kind, asked.about:
            case kind, {"runs": [*numbers]} if kind == STEP:
                return self._stepped(numbers, asked.arrays["actions"])
            case kind, {"run": int(number), "seed": int(seed), "places": [*places], "is_seen": bool(is_seen)} if (
                kind == OPEN
            ):
                here = self._of(asked)
                self._runs[number] = here, here.run([(name, place) for name, place in places], seed, is_seen)
                return Frame(OPEN)
            case kind, {"run": int(number)} if kind == BEGIN:
                _, run = self._runs[number]
                run.begin()
                return observed_frame([run])
            case kind, {"run": int(number)} if kind == IMAGE:
                return image_frame(self._runs[number][1].image())
            case kind, {"run": int(number)} if kind == CLOSE:
                self._runs.pop(number)[1].close()
                return Frame(CLOSED)
            case kind, _ if kind == SPACES:
                return spaces_frame(self._of(asked).spaces)
            case kind, _ if kind == REGISTERED:
                return Frame(REGISTERED, {"names": making.registered()})
        raise MindError(f"nobody knows what {asked.kind!r:.40} is")

    def _stepped(self, numbers: list[int], actions: Any) -> Frame:
        runs = [self._runs[number] for number in numbers]
        for (here, run), row in zip(runs, actions, strict=True):
            run.step(action_of(row, here.spaces.acted))
        return observed_frame([run for _, run in runs])

    def _of(self, asked: Frame) -> Here:
        """What steps the environment that a question is about."""
        name, folder = asked.about["environment"], asked.about["folder"]
        key = name, None if folder is None else Path(folder)
        if key not in self._here:
            self._here[key] = here = Here(*key)
            here.write_steps(self._last_step)
        return self._here[key]
