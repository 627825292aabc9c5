"""What options may be: numbers that say both of their bounds, files to be written, and none without effect."""

from __future__ import annotations

from math import isfinite, nan
from pathlib import Path
from typing import Any

import click
from click.core import ParameterSource
from click.shell_completion import CompletionItem

from mindlang import limits
from mindlang.cli._declared_names import SKILLS, TASKS

SHOWN_CHARACTERS = 20  # of what is refused
MAX_TICK_DIGITS = 15


class WholeOption(click.IntRange):
    """A whole number from one bound to another."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The number; as click does it, with a sentence that says the bounds."""
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter:
            self.fail(f"{_shortened(value)} is not a whole number from {self.min} to {self.max}.", param, ctx)


class LayoutOption(WholeOption):
    """The seed of one run, or which of those of `mindc bench`: 2/17 is the 17th of those from seed 2."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The seed."""
        seed, slash, number = str(value).partition("/")
        if not slash:
            return super().convert(value, param, ctx)
        first = SEED.convert(seed, param, ctx)
        run = WholeOption(*limits.RUN_BOUNDS).convert(number, param, ctx)
        from mindlang.run.many_runs import layouts

        return layouts(first, run)[-1]


class NumberOption(click.FloatRange):
    """A number from one bound to another; nan, of which no comparison holds, is none."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The number; as click does it, with a sentence that says the bounds."""
        try:
            number = super().convert(value, param, ctx)
        except click.BadParameter:
            number = nan
        if isfinite(number):
            return number
        low = f"above {self.min:g}, and at most" if self.min_open else f"from {self.min:g} to"
        return self.fail(f"{_shortened(value)} is not a number {low} {self.max:g}.", param, ctx)


class TickSpan(click.ParamType[tuple[int, int]]):
    """A tick, or the first and the last of several: 812 or 800..812."""

    name = "ticks"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[int, int]:
        """The first tick and the last one."""
        first, dots, last = str(value).partition("..")
        words = [first, last] if dots else [first]
        if all(word.isascii() and word.isdigit() and len(word) <= MAX_TICK_DIGITS for word in words):
            ticks = [int(word) for word in words]
            if 1 <= ticks[0] <= ticks[-1]:
                return ticks[0], ticks[-1]
        return self.fail(
            f"{_shortened(value)} is no tick from 1 on, and no span of ticks: 812 or 800..812.", param, ctx
        )


class WhereOption(click.ParamType[Any]):
    """Where jobs are done: threads, or a kind of executor and what is said of it."""

    name = "where"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """What it says, None for threads; a sentence where it says nothing that is known."""
        from mindrun.errors import MindError

        from mindlang.executors import where

        try:
            return where(str(value))
        except MindError as error:
            return self.fail(f"{error}; {error.hint}.", param, ctx)

    def shell_complete(self, ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
        """The kinds; what stands behind their colon is the user's."""
        from mindlang.executors import THREADS, kinds_by_usage

        known = {THREADS: "of this process", **{f"{name}:": usage for name, usage in kinds_by_usage().items()}}
        return [CompletionItem(name, help=usage) for name, usage in known.items() if name.startswith(incomplete)]


class NewFile(click.Path):
    """The path of a file that is to be written."""

    def __init__(self) -> None:
        super().__init__(path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The path, unless it has no name or is that of a folder."""
        text = str(value)
        if "\0" in text or text.endswith("/") or Path(text).name in ("", ".."):
            self.fail(f"{text!r} names no file.", param, ctx)
        return Path(text)


def refuse_ineffective(what_they_are: str, *names: str) -> None:
    """UsageError where one of these parameters of the command was said, since nothing would come of it."""
    context = click.get_current_context()
    all_of_them = [each for each in context.command.params if each.name in names]
    if any(context.get_parameter_source(name) is ParameterSource.COMMANDLINE for name in names):
        from mindlang.compiler.diagnostic import listed

        words = [each.opts[0] if isinstance(each, click.Option) else each.human_readable_name for each in all_of_them]
        verb = "is" if len(words) == 1 else "are"
        raise click.UsageError(f"{listed(words, 'and')} {verb} {what_they_are}.")


SEED = WholeOption(*limits.SEED_BOUNDS)
LAYOUT = LayoutOption(*limits.LAYOUT_BOUNDS)
WORKERS = WholeOption(*limits.WORKER_BOUNDS)
ON = WhereOption()
IN_CHARGE = "Who is in charge. Default: the mind's master if a lesson on the task is under it, else that of the first."
UNDER_MASTER = click.option("--master", metavar="SKILL", shell_complete=SKILLS, help=IN_CHARGE)
OF_TASK = click.option(
    "--task", metavar="TASK", shell_complete=TASKS, help="Default: that on which the master is taught, or of its name."
)
OF_A_CAST = "task", "master", "no_interruption"  # who does what in a run
OF_A_RUN = (*OF_A_CAST, "seed")
OF_RUNS_ALONE = "of runs, not of recordings"


def _shortened(value: object) -> str:
    text = str(value)
    return repr(text if len(text) <= SHOWN_CHARACTERS else f"{text[:SHOWN_CHARACTERS]}…")
