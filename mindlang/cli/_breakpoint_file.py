"""A .break file that a command is given: a mistake in it is reported, and ends the program before anything runs."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

from mindrun.graph.bundle import Bundle
from mindrun.robot.recording import About

from mindlang.breakpoints.breakpoint import Breakpoint
from mindlang.breakpoints.resolve import load_breakpoints
from mindlang.breakpoints.subject import Subject
from mindlang.breakpoints.watch import RecordingWatcher, recording_subject
from mindlang.cli._diagnostic_printer import print_report
from mindlang.cli._terminal import FINDINGS, MISUSE, console
from mindlang.compiler.compile import Compiled
from mindlang.run.setup import RunSetup


def breakpoints_of_run(path: Path, compiled: Compiled, setup: RunSetup) -> tuple[Breakpoint, ...]:
    """The breakpoints of a run that is set up."""
    assert compiled.mind
    return _read(path, Subject.of_run(compiled.mind.names, setup))


def watching_recordings(path: Path) -> Callable[[About, Bundle], RecordingWatcher]:
    """What makes the watcher of a recording."""
    return lambda of, mind: RecordingWatcher(_read(path, recording_subject(of, mind)), of, mind)


def _read(path: Path, subject: Subject) -> tuple[Breakpoint, ...]:
    found = load_breakpoints(path, subject)
    print_report(found.diagnostics, console(stderr=True))
    if found.diagnostics:
        sys.exit(FINDINGS if all(each.span for each in found.diagnostics) else MISUSE)
    return found.breakpoints
