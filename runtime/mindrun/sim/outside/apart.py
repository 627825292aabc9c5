"""Environments that are stepped in a process of their own: whatever one does there, this one goes on.

It may end its process, write on standard output, go to another folder, or take signals. A frame is a question, and one
asks for a step of all runs.
"""

import codecs
import os
import sys
from collections.abc import Mapping, Sequence
from functools import cached_property
from itertools import count
from pathlib import Path
from threading import Lock
from typing import Any
from weakref import finalize

import numpy as np

from mindrun.errors import MindError
from mindrun.sim.outside import making
from mindrun.sim.outside.asking import Asked
from mindrun.sim.outside.making import BrokenEnvironmentError
from mindrun.sim.outside.parts import Spaces
from mindrun.sim.outside.questions import (
    BEGIN,
    CLOSE,
    IMAGE,
    OPEN,
    REGISTERED,
    SPACES,
    STEP,
    failure_in,
    numbers_of,
    spaces_in,
    take_observed,
)
from mindrun.sim.outside.taking import Place
from mindrun.work.child import Child
from mindrun.work.child import Place as Command
from mindrun.work.frame import Frame, pack
from mindrun.work.last_step import LastStep
from mindrun.work.pipes import LostError
from mindrun.work.worker import FAILED


class EnvironmentProcess:
    """Such a process; it begins with the first question, and ends with this."""

    def __init__(self) -> None:
        # What is imported here is found there, and nothing else: -P. What is printed comes at once: -u.
        path = os.pathsep.join(each or f"{Path.cwd()}" for each in sys.path)
        words = sys.executable, "-u", "-P", "-m", "mindrun.sim.outside"
        decoder = codecs.getincrementaldecoder("utf-8")("replace")
        command = Command("environments", words, {"PYTHONPATH": path}, writes_step=True)
        self._child = Child(command, lambda part: sys.stderr.write(decoder.decode(part)))
        self._lock = Lock()
        finalize(self, self._child.end)

    @property
    def has_begun(self) -> bool:
        """Whether it is there."""
        return self._child.has_begun

    def break_off(self) -> None:
        """End the process, from another thread; who waits for an answer of it is told that there is none."""
        self._child.end_process()

    def ask(self, kind: str, environment: str, about: Mapping[str, Any], **arrays: Any) -> Frame:
        """The answer to a question; BrokenEnvironmentError where there is none, or says why not."""
        with self._lock:
            try:
                self._child.begin()
                answer = self._child.ask(pack(Frame(kind, about, arrays)))
            except LostError as error:
                found = self._lost(environment, f"{error}")
                self._child.end()
                raise found from error
            except BaseException:
                self._child.end()  # its answer would be taken for another one's
                raise
        if answer.kind == FAILED:
            raise failure_in(answer)
        return answer

    def _lost(self, environment: str, said: str) -> BrokenEnvironmentError:
        how = self._child.ending() or said
        at = self._child.last_step.read() if self._child.last_step else None
        if at is None:
            message = f"The environment {environment} cannot be made."
            return BrokenEnvironmentError(message, f"It has ended the process that asked it ({how}).")
        why = f"It was {at[0]}, and the fault is the environment's: {how}."
        return BrokenEnvironmentError(f"the environment {environment} has ended its process", why, why)


class RemoteRun:
    """An environment there, in the run of a seed."""

    def __init__(self, apart: "Apart", number: int, slots: int) -> None:
        self.apart, self.number = apart, number
        self.observed = np.zeros(slots)
        self.reward, self.is_terminated, self.is_truncated = 0.0, False, False

    @property
    def is_over(self) -> bool:
        """Whether it can be stepped no more."""
        return self.is_terminated or self.is_truncated

    def begin(self) -> None:
        """Begin the run."""
        take_observed(self.apart.ask(BEGIN, {"run": self.number}), [self])

    def image(self) -> Any:
        """What is seen of it now [height, width, 3], red first."""
        return self.apart.ask(IMAGE, {"run": self.number}).arrays["image"]

    def close(self) -> None:
        """Give back what it holds; with its process it has done so."""
        self.apart.close(self.number)


class Apart:
    """Steps environments of that name there; a module before it is looked for in `folder` first."""

    def __init__(self, environment: str, folder: Path | None = None) -> None:
        self.environment = environment
        self._about = {"environment": environment, "folder": None if folder is None else f"{folder.absolute()}"}
        self._process, self._numbers = EnvironmentProcess(), count(1)

    @cached_property
    def spaces(self) -> Spaces:
        """What it observes and takes."""
        return spaces_in(self.ask(SPACES, self._about))

    def run(self, places: Sequence[Place], seed: int, is_seen: bool = False) -> RemoteRun:
        """A new environment for the run of a seed, of which the numbers at these places are read."""
        number = next(self._numbers)
        about = {**self._about, "run": number, "seed": seed, "places": [*map(list, places)], "is_seen": is_seen}
        self.ask(OPEN, about)
        return RemoteRun(self, number, len(places))

    def step(self, runs: Sequence[RemoteRun], actions: Sequence[Mapping[str, Any]]) -> None:
        """Step all of them, each where it was begun: another mind may have taken over."""
        for apart in dict.fromkeys(run.apart for run in runs):
            chosen = [number for number, run in enumerate(runs) if run.apart is apart]
            apart.step_own([runs[number] for number in chosen], [actions[number] for number in chosen])

    def step_own(self, runs: Sequence[RemoteRun], actions: Sequence[Mapping[str, Any]]) -> None:
        """Step some of its own with one question."""
        about = {"runs": [run.number for run in runs]}
        take_observed(self.ask(STEP, about, actions=numbers_of(actions)), runs)

    def ask(self, kind: str, about: Mapping[str, Any], **arrays: Any) -> Frame:
        """The answer to a question."""
        return self._process.ask(kind, self.environment, about, **arrays)

    def close(self, number: int) -> None:
        """Give back what a run holds."""
        if self._process.has_begun:
            try:
                self.ask(CLOSE, {"run": number})
            except MindError:
                return  # whatever it says to that is of no use to anybody

    def asked(self) -> Asked | None:
        """Nothing in this process."""
        return None

    def break_off(self) -> None:
        """End the process, whatever it does; the next question begins another."""
        self._process.break_off()

    def write_steps(self, last_step: LastStep) -> None:
        """Nothing: no step is made here."""


def registered(process: EnvironmentProcess) -> list[str]:
    """The names of all environments that Gymnasium, and what is installed beside it, have by themselves."""
    answer = process.ask(REGISTERED, "of Gymnasium", {})
    return [f"{name}" for name in answer.about.get("names", ())]


def spaces_of(process: EnvironmentProcess, environment: str) -> Spaces:
    """What an environment observes and takes."""
    if not making.is_there():
        making.library()
    return spaces_in(process.ask(SPACES, environment, {"environment": environment, "folder": None}))
