"""An edit from the command line: performed, shown, verified and written."""

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mindlang.cli._diagnostic_printer import as_data, print_report
from mindlang.cli._diff_printer import print_diff
from mindlang.cli._terminal import (
    FINDINGS,
    MISUSE,
    console,
    fail,
    load_compiled,
    print_json,
    procedures_talk,
    talk,
)
from mindlang.compiler.diagnostic import Diagnostic, listed
from mindlang.editing.apply import Edited, apply_edit, write
from mindlang.editing.edits import Edit
from mindlang.editing.project import EditError, open_project
from mindlang.editing.summary import broken_sentences, diff, not_followed, summarise


@dataclass(frozen=True, slots=True)
class EditOptions:
    """What the command line says beside the edit itself."""

    write: bool
    anyway: bool
    keep_weights: bool
    verify: bool
    as_json: bool


def perform(of: Edit, said: Mapping[str, Any], file: str, options: EditOptions) -> None:
    """Make an edit of a file; an impossible one ends the program with its reason."""
    if options.write and file == "-":
        fail("Standard input cannot be written.", "Leave --write out: the diff is printed.", MISUSE)
    project = open_project(load_compiled(file))
    try:
        edited = apply_edit(project, of.function(project, **said), options.keep_weights)
        sentences = [*summarise(edited), *_broken(edited, options), *not_followed(edited)]
        if options.verify:
            sentences.append(_verified(edited))
        if options.write:
            write(edited)
    except EditError as error:
        _refuse(error.diagnostic, options)
    _show(edited, sentences, options)


def _broken(edited: Edited, options: EditOptions) -> list[str]:
    """A sentence for each mind that would no longer compile; EditError where that is not wished for."""
    lines = broken_sentences(edited)
    if lines and options.write and not options.anyway:
        raise EditError(f"After this edit {lines[0]}", "--anyway makes it nevertheless.")
    return lines


def _verified(edited: Edited) -> str:
    """What has been verified, by running it; EditError where a trained skill would do something else."""
    from mindlang.cli._simulator_compilation import prepare
    from mindlang.editing.verify import verify_unchanged

    with procedures_talk():
        skills = verify_unchanged(edited, prepare)
    if not skills:
        return "verified: there is no trained skill that this edit leaves as it was"
    return f"verified: {listed(skills, 'and')} did the same to the bit"


def _show(edited: Edited, sentences: list[str], options: EditOptions) -> None:
    if options.as_json:
        print_json({"diff": diff(edited), "written": options.write, "weights": sentences})
        return
    if not options.write:
        print_diff(diff(edited))
    for line in sentences:
        talk.print(line, markup=False)
    talk.print(_ending(edited, options.write), markup=False)


def _ending(edited: Edited, is_written: bool) -> str:
    """Which files are written, or would be."""
    locks = [path.name for path in edited.changed_locks]
    if is_written:
        return f"written: {listed([*(path.name for path in edited.texts), *locks], 'and')}"
    also = f", and changes {listed(locks, 'and')} as well" if locks else ""
    return f"nothing has been written: --write makes this edit{also}"


def _refuse(diagnostic: Diagnostic, options: EditOptions) -> None:
    if options.as_json:
        print_json({"diagnostics": [as_data(diagnostic)]})
    else:
        print_report([diagnostic], console(stderr=True))
    sys.exit(FINDINGS)
