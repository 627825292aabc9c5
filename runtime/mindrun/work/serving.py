"""A worker on its streams: jobs come in, answers go out, and in a long job a sign of life now and then.

A step of an environment that takes for ever is noticed here: the job has failed, and the worker ends with it.
"""

import os
from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Event, Lock, Thread
from typing import IO, Any, Protocol

from mindrun.work.frame import LINE_END, Frame, Stream, pack, read
from mindrun.work.worker import ALIVE, READY, answer_to, failure

ALIVE_SECONDS = 1.0  # between two signs of life
STEP_SECONDS = 60  # that a step of an environment may take
SPARE_SECONDS = 30  # of silence beyond that: the code of a step may let nobody else speak
HINT = "environments that slow take --on with: mindrun work --step-seconds"


class Answerer(Protocol):
    """What answers frames with frames; what is `at_work` may be asked what an environment has been asked."""

    at_work: Any

    def answer(self, data: bytes) -> bytes:
        """The answer to a frame."""


@dataclass(slots=True)
class Serving:
    """A worker that answers on a stream; `end` ends the process, whatever it is doing."""

    worker: Answerer
    answers: IO[bytes]
    end: Callable[[], None]
    step_seconds: int = STEP_SECONDS
    job: bytes = b""  # at work
    _lock: Lock = field(default_factory=Lock)
    _over: Event = field(default_factory=Event)

    def serve(self, requests: Stream) -> None:
        """Answer frame after frame until no more come; FrameError where something else comes."""
        self.say(pack(Frame(READY, {"silent_seconds": self.step_seconds + SPARE_SECONDS})))
        Thread(target=self._live, daemon=True).start()
        try:
            while (data := read(requests)) is not None:
                self.job = data
                answer = self.worker.answer(data)
                self.job = b""
                self.say(answer)
        finally:
            self._over.set()

    def say(self, data: bytes) -> None:
        """Write a frame."""
        with self._lock:
            self.answers.write(data + LINE_END)
            self.answers.flush()

    def _live(self) -> None:
        """While a job is at work say so, and notice when it comes no further, or nobody is there to hear of it."""
        before, still = None, 0.0
        while not self._over.wait(ALIVE_SECONDS):
            if not (job := self.job):
                continue
            now = asked(self.worker.at_work)
            still = still + ALIVE_SECONDS if now and now == before else 0.0
            before = now
            try:
                if now and still >= self.step_seconds:
                    message = f"the environment {now.environment} does not come back from {now.where}"
                    self.say(answer_to(job, failure(f"{message}, in {self.step_seconds} seconds", HINT)))
                    self.end()
                self.say(pack(Frame(ALIVE, {"at": f"in {now.where} in {now.environment}"} if now else {})))
            except OSError:
                self.end()


def own_streams() -> tuple[IO[bytes], IO[bytes]]:
    """Where jobs come from and answers go to, once and for all: nothing else does from here on."""
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)  # code of somebody else that reads takes no job away,
    os.dup2(2, 1)  # and what it prints is no answer
    return requests, answers


def asked(scorer: Any) -> Any:
    """What the environment at work has been asked, as `mindrun.sim.outside.asking.Asked`; None of other worlds."""
    return scorer.asked() if hasattr(scorer, "asked") else None
