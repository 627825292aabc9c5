"""A recording that is there for a viewer alone: deleted at the end, and no reason for a robot to stop."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from mindrun.robot.recording import About, Recorder, RecordingError


@contextmanager
def temporary_recording(tell: Callable[[str], None]) -> Iterator[Path]:
    """A path for a recording that goes away at the end."""
    with TemporaryDirectory(prefix="mind-") as folder:
        tell("recorded for the view alone, and deleted at the end: --record FILE keeps it")
        yield Path(folder) / "live.rec"


class TemporaryRecorder(Recorder):
    """Where it cannot be written any more, `tell` gets one sentence, and nothing more is written."""

    def __init__(self, path: Path, about: About, tell: Callable[[str], None], **how: Any) -> None:
        super().__init__(path, about, **how)
        self._tell, self._has_failed = tell, False

    def write(self, **columns: Any) -> None:
        """A row, where there is room for it."""
        if self._has_failed:
            return
        try:
            super().write(**columns)
        except RecordingError as error:
            self._has_failed = True
            self._tell(f"nothing more is seen, and the robot drives on: {error}")

    def _sync(self, every: float) -> None:
        """It need not survive a power cut: no card is worn by it."""

    def close(self) -> None:
        """Let go of it; what was not written is missed by nobody."""
        with suppress(RecordingError):
            super().close()
