"""`mindc build`: a mind with its weights in one file, for `python -m mindrun`.

Examples:
  mindc build collect.mind -o collect.bundle
  mindc build collect.mind -o avoid.bundle --master Avoid
  mindc build collect.mind -o collect.bundle --json
  mindc build ball.mind --robot robot.yaml -o ball.bundle
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import click
from mindrun.errors import MindError

from mindlang.cli import _terminal as terminal
from mindlang.cli._options import PATH, SKILLS, json_flag, named, quiet_flag, written
from mindlang.compiler.diagnostic import listed

if TYPE_CHECKING:
    from mindrun.graph.graph import Graph
    from mindrun.graph.wiring import Wiring

    from mindlang.compiler.model import Mind
    from mindlang.lock.status import ReadyMind


@click.command
@click.argument("file")
@written("-o --output", "PATH", "The bundle: -o collect.bundle", required=True)
@named("--master", "SKILL", SKILLS, "Another skill in charge: --master Avoid")
@click.option("--robot", type=PATH, metavar="FILE", help="What it is wired to: --robot robot.yaml")
@json_flag("Say what was built as one JSON document: --json")
@quiet_flag("Print nothing but errors: -q")
def command(file: str, output: Path, master: str | None, robot: Path | None) -> None:
    """Build a bundle of FILE, the one file that runs on a robot.

    It holds the hierarchy, the weights of every skill that can act, and the text of its procedures. With --robot also
    what each sensor and actuator is wired to, checked here against FILE and not on the robot; drivers of your own are
    asked what they are, and travel along. Refuses skills that have
    not been taught, or whose weights belong to another declaration.
    """
    from mindrun.engine.engine import procedure_sources
    from mindrun.graph.bundle import Bundle, write_bundle
    from mindrun.graph.wiring import reckoned

    from mindlang.lock.status import make_ready

    compiled = terminal.load_compiled(file)
    (mind, graph), folder = compiled.whole, compiled.sources[0].folder
    terminal.known_skills(graph, master or graph.master)
    graph = replace(graph, master=master or graph.master)
    _refuse_procedures(graph, mind, folder)
    wiring = _wiring(robot, graph, mind.unit_metres) if robot else None
    try:
        with terminal.writing(output, terminal.FINDINGS):
            ready = make_ready(graph, compiled.sources)
            _refuse_missing(ready, file)
            procedures = procedure_sources(ready.policy.graph, folder)
            digest = write_bundle(output, Bundle(ready.policy, procedures, wiring))
    except MindError as error:
        terminal.fail(str(error), code=terminal.MISUSE)
    servos = reckoned(wiring, graph) if wiring else {}
    without = [f"{sensor} has no driver: it is reckoned from what {servo} is sent" for sensor, servo in servos.items()]
    notes = [*ready.notes, *_needed_modules(ready, folder), *without]
    for note in notes:
        terminal.complain(f"note: {note}")
    if terminal.is_asked("as_json"):
        terminal.print_json(_built(output, digest, ready, wiring) | {"notes": notes})
    elif not terminal.is_asked("quiet"):
        count, wired = len(ready.policy.weights), f", wired to {wiring.robot}" if wiring else ""
        taught = f"{count} trained skill{'s' * (count != 1)}"
        click.echo(f"{output}: {ready.policy.graph.master} in charge, {taught}{wired}", err=True)


def _refuse_missing(ready: ReadyMind, file: str) -> None:
    """End the program where a skill that can act has no weights that fit."""
    from mindlang.run.setup import train_command

    if ready.refusals:
        terminal.fail("\n".join(ready.refusals), train_command(Path(file), ready))


def _needed_modules(ready: ReadyMind, folder: Path) -> list[str]:
    """A sentence with the modules that the robot needs beside mindrun; no sentence where it needs none."""
    from mindrun.graph.skill_sets import reachable

    from mindlang.compiler.procedures import needed_modules

    graph = ready.policy.graph
    needed = [f"{module} {where}" for module, where in needed_modules(reachable(graph, graph.master), folder).items()]
    return [f"the robot needs {listed(needed, 'and')}, which no bundle holds"] if needed else []


def _refuse_procedures(graph: Graph, mind: Mind, folder: Path) -> None:
    """Say what `check` says of procedures; end the program where one that travels cannot be what its skill needs."""
    from mindrun.graph.skill_sets import reachable

    from mindlang.compiler.procedures import mistakes

    travelling = reachable(graph, graph.master)
    found = [*mistakes(travelling, mind, folder)]
    left = mistakes([skill for skill in graph.skills if skill not in travelling], mind, folder)
    terminal.print_report([*found, *(replace(each, severity="warning") for each in left)])
    if any(each.severity == "error" for each in found):
        sys.exit(terminal.FINDINGS)


def _wiring(path: Path, graph: Graph, unit_metres: float | None) -> Wiring:
    """The wiring in a file, its report printed on stderr; one with errors ends the program."""
    from mindlang.robot.wire import load_wiring

    checked = load_wiring(path, graph, unit_metres)
    terminal.print_report(checked.diagnostics)
    if checked.wiring is None:
        sys.exit(terminal.FINDINGS if checked.readable else terminal.MISUSE)
    return checked.wiring


def _built(output: Path, digest: str, ready: ReadyMind, wiring: Wiring | None) -> dict[str, object]:
    from mindrun.graph.bundle import fingerprint
    from mindrun.graph.wiring import code_digests

    robot: dict[str, object] = {}
    if wiring:
        robot["robot"] = {"name": wiring.robot, "wiring": fingerprint(wiring)}
        if digests := code_digests(wiring):
            robot["drivers"] = digests
    return {
        "bundle": str(output),
        "sha256": digest,
        "master": ready.policy.graph.master,
        "skills": sorted(ready.policy.weights),
        **robot,
    }
