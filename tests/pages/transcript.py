"""What a page of the documentation has its reader do: the files to write, and the commands with what they print.

    ```mind rover.mind          the whole file
    ```mind rover.mind add      lines that come below what is there
    ```diff rover.mind          lines that take the place of others
    ```python                   a part of the page's program
        $ mindc check rover.mind
        nothing wrong

A command is an indented line that begins with `$ `; what is shown without is only held against the program
(`command_lines`). What it prints stands below it, up to the next command or the end of the block.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

INDENT = "    "
FENCE = re.compile(r"```(?P<language>\w*)(?: (?P<path>[\w./-]+))?(?P<add> add)?$")


@dataclass(frozen=True)
class Write:
    """A block that is a file, or part of one."""

    path: str
    text: str
    adds: bool
    changes: bool

    def onto(self, before: str) -> str:
        """What the file is afterwards."""
        if self.changes:
            return changed(before, self.text)
        return f"{before}\n{self.text}" if self.adds else self.text


@dataclass(frozen=True)
class Command:
    """A command, what the page says that it prints, and between which lines of the page that stands."""

    line: str
    output: str
    first: int
    end: int


@dataclass(frozen=True)
class Program:
    """Lines of Python, which go on where those above them on the page ended."""

    text: str


def changed(before: str, diff: str) -> str:
    """A text in which the lines of a diff without line numbers have been exchanged; they have to be there once."""
    lines = diff.splitlines()
    old = "".join(f"{line[1:]}\n" for line in lines if line[:1] != "+")
    new = "".join(f"{line[1:]}\n" for line in lines if line[:1] != "-")
    found = re.findall(rf"(?=\n{re.escape(old)})", f"\n{before}")
    assert len(found) == 1, f"not there once:\n{old}"
    return f"\n{before}".replace(f"\n{old}", f"\n{new}")[1:]


def steps(page: str) -> Iterator[Write | Command | Program]:
    """What the reader of a page does, in order."""
    lines, at = page.splitlines(), 0
    while at < len(lines):
        fence = FENCE.match(lines[at])
        if lines[at].startswith("```"):
            end = lines.index("```", at + 1)
            text = "".join(f"{line}\n" for line in lines[at + 1 : end])
            if lines[at] == "```python":
                yield Program(text)
            elif fence and fence["path"]:
                yield Write(fence["path"], text, bool(fence["add"]), fence["language"] == "diff")
            at = end + 1
        elif lines[at].startswith(f"{INDENT}$ "):
            command = _command(lines, at)
            yield command
            at = command.end
        else:
            at += 1


def _command(lines: list[str], at: int) -> Command:
    """The command in a line, with the indented lines below it; blank ones at the end are not printed."""
    end = at + 1
    while end < len(lines) and (not lines[end] or lines[end].startswith(INDENT)):
        if lines[end].startswith(f"{INDENT}$ "):
            break
        end += 1
    while not lines[end - 1]:
        end -= 1
    shown = "".join(f"{line[len(INDENT) :]}\n" for line in lines[at + 1 : end])
    return Command(lines[at][len(INDENT) + 2 :], shown, at + 1, end)
