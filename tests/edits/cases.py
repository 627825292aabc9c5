"""The cases of the edits: `NAME.txt` has the source before, the command, and what it makes of it.

    ==== what the case shows
    the source before                               (none: roam.mind, or the file that the command names)
    -- parts.mind --
    a file that it uses
    ---> rename Avoid Dodge                         (---x for an edit that is refused; several are made in turn)
    the source after, the diff or the message       (the diff where there is no source before)
    -- parts.mind --
    that file after, if it is another

A blank line ends each. The files of `minds/` and `examples/collect` that a case names stand beside its source.
"""

import re
import shlex
import shutil
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from tests.language.examples import COLLECT

HERE = Path(__file__).parent
MINDS = [*sorted((HERE / "minds").glob("*.mind")), *sorted(COLLECT.parent.glob("*.mind"))]
OWN, SHARED = "mind.mind", "roam.mind"

Files = dict[str, str]  # texts by name


@dataclass(frozen=True, slots=True)
class Case:
    """A source, which commands edit it, and what comes out: `after` as it stands in the file of cases."""

    edit: str
    title: str
    before: Files
    commands: tuple[str, ...]
    refused: bool
    after: str

    def __str__(self) -> str:
        """The case as it stands in its file."""
        mark = "---x" if self.refused else "--->"
        return "\n".join(
            [f"==== {self.title}", f"{archived(self.before)}{mark} " + f"\n{mark} ".join(self.commands), self.after]
        )

    def words(self, command: str) -> list[str]:
        """The arguments of a command, its file among them."""
        words = shlex.split(command)
        if len(words) > 2 and words[-1].endswith(".mind"):
            return words
        return [*words, OWN if OWN in self.before else SHARED]

    def lay_out(self, folder: Path) -> None:
        """Write the files of the case into a folder."""
        folder.mkdir()
        told = f"{self} {SHARED if not self.before else ''} {COLLECT.name if 'power.mind' in self.commands[0] else ''}"
        for path in MINDS:
            if re.search(rf"\b{path.name}\b", told):
                shutil.copy(path, folder)
        for name, text in self.before.items():
            (folder / name).write_bytes(text.encode())

    def with_texts(self, change: Callable[[str], str]) -> "Case":
        """The same case in texts that are changed before."""
        files = self.before or {SHARED: (HERE / "minds" / SHARED).read_text(encoding="utf-8")}
        return replace(self, before={name: change(text) for name, text in files.items()})


def cases(path: Path) -> list[Case]:
    """The cases of a file."""
    _, *blocks = re.split(r"^==== ", path.read_text(encoding="utf-8"), flags=re.M)
    return [_case(path.stem, block) for block in blocks]


def archived(files: Files) -> str:
    """Texts as they stand in a case: that of the main file first, the others below their names."""
    main_first = sorted(files.items(), key=lambda file: (file[0] != OWN, file[0]))
    return "".join(text if name == OWN else f"-- {name} --\n{text}" for name, text in main_first)


def _case(edit: str, block: str) -> Case:
    title, _, rest = block.partition("\n")
    before, *commands = re.split(r"^---[>x] (.*)\n", rest, flags=re.M)
    after = commands[-1].removesuffix("\n") if block.endswith("\n\n") else commands[-1]
    return Case(edit, title, _files(before), tuple(commands[::2]), "\n---x " in f"\n{rest}", after)


def _files(text: str) -> Files:
    main, *others = re.split(r"^-- (\S+) --\n", text, flags=re.M)
    return ({OWN: main} if main else {}) | dict(zip(others[::2], others[1::2], strict=True))
