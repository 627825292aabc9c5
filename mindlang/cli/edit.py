"""`mindc edit`: every edit is a command, built from the signature of its function; `undo` takes the last one back.

Examples:
  mindc edit rename collect.mind Avoid Dodge --noun skill
  mindc edit encapsulate collect.mind Collect CarefulCollect \\
    --with Avoid --reads proximity --write
  mindc edit undo collect.mind                 takes that back
"""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from mindlang.cli import Suggesting
from mindlang.cli import _terminal as terminal
from mindlang.cli._diagnostic_printer import as_data
from mindlang.cli._options import SKILLS, declared, flag, json_flag
from mindlang.compiler.diagnostic import listed

if TYPE_CHECKING:
    from mindlang.editing.apply import Edited
    from mindlang.editing.edits import Edit, EditOption


UNDO = "undo"
# What a shell completes the parameters of edits with; whatever is not among them is not declared yet.
NAMED = {
    **dict.fromkeys(("skill", "parent", "subskills", "--with"), SKILLS),
    **dict.fromkeys(("target", "what", "old", "names", "--to", "--from"), declared()),
    "--reads": declared("sensor", "memory"),
}


class Edits(Suggesting):
    """The edits as commands, each imported when it is asked for, and `undo`."""

    noun = "edit"

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The names of all edits, and of `undo`."""
        from mindlang.editing.edits import names

        return sorted([*names(), UNDO])

    def load(self, name: str) -> click.Command:
        """The edit of that name as a command."""
        from mindlang.editing.edits import edit

        return undo if name == UNDO else _command(edit(name))


@click.group(cls=Edits)
def command() -> None:
    """Edit a hierarchy in its source.

    Prints the diff; --write makes the edit: sources, locks and weights together. `undo` takes back the last one.
    """


def _command(of: Edit) -> click.Command:
    """A click command with the parameters of an edit, and those that all of them have."""
    arguments = (
        click.Argument([name], nargs=-1 if many else 1, required=True, shell_complete=NAMED.get(name))
        for name, many in of.arguments
    )
    own = [click.Argument(["file"]), *arguments, *map(_option, of.options)]

    @click.command(of.name, params=own, help=of.text, epilog=f"\b\n{of.example}")
    @flag("--write", "Make the edit, and not only print it.")
    @flag("--anyway", "Make it even where a mind that uses this one no longer compiles.")
    @flag(
        "--keep-weights",
        "Let a skill that reads or influences more go on as it was taught: weights of zero for what is new.",
    )
    @flag(
        "--verify",
        "Run every trained skill before and after on the same readings, and refuse what changes one of them.",
    )
    @json_flag("One JSON document instead.")
    def called(**said: Any) -> None:
        _perform(of, **said)

    return called


def _file_first(of: Edit, first: str, said: dict[str, Any]) -> tuple[str, dict[str, Any]]:
    """The file of an edit and its other words: the first word, or the last where only that is a file, as until 0.1."""
    words = [first, *(word for name, many in of.arguments for word in (said[name] if many else [said[name]]))]
    is_first = _is_mind(first) and not _is_mind(words[-1])
    if is_first or not (_is_mind(words[-1]) or _is_file(words[-1])) or (_is_file(first) and not _is_mind(words[-1])):
        return first, said
    *words, last = words
    single = {name: words.pop(0) for name, many in of.arguments if not many}
    return last, said | single | {name: tuple(words) for name, many in of.arguments if many}


def _is_mind(word: str) -> bool:
    return word.endswith(".mind") or word == "-"


def _is_file(word: str) -> bool:
    return os.path.isfile(word)  # noqa: PTH113 (pathlib raises where one may not look)


def _option(option: EditOption) -> click.Option:
    flags = [f"--{option.name.strip('_').replace('_', '-')}", option.name]
    if isinstance(option.default, bool):
        return click.Option(flags, is_flag=True, help=option.help)
    default, names = None if option.many else option.default, NAMED.get(flags[0])
    return click.Option(flags, multiple=option.many, default=default, help=option.help, shell_complete=names)


def _perform(of: Edit, file: str, write: bool, anyway: bool, keep_weights: bool, verify: bool, **said: Any) -> None:
    """Make an edit of a file, or only show it; an impossible one ends the program with its reason."""
    from mindlang.editing.apply import apply_edit
    from mindlang.editing.apply import write as write_edited
    from mindlang.editing.project import EditError, open_project
    from mindlang.editing.summary import broken_sentences, diff, not_followed, summarise

    file, said = _file_first(of, file, said)
    if write and file == "-":
        terminal.fail("Standard input cannot be written.", "Leave --write out: the diff is printed.", terminal.MISUSE)
    project = open_project(terminal.load_compiled(file))
    try:
        edited = apply_edit(project, of.function(project, **said), keep_weights)
        broken = broken_sentences(edited)
        if broken and write and not anyway:
            raise EditError(f"After this edit {broken[0]}", "--anyway makes it nevertheless.")
        sentences = [*summarise(edited), *broken, *not_followed(edited)]
        if verify:
            sentences.append(_verified(edited))
        if write:
            write_edited(edited)
    except EditError as error:
        if terminal.is_asked("as_json"):
            terminal.print_json({"diagnostics": [as_data(error.diagnostic)]})
        else:
            terminal.print_report([error.diagnostic])
        sys.exit(terminal.FINDINGS)
    if terminal.is_asked("as_json"):
        terminal.print_json({"diff": diff(edited), "written": write, "weights": sentences})
        return
    if not write:
        terminal.print_diff(diff(edited))
    terminal.tell(*sentences, _ending(edited, write))


def _verified(edited: Edited) -> str:
    """Run the trained skills before and after, and say which do the same; EditError where one does something else."""
    from mindlang.cli._session import ensure_compiled
    from mindlang.editing.verify import verify_unchanged

    with terminal.procedures_talk():
        skills = verify_unchanged(edited, ensure_compiled)
    if not skills:
        return "verified: there is no trained skill that this edit leaves as it was"
    return f"verified: {listed(skills, 'and')} did the same to the bit"


def _ending(edited: Edited, is_written: bool) -> str:
    """A line that says which files are written, or would be."""
    locks = [path.name for path in edited.changed_locks]
    if is_written:
        return f"written: {listed([*(path.name for path in edited.texts), *locks], 'and')}"
    also = f", and changes {listed(locks, 'and')} as well" if locks else ""
    return f"nothing has been written: --write makes this edit{also}"


@click.command
@click.argument("place", default=".", metavar="[FILE_OR_FOLDER]")
@json_flag("One JSON document instead: mindc edit undo --json")
def undo(place: str) -> None:
    """Take back the edit that was last written in a folder.

    Sources, locks and weights become what they were before it, together or not at all. Without FILE_OR_FOLDER it is the
    working directory. Where one of the files has been changed since, nothing is. Edits before the last are not kept.

    Examples:
      mindc edit undo
      mindc edit undo examples/collect
      mindc edit undo examples/collect/collect.mind
    """
    from mindlang.compiler.source import decode_source
    from mindlang.editing.transaction import TransactionError, noted_in
    from mindlang.editing.transaction import undo as take_back
    from mindlang.editing.unified_diff import unified

    here = Path(place).absolute()
    if not here.exists():
        hint = "Name a file or a folder in which an edit was written."
        terminal.fail(f"{place} is not there.", hint, terminal.MISUSE)
    folder = noted_in(here)
    if folder is None:
        none = f"In {place} no edit has been written that could be taken back."
        terminal.fail(none, "Name the file that was edited: mindc edit undo FILE")
    with terminal.refusing(end=".", of=TransactionError):
        were, are = take_back(folder)
    names = {
        path: path.relative_to(folder).as_posix() for end in (".mind", ".lock") for path in are if path.suffix == end
    }
    sources = ((names[path], were[path], are[path]) for path in are if path.suffix == ".mind")
    diff = "".join(unified(name, decode_source(was or b""), decode_source(now or b"")) for name, was, now in sources)
    if terminal.is_asked("as_json"):
        terminal.print_json({"diff": diff, "folder": str(folder), "written": [*names.values()]})
        return
    terminal.print_diff(diff)
    terminal.tell(f"taken back: {listed([*names.values()], 'and')}")
