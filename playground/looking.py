"""What the playground asks the compiler's front end about a text; it runs in the browser, and needs no numpy."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mindlang.compiler.compile import Compiled, compile_source
from mindlang.compiler.diagnostic import MAX_DIAGNOSTICS, Diagnostic, Findings
from mindlang.compiler.drawing import phrase, text_after_name
from mindlang.compiler.format import formatted
from mindlang.compiler.model import Mind, Skill
from mindlang.compiler.parse import parse
from mindlang.compiler.source import Source, Span
from mindlang.lint.lint import lint
from mindlang.lint.rules import all_rules

# Nothing is taught here, and nothing is kept beside the text.
LEFT_OUT = {"untaught-skill", "stale-weights", "taught-elsewhere", "frozen-lesson"}
MAX_SKILLS = 300  # that are drawn
NAME = "playground.mind"


def look(text: str) -> str:
    """All that is to be shown of a text, as JSON: `findings`, the `hierarchy` of what compiles, and `tidy` text."""
    source = Source(NAME, text, Path("/mind"))
    compiled = compile_source(source, source.path)
    findings = [*_found(compiled)][:MAX_DIAGNOSTICS]
    hierarchy = _hierarchy(compiled.mind) if compiled.mind else None
    return json.dumps({"findings": findings, "hierarchy": hierarchy, "tidy": _tidy(source)})


def _found(compiled: Compiled) -> Iterator[dict[str, Any]]:
    codes = [code for code in all_rules() if code not in LEFT_OUT]
    for each in lint(compiled, codes):
        yield _finding(each, compiled.sources[0])


def _finding(of: Diagnostic, source: Source) -> dict[str, Any]:
    span = of.span if of.span and of.span.source is source else Span(source, 0, 0)
    return {
        "from": _units(source.text[: span.start]),
        "to": _units(source.text[: span.end]),
        "line": span.line,
        "severity": of.severity,
        "code": of.code,
        "message": of.message,
        "hint": of.hint,
    }


def _units(text: str) -> int:
    """How long a text is in JavaScript, which counts in UTF-16."""
    return len(text.encode("utf-16-le", "surrogatepass")) // 2


def _tidy(source: Source) -> str | None:
    """The text as `mindc fmt` writes it; None where a line cannot be read."""
    findings = Findings()
    parse(source, findings)
    return None if findings.diagnostics else formatted(source.text)


def _hierarchy(mind: Mind) -> dict[str, Any] | None:
    if len(mind.skills) > MAX_SKILLS:
        return None
    nodes = [
        {"id": f"skill {skill.name}", "name": skill.name, "noun": "skill", "about": _about(skill)}
        for skill in mind.skills
    ]
    for noun, parts in (("sensor", mind.sensors), ("actuator", mind.actuators), ("memory", mind.memories)):
        nodes += [{"id": _part(noun, part.name), "name": part.name, "noun": noun, "about": ""} for part in parts]
    return {"master": f"skill {mind.master}", "nodes": nodes, "edges": [*_edges(mind)]}


def _edges(mind: Mind) -> Iterator[dict[str, str]]:
    for skill in mind.skills:
        here = f"skill {skill.name}"
        for name in skill.reads:
            yield {"from": _part("sensor", name), "to": here, "verb": "reads", "said": ""}
        for edge in skill.edges:
            verb = "influences" if edge.to == "skill" else "drives"
            there = f"skill {edge.target}" if edge.to == "skill" else _part(edge.to, edge.target)
            yield {"from": here, "to": there, "verb": verb, "said": text_after_name(edge.fact).strip()}


def _node(noun: str, name: str, about: str = "") -> dict[str, str]:
    return {"id": _part(noun, name), "name": name, "noun": noun, "about": about}


def _part(noun: str, name: str) -> str:
    """Sensors and memories are read by their names alone."""
    return f"input {name}" if noun in ("sensor", "memory") else f"{noun} {name}"


def _about(skill: Skill) -> str:
    return f"like {skill.like}" if skill.like else phrase(skill.function)
