"""What `mindc whatif` does: a run, or a recording, as it is and with changes; printed, drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from mindrun.engine.changes import Change, ChangeError
from mindrun.errors import MindError
from mindrun.sim.rollout import Rollout

from mindlang.cli._recordings import refusing_recordings
from mindlang.cli._run_session import RunSession
from mindlang.cli._simulator_compilation import ensure_stages_compiled
from mindlang.cli._terminal import (
    MISUSE,
    console,
    fail,
    load_compiled,
    print_json,
    procedures_talk,
    refuse_unwritable,
    write_file,
)
from mindlang.run.setup import RunSetup
from mindlang.whatif.another_mind import compare_minds
from mindlang.whatif.changed_run import Compared, compare
from mindlang.whatif.mind_version import BUNDLE_SUFFIX, MindVersion, from_bundle, from_source
from mindlang.whatif.open_loop import OpenLoop, compare_recording
from mindlang.whatif.report import comparison_data, comparison_summary, recording_data, recording_summary
from mindlang.whatif.request import Request, changes_of

Cast = tuple[RunSetup, Rollout]  # who plays what, in the simulator


@dataclass(frozen=True, slots=True)
class Played:
    """Which run of a mind it is, and where it is drawn."""

    task: str | None
    seed: int
    master: str | None
    interrupt: bool
    picture: Path | None


def compare_runs(file: str, played: Played, request: Request, as_json: bool, quiet: bool) -> None:
    """Run as it is and with changes, and print what differs."""
    session = RunSession(quiet)
    _refuse_nothing(request)
    refuse_unwritable(played.picture, ".png")
    ours = session.prepare(file, played.task, played.master, played.interrupt)
    theirs = _another(session, request.other, ours[0], played) if request.other else None
    ensure_stages_compiled(ours[1], session.say)
    try:
        changes = _changes(Path(file), (theirs or ours)[0], request)
        compared = _compared(ours, theirs, request.tick, changes, played.seed)
    except ChangeError as error:
        fail(str(error), error.hint, MISUSE)
    _say_where_recordings_end(session, request, changes, compared)
    if as_json:
        print_json(comparison_data(request, compared))
    else:
        console().print(comparison_summary(request, compared))
    if played.picture:
        _draw(compared, request, played.picture)
        what = "both runs" if compared.was.run.task.scene.environment else "both paths of the robot"
        session.say(f"{played.picture}: {what}")


@refusing_recordings()
def _changes(file: Path, setup: RunSetup, request: Request) -> Sequence[Change]:
    return changes_of(request, setup.ready.policy.graph, setup.master, file)


@procedures_talk()
def _compared(ours: Cast, theirs: Cast | None, tick: int, changes: Sequence[Change], seed: int) -> Compared:
    return compare_minds(ours, theirs, seed, tick, changes) if theirs else compare(*ours, seed, changes)


def _say_where_recordings_end(
    session: RunSession, request: Request, changes: Sequence[Change], compared: Compared
) -> None:
    """A sensor that was replaced for as long as a recording lasts reads what it measures after that."""
    ends = {change.last for change in changes if request.ticks is None and change.last and len(change.values) > 1}
    for end in sorted(ends):
        if end < compared.now.run.ticks:
            session.say(f"note: a recording ends with tick {end:,}: from then on its sensor reads what it measures")


def _another(session: RunSession, file: str, ours: RunSetup, played: Played) -> Cast:
    """Set up another mind on the task of a first one; it is said where the two differ in what that task is."""
    setup, rollout = session.prepare(file, ours.task.name, played.master, played.interrupt)
    if setup.task != ours.task:
        session.say(f"note: task {setup.task.name} is another in {file}; one seed need not give one world")
    return setup, rollout


def _draw(compared: Compared, request: Request, path: Path) -> None:
    from mindlang.pictures.picture import png

    if compared.was.run.task.scene.environment:
        from mindlang.pictures.environments import environment_pictures as two_runs
    else:
        from mindlang.pictures.two_paths import two_paths as two_runs
    both = [(each.run, each.found) for each in (compared.was, compared.now)]
    try:
        drawn = two_runs(both, request.words, request.tick)
    except MindError as error:
        fail(str(error), error.hint, MISUSE)
    write_file(path, png(drawn))


def _recorded(path: Path, bundle: Path, request: Request) -> OpenLoop:
    other = _version(request.other) if request.other else None
    return compare_recording(path, bundle, other, partial(changes_of, request, own=bundle), request.tick)


def _version(file: str) -> MindVersion:
    """The mind of a bundle, or of a source."""
    return from_bundle(Path(file)) if file.endswith(BUNDLE_SUFFIX) else from_source(file, load_compiled(file))


def compare_recorded(path: Path, bundle: Path, request: Request, as_json: bool) -> None:
    """Compute a recording as it was and with changes, and print what differs."""
    _refuse_nothing(request)
    with refusing_recordings():
        found = _recorded(path, bundle, request)
    if as_json:
        print_json(recording_data(request, found))
    else:
        console().print(recording_summary(request, path.name, found))


def _refuse_nothing(request: Request) -> None:
    if request.is_empty:
        fail(
            "nothing is changed",
            "Say what: --without SKILL, --sensor NAME=0.5, --set NAME=0.5 or --with OTHER.mind",
            MISUSE,
        )
