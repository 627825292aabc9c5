"""`mindc propose`: the agent chooses the sensors, actuators and subskills of a task.

Examples:
  mindc propose robot.mind Fetch             print a skill for it, as a diff
  mindc propose robot.mind Fetch --apply     and write it
  mindc propose robot.mind Fetch --teach     and teach it after that
  mindc propose robot.mind Fetch --skill Fetcher --json
"""

from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

import click
from mindrun.processors import cores

from mindlang.cli import _options as options
from mindlang.cli import _terminal as terminal

if TYPE_CHECKING:
    from mindlang.cli._session import RunSession
    from mindlang.compiler.compile import Compiled
    from mindlang.editing.apply import Edited
    from mindlang.propose.trial import Stage


@click.command
@click.argument("file")
@click.argument("task", shell_complete=options.TASKS)
@options.named("--skill", "NAME", options.SKILLS, "What the skill is called. Default: as the task.")
@options.flag("--apply", "Write the proposal into FILE, as an edit does.")
@options.flag("--teach", "Write it, and teach the skill.")
@click.option("--seed", type=options.SEED, default=1, show_default=True, help="The same seed proposes the same.")
@options.WORKERS
@options.json_flag()
@options.quiet_flag()
def command(file: str, task: str, skill: str | None, apply: bool, teach: bool, seed: int, workers: int | None) -> None:
    """Propose a skill for a task without one.

    What it reads, drives and influences. Tries what the mind has: a taught skill as it is, or with its readings
    exchanged, masters over taught skills, and skills from scratch, all on the same layouts. What is added has to be
    surely better; what costs nothing when it is held at its mean is left out. Prints the diff, with the evidence behind
    each line.

    Runs the Python code of the file's procedures. Exits with 1 where nothing that was tried does better than nothing.
    """
    from mindlang.cli._session import RunSession
    from mindlang.propose.report import proposal_data, proposal_sentences, proposed_lines
    from mindlang.propose.search import propose

    terminal.refuse_standard_input(file, "Standard input cannot be edited: name a file.")
    session, began = RunSession(), perf_counter()
    stage = _stage(file, task, skill, seed, workers or cores())
    with terminal.procedures_talk():
        found = propose(stage)
    edited = _edited(stage.compiled, proposed_lines(stage, found))
    diff = _diff(edited)
    if terminal.is_asked("as_json"):
        terminal.print_json(proposal_data(stage, found, perf_counter() - began, diff))
    else:
        terminal.print_diff(diff)
    session.say(*proposal_sentences(stage, found))
    if found.winner.candidate.way == "nothing":
        raise SystemExit(terminal.FINDINGS)
    if edited and (apply or teach):
        _write(edited, session)
    if edited and teach and found.winner.candidate.learns:
        _teach(stage)


def _stage(file: str, task: str, skill: str | None, seed: int, workers: int) -> "Stage":
    """The task and all that candidates for it are tried with; ends the program where there is no such task."""
    from mindlang.cli._session import counting, ensure_compiled, refusing_setups
    from mindlang.editing.project import EditError, project_alone, refuse_misnamed
    from mindlang.propose.static import known_of
    from mindlang.propose.trial import Stage
    from mindlang.run.chosen_task import task_of

    compiled, quiet = terminal.load_compiled(file), terminal.is_asked("quiet")
    with refusing_setups():
        chosen, _ = task_of(compiled.whole[1], task)
    name, project = skill or chosen.name, project_alone(compiled)
    try:
        refuse_misnamed("skill", name)
        project.refuse_taken("skill", name)
    except EditError as error:
        terminal.fail(str(error), "mindc propose … --skill NAME says another.", terminal.MISUSE)
    curriculum = name if name not in project.names.table.get("curriculum", {}) else f"Teach{name}"
    known = known_of(compiled, chosen.name)
    path = Path(file).resolve()
    return Stage(
        compiled,
        path,
        known,
        name,
        curriculum,
        seed,
        workers,
        lambda rollout: ensure_compiled(rollout, terminal.tell),
        lambda what, total: counting(what, total, quiet),
    )


def _edited(compiled: "Compiled", lines: list[str]) -> "Edited | None":
    """The edit that adds some lines to a file, made in memory; None where there are none."""
    from mindlang.editing.apply import apply_edit
    from mindlang.editing.edits.declarations import add
    from mindlang.editing.project import EditError, open_project

    if not lines:
        return None
    project = open_project(compiled)
    with terminal.refusing(of=EditError):
        return apply_edit(project, add(project, tuple(lines)), False)


def _diff(edited: "Edited | None") -> str:
    from mindlang.editing.summary import diff

    return diff(edited) if edited else ""


def _write(edited: "Edited", session: "RunSession") -> None:
    from mindlang.editing.apply import write

    with terminal.refusing():
        write(edited)
    session.say("written: " + ", ".join(path.name for path in edited.texts))


def _teach(stage: "Stage") -> None:
    """Teach the skill that has been written, by its lesson."""
    from mindlang.cli._trainer import Trainer
    from mindlang.training.lesson_choice import TrainOptions

    trainer = Trainer(stage.workers, False, terminal.is_asked("quiet"))
    with terminal.refusing():
        trainer.teach_file(stage.path, [stage.skill], stage.curriculum, TrainOptions(), False, stage.seed, Path("runs"))
