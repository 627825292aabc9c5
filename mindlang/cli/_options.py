"""Types of options and arguments: numbers that say both of their bounds, files, names that a shell completes."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields
from functools import partial, wraps
from math import isfinite, nan
from pathlib import Path
from typing import Any, TypeVar

import click
from click.core import ParameterSource
from click.shell_completion import CompletionItem

from mindlang import limits
from mindlang.cli._terminal import MISUSE, refusing

SHOWN_CHARACTERS = 20  # of what is refused
MAX_TICK_DIGITS = 15
Completion = Callable[[click.Context, click.Parameter, str], list[CompletionItem]]
Chosen = TypeVar("Chosen")
Option = Callable[[Callable[..., Any]], Callable[..., Any]]  # a decorator of a command


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
        seed, slash, number = str(value).partition("/")
        if not slash:
            return super().convert(value, param, ctx)
        first = SEED.convert(seed, param, ctx)
        run = RUNS.convert(number, param, ctx)
        from mindlang.run.setup import layouts

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


def tick_span(text: str) -> tuple[int, int]:
    """The first and the last tick of a span, 800..812, or of a single one, 812."""
    first, dots, last = text.partition("..")
    words = [first, last] if dots else [first]
    if all(word.isascii() and word.isdigit() and len(word) <= MAX_TICK_DIGITS for word in words):
        ticks = [int(word) for word in words]
        if 1 <= ticks[0] <= ticks[-1]:
            return ticks[0], ticks[-1]
    raise click.BadParameter(f"{_shortened(text)} is no tick from 1 on, and no span of ticks: 812 or 800..812.")


def executor(text: str) -> Any:
    """The executor of jobs that --on says, None for threads; a sentence where it says none that is known."""
    from mindrun.errors import MindError

    from mindlang.executors import where

    try:
        return where(text)
    except MindError as error:
        raise click.BadParameter(f"{error}; {error.hint}.") from error


def _executors() -> dict[str, str]:
    """The kinds of executors; what stands behind their colon is the user's."""
    from mindlang.executors import THREADS, kinds_by_usage

    return {THREADS: "of this process", **{f"{name}:": usage for name, usage in kinds_by_usage().items()}}


def new_file(text: str) -> Path:
    """The path of a file that is to be written; a sentence where it has no name or is that of a folder."""
    if "\0" in text or text.endswith("/") or Path(text).name in ("", ".."):
        raise click.BadParameter(f"{text!r} names no file.")
    return Path(text)


def named(flag: str, metavar: str, names: Completion, about: str, **more: Any) -> Option:
    """An option for a name, which a shell completes; behind the flag may stand what the command calls it."""
    return click.option(*flag.split(), metavar=metavar, shell_complete=names, help=about, **more)


def written(flag: str, metavar: str, about: str, **more: Any) -> Option:
    """An option for a file that is to be written; behind the flag may stand what the command calls it."""
    return click.option(*flag.split(), type=new_file, metavar=metavar, help=about, **more)


def flag(names: str, about: str, **more: Any) -> Option:
    """An option that takes no value; behind its names may stand what the command calls it."""
    return click.option(*names.split(), is_flag=True, help=about, **more)


def unless(names: str, about: str) -> Option:
    """A flag for what holds without it: what the command is told is False where the flag is given."""
    return flag(names, about, callback=lambda context, parameter, value: not value)


def json_flag(about: str = "Print one JSON document instead.") -> Option:
    """The flag --json, of which `terminal.is_asked` knows."""
    return flag("--json as_json", about, expose_value=False, callback=_note)


def quiet_flag(about: str = "Print nothing but results and errors.") -> Option:
    """The flag --quiet, of which `terminal.is_asked` knows."""
    return flag("-q --quiet", about, expose_value=False, callback=_note)


def _note(context: click.Context, parameter: click.Parameter, value: bool) -> None:
    context.meta[str(parameter.name)] = value


def taken(of: type[Chosen], said: dict[str, Any]) -> Chosen:
    """A value of a dataclass that has fields called as options; what it takes is no longer among what was `said`."""
    known = fields(of)  # type: ignore[arg-type]  # there is no name for the type of dataclasses
    return of(**{each.name: said.pop(each.name) for each in known if each.name in said})


def refuse_ineffective(what_they_are: str, *names: str) -> None:
    """UsageError where one of these parameters of the command was given, since it would have no effect."""
    context = click.get_current_context()
    all_of_them = [each for each in context.command.params if each.name in names]
    if any(context.get_parameter_source(name) is ParameterSource.COMMANDLINE for name in names):
        from mindlang.compiler.diagnostic import listed

        words = [each.opts[0] if isinstance(each, click.Option) else each.human_readable_name for each in all_of_them]
        verb = "is" if len(words) == 1 else "are"
        raise click.UsageError(f"{listed(words, 'and')} {verb} {what_they_are}.")


