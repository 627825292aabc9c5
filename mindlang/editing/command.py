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
from mindlang.terminal import FINDINGS, console, load_compiled, print_json, talk


@dataclass(frozen=True, slots=True)
class Wishes:
    """What the command line says beside the edit itself."""

    write: bool
    keep_weights: bool
    verify: bool
    as_json: bool


def perform(of: Edit, said: Mapping[str, Any], file: str, wishes: Wishes) -> None:
    """Make an edit of a file; an impossible one ends the program with its reason."""
    project = open_project(load_compiled(file))
    try:
        edited = carry_out(project, of.function(project, **said), wishes.keep_weights)
        sentences = [*told(edited), *broken(edited)]  # before the locks are written, which they are about
        if wishes.verify:
            from mindlang.editing.verify import verified

            sentences.append(f"verified: {listed(verified(edited) or ['nothing'], 'and')} did the same to the bit")
    except EditError as error:
        _refuse(error.diagnostic, wishes)
    if wishes.write:
        write(edited)
    _show(edited, sentences, wishes)


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
