"""`mindc audit`: what the rewards of a task really pay, and for what.

Examples:
  mindc audit collect.mind
  mindc audit collect.mind GoToObject
  mindc audit collect.mind Avoid --seed 2 --json
  mindc audit collect.mind GoToObject --search 30
  mindc audit collect.mind GoToObject --replay found.rec
"""

import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from mindrun.processors import cores

from mindlang.cli import _options as options
from mindlang.cli import _terminal as terminal

if TYPE_CHECKING:
    from mindrun.graph.graph import Graph, Task
    from mindrun.graph.policy import Policy

    from mindlang.audit.findings import Findings
    from mindlang.cli._session import RunSession
    from mindlang.compiler.compile import Compiled

MAX_SEARCH_SECONDS = 3600


@click.command
@click.argument("file")
@click.argument("task", required=False, shell_complete=options.TASKS)
@click.option("--seed", type=options.SEED, default=1, show_default=True, help="Draws the layouts and the genomes.")
@click.option(
    "--search",
    type=options.WholeOption(0, MAX_SEARCH_SECONDS),
    default=0,
    metavar="SECONDS",
    help="Let the task's learner look for points without what is counted, for so long on an idle core.",
)
@options.written("--replay", "PATH.rec", "Write a run of the loophole that pays most, for mindc view.")
@options.WORKERS
@options.json_flag()
@options.quiet_flag()
def command(file: str, task: str | None, seed: int, search: int, replay: Path | None, workers: int | None) -> None:
    """Say what the rewards of TASK pay, and for what.

    Some 230 policies run on the same layouts: commands that never change, all that moves to and fro, random genomes of
    what the task teaches, and every skill as master that was taught. Findings are at the line that pays: points without
    what is counted, standing still that beats moving, what to and fro is paid for, lines that pay nobody or that nobody
    feels. Without TASK every task of FILE that has rewards.

    Runs the Python code of the file's procedures; a skill that can only run in Python is left out. Ends with 0 where
    nothing was found, with 1 where something was.
    """
    from mindlang.cli._session import RunSession, refusing_setups
    from mindlang.training.subject import open_subject

    session, compiled = RunSession(), terminal.load_compiled(file)
    if replay:
        terminal.refuse_unwritable(replay, ".rec")
    found, data = list[Any](), list[dict[str, Any]]()
    with refusing_setups(), terminal.procedures_talk():
        policy = open_subject(Path(file), compiled).policy
        tasks = _chosen(policy.graph, task)
        audited = [_audited(session, compiled, policy, each, (seed, search, workers or cores())) for each in tasks]
        for each in audited:
            found += (own := each.all())
            data.append(_told(each, own, seed))
        if replay:
            _replay(session, audited, compiled.sources[0].folder, replay, seed)
    if terminal.is_asked("as_json"):
        terminal.print_json({"tasks": data})
    else:
        terminal.print_report(found, terminal.console())
        session.say(f"{len(found) or 'nothing'} {'found' if not found else 'finding' + 's' * (len(found) != 1)}")
    sys.exit(terminal.FINDINGS if found else terminal.OK)


def _told(found: "Findings", own: list[Any], seed: int) -> dict[str, Any]:
    """The table of a task, printed unless data are asked for; and its data."""
    from mindlang.audit.findings import audit_data, audit_table
    from mindlang.cli._diagnostic_printer import as_data

    if not terminal.is_asked("as_json"):
        terminal.console().print(audit_table(found), end="\n\n")
    return audit_data(found, seed) | {"findings": [as_data(each) for each in own]}


def _chosen(graph: "Graph", name: str | None) -> "list[Task]":
    """The tasks to audit; SetupError where there are none."""
    from mindlang.run.chosen_task import SetupError, task_of

    tasks = [task_of(graph, name)[0]] if name else [each for each in graph.tasks if each.rewards]
    if not tasks or not tasks[0].rewards:
        raise SetupError(f"{name or 'no task'} pays nothing", "add a line such as rewards 10 on reach of object", True)
    return tasks


def _audited(
    session: "RunSession", compiled: "Compiled", policy: "Policy", task: "Task", how: tuple[int, int, int]
) -> "Findings":
    """A task that was audited; `how` are the seed, the seconds of the search, and the workers."""
    from mindlang.audit.findings import Findings
    from mindlang.audit.probes import probes_of, tried
    from mindlang.audit.search import search
    from mindlang.cli._session import ensure_compiled

    (seed, seconds, workers), folder = how, compiled.sources[0].folder
    ready = partial(ensure_compiled, say=session.say)
    probes = [*probes_of(policy, task, seed)]
    with session.counting(f"{task.name}: probes", sum(len(each.genomes) for each in probes)) as told:
        evidence = tried(_counted(probes, told), task, folder, seed, workers, ready)
    of = next(each for each in compiled.whole[0].tasks if each.name == task.name)
    found = Findings(of, task, evidence)
    if seconds and found.is_counted:
        with session.counting(f"{task.name}: search", seconds) as told:
            more = search(found, policy, folder, seed, seconds, workers, ready, told)
        found = found if more is None else Findings(of, task, evidence + more)
    return found


def _counted(probes: Any, told: Any) -> Iterator[Any]:
    """The probes, each told when the next is asked for."""
    for each in probes:
        yield each
        told(len(each.genomes))


def _replay(session: "RunSession", audited: "list[Findings]", folder: Path, path: Path, seed: int) -> None:
    """Write a run of the loophole that pays most, and the bundle that it is seen with."""
    from mindrun.graph.bundle import pack
    from mindrun.terminal.command_line import command_line

    from mindlang.audit.probes import probe_layouts
    from mindlang.lock.status import ReadyMind
    from mindlang.run.recorded_run import record_run
    from mindlang.run.recording import bundle_without_robot, run_bytes
    from mindlang.run.setup import RunSetup

    holes = [(each.free[row], each, row) for each in audited for row in each.loophole_rows.values()]
    if not holes:
        session.note("there is no loophole to be seen: nothing is written")
        return
    _, of, row = max(holes, key=lambda each: each[0])
    probe = of.evidence.probe(row)
    setup = RunSetup(of.task, probe.master, ReadyMind(probe.policy, (), ()), folder)
    layout = probe_layouts(of.task, probe, seed)[0]
    run = record_run(setup, probe.rollout(of.task.name, folder), layout)
    bundle = path.with_suffix(".bundle")
    terminal.write_file(path, run_bytes(run, setup, layout))
    terminal.write_file(bundle, pack(bundle_without_robot(setup.ready, folder)))
    session.note(f"{of.task.name}, {probe.name}: {command_line('mindc', 'view', path, bundle)}")
