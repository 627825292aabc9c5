"""Scenes and tasks that say what another one says, and then more."""

from collections.abc import Callable

from msgspec.structs import replace
from networkx import DiGraph

from mindlang.compiler.diagnostic import Findings, Label, a
from mindlang.compiler.expand.replacement import with_more
from mindlang.compiler.hierarchy import circles, ends_first
from mindlang.compiler.names import Names
from mindlang.compiler.syntax import Declaration

Declarations = dict[str, Declaration]


UNLIKE_NOUNS = ("body", "curriculum")  # whose declarations are like nothing


def refuse_unlike(names: Names, findings: Findings) -> None:
    """Report what is like another, and cannot be."""
    for noun in UNLIKE_NOUNS:
        for _, declaration in names.declarations(noun):
            if like := declaration.header.like:
                hint = "Say what it is itself; skills, scenes and tasks can be like others."
                findings.error("cannot-be-like", like.span, f"{a(noun).capitalize()} is like no other.", hint)


def scenes(names: Names, findings: Findings) -> Declarations:
    """Every scene with what those that it is like say before it."""
    return _followed("scene", names, lambda scene: scene, findings)


def tasks(names: Names, known_scenes: Declarations, findings: Findings) -> Declarations:
    """Every task with what its scene, and those that it is like, say before it."""

    def in_scene(task: Declaration) -> Declaration:
        scene = task.header.inside
        if scene is None:
            return task
        if names.find(scene, ("scene",), findings):
            return _like(task, known_scenes[scene.text])
        return replace(task, whole=False)

    return _followed("task", names, in_scene, findings)


def _followed(noun: str, names: Names, begun: Callable[[Declaration], Declaration], findings: Findings) -> Declarations:
    """The declarations of a noun, each with what it is like; one that is like nothing is what `begun` makes of it."""
    declared = dict(names.declarations(noun))
    graph = DiGraph()
    graph.add_nodes_from(declared)
    for name, declaration in declared.items():
        like = declaration.header.like
        if like and names.find(like, (noun,), findings):
            graph.add_edge(name, like.text)
    for circle in circles(graph):
        _refuse_circle(noun, [declared[name] for name in circle], findings)
    found: dict[str, Declaration] = {}
    for name in ends_first(graph):
        own, other = declared[name], next(iter(graph[name]), None)
        if other:
            found[name] = _like(own, found[other])
        elif not own.header.like:
            found[name] = begun(own)
    return {name: found.get(name) or replace(each, whole=False) for name, each in declared.items()}


def _like(own: Declaration, other: Declaration) -> Declaration:
    """A declaration that says what another says, and then its own."""
    header = replace(own.header, phrase=other.header.phrase)
    return replace(own, header=header, facts=with_more(other.facts, own.facts), whole=own.whole and other.whole)


def _refuse_circle(noun: str, path: list[Declaration], findings: Findings) -> None:
    first, *others = (declaration.header for declaration in path)
    names = " → ".join(declaration.header.name.text for declaration in (*path, path[0]))
    labels = [Label(header.span, "through this one") for header in others]
    message = f"{a(noun).capitalize()} is like itself: {names}."
    findings.error("like-circle", first.span, message, "Let one of them say what it is itself.", *labels)
