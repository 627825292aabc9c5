"""A worker on its streams: jobs come in, answers go out, and in a long job a sign of life now and then.

A step of an environment that takes for ever is noticed here: the job has failed, and the worker ends with it.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from threading import Event, Lock, Thread
from typing import IO, Any

from mindrun.work.frame import LINE_END, Frame, Stream, pack, read
from mindrun.work.worker import ALIVE, READY, Worker, answer_to, failure

ALIVE_SECONDS = 1.0  # between two signs of life
STEP_SECONDS = 60  # that a step of an environment may take
SPARE_SECONDS = 30  # of silence beyond that: the code of a step may let nobody else speak
HINT = "environments that slow take --on with: mindrun work --step-seconds"


@dataclass(slots=True)
class Serving:
    """A worker that answers on a stream; `end` ends the process, whatever it is doing."""

    worker: Worker
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


def asked(scorer: Any) -> Any:
    """What the environment at work has been asked, as `mindrun.sim.outside.asking.Asked`; None of other worlds."""
    return scorer.asked() if hasattr(scorer, "asked") else None
