"""An edit from the command line: performed, shown, verified and written."""

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mindlang.diagnostic import Diagnostic, listed
from mindlang.editing.carry_out import Edited, carry_out, write
from mindlang.editing.catalog import Edit
from mindlang.editing.neighbours import broken
from mindlang.editing.project import EditError, open_project
from mindlang.editing.telling import told
from mindlang.report import as_data, print_report
from mindlang.terminal import FINDINGS, MISUSE, console, fail, load_compiled, print_json, talk


@dataclass(frozen=True, slots=True)
class Wishes:
    """What the command line says beside the edit itself."""

    write: bool
    keep_weights: bool
    verify: bool
    as_json: bool


def perform(of: Edit, said: Mapping[str, Any], file: str, wishes: Wishes) -> None:
    """Make an edit of a file; an impossible one ends the program with its reason."""
    if wishes.write and file == "-":
        fail("Standard input cannot be written.", "Leave --write out: the diff is printed.", MISUSE)
    project = open_project(load_compiled(file))
    try:
        edited = carry_out(project, of.function(project, **said), wishes.keep_weights)
        sentences = [*told(edited), *broken(edited)]
        if wishes.verify:
            from mindlang.editing.verify import verified

            sentences.append(_verified(verified(edited)))
        if wishes.write:
            write(edited)
    except EditError as error:
        _refuse(error.diagnostic, wishes)
    _show(edited, sentences, wishes)


def _verified(skills: list[str]) -> str:
    if not skills:
        return "verified: there is no trained skill that this edit leaves as it was"
    return f"verified: {listed(skills, 'and')} did the same to the bit"


def _show(edited: Edited, sentences: list[str], wishes: Wishes) -> None:
    if wishes.as_json:
        print_json({"diff": edited.diff, "written": wishes.write, "weights": sentences})
        return
    if not wishes.write:
        sys.stdout.write(edited.diff)
    for line in sentences:
        talk.print(line, markup=False)
    if not wishes.write:
        talk.print("nothing has been written: --write makes this edit", markup=False)


def _refuse(diagnostic: Diagnostic, wishes: Wishes) -> None:
    if wishes.as_json:
        print_json({"diagnostics": [as_data(diagnostic)]})
    else:
        print_report([diagnostic], console(stderr=True))
    sys.exit(FINDINGS)