def _shortened(value: object) -> str:
    text = str(value)
    return repr(text if len(text) <= SHOWN_CHARACTERS else f"{text[:SHOWN_CHARACTERS]}…")


def files_of(words: Sequence[str], *suffixes: str) -> list[str]:
    """The files that are named, by themselves or by their folder; a folder without any ends the program."""
    from mindlang.files import named_files

    with refusing(MISUSE):
        return named_files(words, *suffixes)


def in_files(words: Sequence[str], files: Sequence[str]) -> str:
    """The end of a summary that says in how many files; empty where each of them was named by itself."""
    from mindlang.files import is_folder

    return f" in {len(files)} file{'s' * (len(files) != 1)}" if any(map(is_folder, words)) else ""


def one_of(known: Callable[[], Mapping[str, str]]) -> Completion:
    """Complete a parameter with names, each with what a shell says of it."""

    def found(context: click.Context, parameter: click.Parameter, begun: str) -> list[CompletionItem]:
        return [CompletionItem(name, help=about) for name, about in known().items() if name.startswith(begun)]

    return found


def declared(*nouns: str) -> Completion:
    """Complete a parameter with the names that the mind on the line declares with one of these nouns, or with any."""

    def found(context: click.Context, parameter: click.Parameter, begun: str) -> list[CompletionItem]:
        said = context.params.get(parameter.name or "")
        there = {*said} if isinstance(said, tuple) else set()
        known = {name: noun for noun, name in _declarations(context, parameter) if not nouns or noun in nouns}
        return [
            CompletionItem(name, help=noun)
            for name, noun in known.items()
            if name.startswith(begun) and name not in there
        ]

    return found


def _declarations(context: click.Context, parameter: click.Parameter) -> Iterator[tuple[str, str]]:
    """The noun and the name of each declaration in the .mind files before this word, and in those that they use.

    An option may stand before the file: then they are those of this folder.
    """
    from mindlang.compiler.compile import read_files, read_source
    from mindlang.compiler.diagnostic import Findings

    values = [*context.params.values(), *context.args]  # before the value of an option, arguments are not sorted yet
    said = [word for value in values for word in (value if isinstance(value, tuple) else [value])]
    minds = [Path(word) for word in said if isinstance(word, str) and word.endswith(".mind")]
    for mind in minds or (Path().glob("*.mind") if isinstance(parameter, click.Option) else ()):
        try:
            source = read_source(mind, str(mind))
        except (OSError, ValueError):
            continue  # nobody has asked for a message in the middle of a line
        for file in read_files(source, mind.resolve(), Findings(), {})[0]:
            yield from ((each.header.noun.text, each.header.name.text) for each in file.declarations)


SEED = WholeOption(*limits.SEED_BOUNDS)
LAYOUT = LayoutOption(*limits.LAYOUT_BOUNDS)
RUNS = WholeOption(*limits.RUN_BOUNDS)
WORKERS = click.option(
    "--workers",
    type=WholeOption(*limits.WORKER_BOUNDS),
    help="How many cores to use (default: all). Changes nothing else.",
)
ON = partial(click.option, "--on", "where", type=executor, metavar="WHERE", shell_complete=one_of(_executors))
ROBOT = WholeOption(*limits.ROBOT_BOUNDS)
PATH = click.Path(path_type=Path)
SKILLS, TASKS = declared("skill"), declared("task")
IN_CHARGE = "Who is in charge. Default: the mind's master if a lesson on the task is under it, else that of the first."
WATCHED = "Of several robots in the world: through whose mind the run is seen. Default: 0, the first."
OF_TASK = named("--task", "TASK", TASKS, "Default: that on which the master is taught, or of its name.")
OF_A_CAST = "task", "master", "interrupt", "robot"  # who does what in a run
OF_A_RUN = (*OF_A_CAST, "seed")
OF_RUNS_ALONE = "of runs, not of recordings"


@dataclass(frozen=True, slots=True)
class RunChoice:
    """The run of a mind to make, or with `mindc bench` the runs; None for what was not said."""

    task: str | None
    seed: int | None
    master: str | None
    interrupt: bool
    robot: int = 0


def run_options(seed: str) -> Option:
    """The options of a command that say which run it makes, with a help for --seed; it takes them as `chosen`."""

    def decorated(command: Callable[..., Any]) -> Callable[..., Any]:
        @OF_TASK
        @click.option("--seed", type=LAYOUT, help=seed)
        @named("--master", "SKILL", SKILLS, IN_CHARGE)
        @click.option("--robot", type=ROBOT, default=0, help=WATCHED)
        @unless("--no-interruption interrupt", "Go on to the last tick, whatever would end the run.")
        @wraps(command)
        def called(**said: Any) -> Any:
            return command(chosen=taken(RunChoice, said), **said)

        return called

    return decorated
