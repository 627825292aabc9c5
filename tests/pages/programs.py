"""The program that the Python of a page is, what it needs that is not installed here, and what it shows of its output.

print(skill.reads)  # ('object_bearing',)
"""

import ast
import re
from collections.abc import Iterable, Iterator
from importlib.util import find_spec

MARK = "\N{SYMBOL FOR RECORD SEPARATOR}"  # in the output, around what a line prints that shows it
REMARKS = {  # behind a line that prints, which say what it is and not how it looks
    "of each skill in this tick": "an array, of which the order matters and not the bits",
    "the fitness of ten genomes": "an array, of random genomes",
    "None: the same to the bit": "there is no recording of that day here",
    "its SHA-256": "a number that says nothing to a reader",
}


def runnable(parts: Iterable[str]) -> tuple[str, list[str]]:
    """The parts of a page one after the other, without those that import what is not here; and what that is."""
    known = [(part, [name for name in _imported(part) if find_spec(name) is None]) for part in parts]
    missing = sorted({name for _, names in known for name in names})
    return "\n".join(part for part, names in known if not names), missing


def with_marks(program: str) -> tuple[str, list[str]]:
    """A program whose output has a mark before and behind what a line prints that shows it, and what these show."""
    lines, comments = program.splitlines(), []
    for node in ast.walk(ast.parse(program)):
        match node:
            case ast.Expr(value=ast.Call(func=ast.Name(id="print")), lineno=first, end_lineno=last) if first == last:
                line, start, end = lines[first - 1].encode(), node.col_offset, node.end_col_offset
                before, call, behind = line[:start].decode(), line[start:end].decode(), line[end:].decode()
                comment = behind.strip().removeprefix("#").strip()
                if comment and comment not in REMARKS:
                    number = len(comments)
                    comments.append(comment)
                    lines[first - 1] = f'{before}print("{MARK}{number}"); {call}; print("{MARK}"){behind}'
    return "\n".join(lines), comments


def printed_by(output: str, number: int) -> str:
    """What the line has printed that shows something as the one with this number."""
    found = re.findall(rf"^{MARK}{number}\n(.*?)^{MARK}\n", output, re.DOTALL | re.MULTILINE)
    return "".join(found)


def _imported(code: str) -> Iterator[str]:
    """The packages that a part imports, and the extra that one of ours is made for."""
    for node in ast.walk(ast.parse(code)):
        match node:
            case ast.Import(names=names):
                modules = [name.name for name in names]
            case ast.ImportFrom(module=str(module), names=names):
                modules = [module, *(f"{module}.{name.name}" for name in names)]
            case _:
                continue
        yield from (EXTRAS.get(module, module.partition(".")[0]) for module in modules)


EXTRAS = {
    "mindlang.torch": "torch",
    "mindlang.environments": "gymnasium",
    "mindlang.environments.ParallelTask": "pettingzoo",
}
