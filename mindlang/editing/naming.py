"""Checks what an edit would write into a line: a name must be one by the grammar."""

from mindlang.compiler.diagnostic import Findings, a
from mindlang.compiler.parse import parse
from mindlang.compiler.parse.explain import proper
from mindlang.compiler.source import Source
from mindlang.compiler.syntax import PARTS, Contains, Number
from mindlang.editing.project import EditError, facts

EXAMPLES = dict.fromkeys((*PARTS, "thing", "number"), "left_wheel")  # of the other nouns it is GoThere


def refuse_misnamed(noun: str, name: str) -> None:
    """EditError where the grammar takes a text for no name of a noun."""
    if not _is_name(noun, name):
        better = proper("sensor" if noun in ("thing", "number") else noun, name)
        hint = f"Write {better}." if _is_name(noun, better) else f"Write for example {EXAMPLES.get(noun, 'GoThere')}."
        raise EditError(f"{name} cannot be the name of {a(noun)}.", hint)


def refuse_lines(text: str) -> None:
    """EditError where a text would be more than a part of a line."""
    if "\n" in text or "#" in text:
        raise EditError("This is more than a part of a line.", "Add lines and comments with: mindc edit add")


def _is_name(noun: str, name: str) -> bool:
    """Whether a line that gives this name can be read, and gives this and no other."""
    line = f"contains {name} is item" if noun == "thing" else f"{noun} {name} {'in' if noun == 'task' else 'is'} kind"
    findings = Findings()
    if noun == "number":
        read = parse(Source("name", f"number {name} is 1"), findings).settings
        return not findings.diagnostics and [each.name.text for each in read if isinstance(each, Number)] == [name]
    task, *others = parse(Source("name", f"task Task in plain\n{line}"), findings).declarations
    names = [other.header.name for other in others] or [fact.name for fact in facts(task, Contains)]
    return not findings.diagnostics and [known.text for known in names] == [name]
