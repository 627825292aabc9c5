"""Recordings to be seen: read once, or followed while they are written."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from mindlang.cli._recordings import refusing_recordings
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_recording import Watching, followed_recording, viewed_recording


def recording_view(recording: str, bundle: str, breaks: Path | None) -> Viewed:
    """A recording with the bundle that was running, and a file of breakpoints.

    What cannot be read ends the program with one message.
    """
    with refusing_recordings():
        return viewed_recording(Path(recording), Path(bundle), _watching(breaks))


@contextmanager
def followed_view(recording: str, bundle: str, breaks: Path | None) -> Iterator[Viewed]:
    """The same of a recording that is still written, of this machine or of HOST:FILE."""
    with ExitStack() as stack:
        with refusing_recordings():
            viewed = stack.enter_context(followed_recording(recording, Path(bundle), _watching(breaks)))
        yield viewed


def _watching(breaks: Path | None) -> Watching | None:
    if breaks is None:
        return None
    from mindlang.cli._breakpoint_file import watching_recordings

    return watching_recordings(breaks)
