"""A run of the simulator to be seen, while it is made."""

import secrets
from dataclasses import dataclass
from pathlib import Path

from mindlang.breakpoints.watch import noticing
from mindlang.cli._breakpoint_file import breakpoints_of_run
from mindlang.cli._run_session import RunSession
from mindlang.cli._terminal import load_compiled
from mindlang.compiler.drawing import text_after_name
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_run import ViewedRun


@dataclass(frozen=True, slots=True)
class ViewChoice:
    """Which run of a mind is seen; without a seed one is drawn. `breaks` is a file of breakpoints."""

    task: str | None
    seed: int | None
    master: str | None
    interrupt: bool
    breaks: Path | None


def run_view(file: str, chosen: ViewChoice, quiet: bool) -> Viewed:
    """The run at its beginning; what cannot be run ends the program with one message."""
    compiled, session = load_compiled(file), RunSession(quiet)
    setup = session.cast(file, compiled, chosen.task, chosen.master)
    breakpoints = breakpoints_of_run(chosen.breaks, compiled, setup) if chosen.breaks else ()
    setup = noticing(setup, breakpoints)
    rollout = session.simulator(setup, chosen.interrupt)
    skills = compiled.mind.skills if compiled.mind else ()
    texts = {(skill.name, edge.target): text_after_name(edge.fact) for skill in skills for edge in skill.edges}
    seed = secrets.randbits(31) if chosen.seed is None else chosen.seed
    return ViewedRun(setup, rollout, seed, texts, breakpoints).begun()
