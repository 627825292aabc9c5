"""A hierarchy as text: a tree from the master down, and Graphviz."""

from typing import TYPE_CHECKING, Any

from mindrun.kinds.registry import phrase

from mindlang.compiler.families import said
from mindlang.compiler.model import Mind
from mindlang.compiler.syntax import Drives, Influences

if TYPE_CHECKING:
    from rich.tree import Tree

CHOOSES = " chooses one"  # behind a skill that does


def tree(mind: Mind) -> "Tree":
    """The hierarchy below the master; a skill with several parents is shown in full once, then only named.

    Skills that the master does not reach follow as trees of their own, below the same root.
    """
    from rich.text import Text
    from rich.tree import Tree

    skills = {skill.name: skill for skill in mind.skills}
    influenced = {name for skill in mind.skills for name in skill.subskills}
    tops = [mind.master, *(skill.name for skill in mind.skills if skill.name not in influenced)]
    root = Tree(Text(f"{mind.master} is the master"), guide_style="dim")
    shown: set[str] = set()
    waiting: list[tuple[Any, str, str]] = [(root, name, "") for name in reversed(dict.fromkeys(tops))]
    while waiting:
        above, name, said = waiting.pop()
        if name in shown:
            above.add(Text.assemble((name, "bold"), said, ("  (shown above)", "dim")))
            continue
        shown.add(name)
        skill = skills[name]
        what = (f"like {skill.like}" if skill.like else phrase(skill.function)) + CHOOSES * skill.chooses
        branch = above.add(Text.assemble((name, "bold"), said, (f"  {what}", "cyan")))
        if comment := skill.declaration.comment:
            branch.add(Text(comment, "italic"))
        if skill.reads:
            branch.add(Text(f"reads {', '.join(skill.reads)}"))
        if skill.files:
            branch.add(Text(f"uses {', '.join(skill.files)}"))
        for edge in (edge for edge in skill.edges if edge.to != "skill"):
            branch.add(Text(f"drives {edge.target}{text_after_name(edge.fact)}"))
        for promise in skill.promises:
            branch.add(Text(promise.text))
        below = [(branch, edge.target, text_after_name(edge.fact)) for edge in skill.edges if edge.to == "skill"]
        waiting += reversed(below)
    return root


def dot(mind: Mind) -> str:
    """The hierarchy as a Graphviz digraph: sensors above, skills between, actuators and memories below."""
    lines = ["digraph mind {", "  rankdir=TB", "  node [fontname=sans]"]
    lines += [f"  {_id('input', part.name)} [label={_quoted(part.name)} shape=ellipse]" for part in mind.sensors]
    lines += [f"  {_id('actuator', part.name)} [label={_quoted(part.name)} shape=house]" for part in mind.actuators]
    lines += [f"  {_id('input', part.name)} [label={_quoted(part.name)} shape=cylinder]" for part in mind.memories]
    for skill in mind.skills:
        bold = " style=bold" if skill.name == mind.master else ""
        label = _quoted(skill.name + CHOOSES * skill.chooses)
        lines.append(f"  {_id('skill', skill.name)} [label={label} shape=box{bold}]")
        if skill.like:
            owner = _id("skill", skill.like)
            lines.append(f"  {owner} -> {_id('skill', skill.name)} [style=dashed label=like constraint=false dir=none]")
    for skill in mind.skills:
        here = _id("skill", skill.name)
        lines += [f"  {_id('input', name)} -> {here} [style=dotted]" for name in skill.reads]
        for edge in skill.edges:
            said = text_after_name(edge.fact).removeprefix(" at ").strip()
            label = f" [label={_quoted(said)}]" if said else ""
            lines.append(f"  {here} -> {_id('input' if edge.to == 'memory' else edge.to, edge.target)}{label}")
    return "\n".join([*lines, "}"])


def _id(noun: str, name: str) -> str:
    return _quoted(f"{noun} {name}")


def _quoted(text: str) -> str:
    return f'"{text}"'


def text_after_name(fact: Drives | Influences) -> str:
    """The text of a line after the name of its target, as written; of a member of a family with its own names."""
    return said(fact)[fact.name.span.start - fact.span.start + len(said(fact.name)) :]
