"""What a worker has to know before it can do a job: a bundle, and which task of it is done by whom."""

from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from pathlib import Path

import numpy as np

from mindrun.files.strict_json import are_names
from mindrun.graph.bundle import Bundle, unpack
from mindrun.work.frame import Frame, FrameError, pack

KIND = "assignment"


@dataclass(frozen=True)
class Assignment:
    """A task under a master; a genome has the weights of the `learners`, one after the other. `bundle` is packed.

    `folder`, which no other machine is told, is where a module that registers an environment may stand.
    """

    bundle: bytes
    task: str
    master: str
    learners: tuple[str, ...] = ()
    interrupt: bool = True
    folder: Path | None = None

    @cached_property
    def packed(self) -> bytes:
        """It as the bytes of a frame."""
        about = {
            "task": self.task,
            "master": self.master,
            "learners": list(self.learners),
            "interrupt": self.interrupt,
        }
        return pack(Frame(KIND, about, {"bundle": np.frombuffer(self.bundle, np.uint8)}))

    @cached_property
    def name(self) -> str:
        """The SHA-256 by which jobs name it."""
        return sha256(self.packed).hexdigest()

    def opened(self) -> Bundle:
        """What is in its bundle; BundleError where that is damaged."""
        return unpack(self.bundle)


def assignment_of(frame: Frame) -> Assignment:
    """The assignment that a frame is; FrameError where it is none."""
    match frame.about, frame.arrays:
        case (
            {"task": str(task), "master": str(master), "learners": [*learners], "interrupt": bool(interrupt)},
            {"bundle": bundle},
        ) if are_names(learners) and bundle.dtype == np.uint8 and bundle.ndim == 1:
            return Assignment(bundle.tobytes(), task, master, tuple(learners), interrupt)
    raise FrameError("it is no assignment")
