"""What `mindc whatif` does: a run as it is and with changes; printed, drawn."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mindrun.changes import ChangeError

from mindlang.cli._run_session import RunSession
from mindlang.cli._simulator_compilation import ensure_stages_compiled
from mindlang.cli._terminal import MISUSE, console, fail, print_json, procedures_talk, write_file
from mindlang.whatif.changed_run import compare
from mindlang.whatif.report import comparison_data, comparison_summary
from mindlang.whatif.request import Request, changes_of


@dataclass(frozen=True, slots=True)
class Played:
    """Which run of a mind it is."""

    task: str | None
    seed: int
    master: str | None
    interrupt: bool


def compare_runs(file: str, played: Played, request: Request, picture: Path | None, as_json: bool, quiet: bool) -> None:
    """Run as it is and with changes, and print what differs."""
    session = RunSession(quiet)
    if request.is_empty:
        fail("nothing is changed", "Say what: --without SKILL, --sensor NAME=0.5 or --set NAME=0.5", MISUSE)
    setup, rollout = session.prepare(file, played.task, played.master, played.interrupt)
    ensure_stages_compiled(rollout, session.say)
    try:
        changes = changes_of(request, setup.ready.policy.graph, setup.master)
        with procedures_talk():
            compared = compare(setup, rollout, played.seed, changes)
    except ChangeError as error:
        fail(str(error), error.hint, MISUSE)
    if as_json:
        print_json(comparison_data(request, compared))
    else:
        console().print(comparison_summary(request, compared))
    if picture:
        from mindlang.pictures.picture import png
        from mindlang.pictures.two_paths import two_paths

        both = [(each.run, each.found) for each in (compared.was, compared.now)]
        write_file(picture, png(two_paths(both, request.words, request.tick)))
        session.say(f"{picture}: both paths of the robot")
