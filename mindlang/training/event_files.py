"""The generations of a run as event files, one for each attempt, which TensorBoard shows beside each other.

They are made of the run's log and nothing else: whoever goes on with a run begins by writing them anew, so that no
generation is there twice, whatever had been written when the process was killed.
"""

from contextlib import AbstractContextManager
from dataclasses import asdict
from datetime import datetime
from math import isfinite
from typing import TYPE_CHECKING

from mindrun.errors import system_errors_as
from mindrun.train import RunError
from mindrun.train.lesson_state import Record
from mindrun.train.progress import Logged, read_progress
from mindrun.train.run_folder import RunFolder

if TYPE_CHECKING:
    from tensorboardX import RecordWriter
    from tensorboardX.proto.summary_pb2 import Summary

FOLDER, FILE = "tensorboard", "events.out.tfevents.mind"  # TensorBoard takes what has "tfevents" in its name
FILE_VERSION = "brain.Event:2"
SCORES = {"score/best": "best", "score/mean": "mean", "score/re-evaluated": "reevaluated", "score/verdict": "verdict"}
SPEED = "speed/ticks per second"
FLUSH_SECONDS = 2.0  # between two times that what was written is brought to the disk


class EventFiles:
    """The event files of a run; an event's step is its generation, its time how long the training had taken by then."""

    def __init__(self, run: RunFolder) -> None:
        self.folder = run.folder / FOLDER
        self._run = run
        self._writer: RecordWriter | None = None
        self._attempt: float | None = None
        self._time, self._flushed = 0.0, 0.0

    def report(self, record: Record, now: float) -> None:
        """Write a generation that has ended and is in the log; the first call writes all before it, too."""
        with self._disk():
            if self._writer is None:
                self._write_all()
            else:
                self._write(asdict(record))
            if self._writer and now - self._flushed >= FLUSH_SECONDS:
                self._writer.flush()
                self._flushed = now

    def write_all(self) -> None:
        """Write all generations in the log of a run, which need not go on."""
        with self._disk():
            self._write_all()
        self.close()

    def close(self) -> None:
        """Bring the files to the disk; a generation that is reported after that begins them anew."""
        if self._writer:
            with self._disk():
                self._writer.flush()
                self._writer.close()
            self._writer = None

    def _disk(self) -> AbstractContextManager[None]:
        hint = "make room, or go on without --tensorboard"
        return system_errors_as(RunError, f"cannot write to {self.folder}", hint)

    def _write_all(self) -> None:
        self._attempt, self._time = None, datetime.fromisoformat(self._run.manifest.started).timestamp()
        records = read_progress(self._run.folder)
        known = {_folder(record) for record in records}
        for path in self.folder.glob(f"*/{FILE}"):
            if path.parent.name not in known:  # an attempt that a crash took back
                path.unlink()
        for record in records:
            self._write(record)

    def _write(self, record: Logged) -> None:
        from tensorboardX import RecordWriter
        from tensorboardX.proto.event_pb2 import Event

        if record["attempt"] != self._attempt:
            self.close()
            folder = self.folder / _folder(record)
            folder.mkdir(parents=True, exist_ok=True)
            self._attempt, self._writer = record["attempt"], RecordWriter(str(folder / FILE))
            self._writer.write(Event(wall_time=self._time, file_version=FILE_VERSION).SerializeToString())
        assert self._writer
        self._time += record["seconds"] or 0.0
        event = Event(wall_time=self._time, step=int(record["generation"] or 0), summary=_summary(record))
        self._writer.write(event.SerializeToString())


def _folder(record: Logged) -> str:
    return f"attempt {record['attempt']}"


def _summary(record: Logged) -> "Summary":
    from tensorboardX.proto.summary_pb2 import Summary

    scores = {tag: record[column] for tag, column in SCORES.items()}
    speed = {SPEED: (record["ticks"] or 0) / record["seconds"] if record["seconds"] else None}
    return Summary(
        value=[
            Summary.Value(tag=tag, simple_value=value)
            for tag, value in (scores | speed).items()
            if value is not None and isfinite(value)
        ]
    )
