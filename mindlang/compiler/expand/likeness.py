"""Scenes and tasks that say what another one says, and then more."""

from collections.abc import Callable
from dataclasses import replace

from mindlang.compiler.diagnostic import Findings, Label, a
from mindlang.compiler.expand.replacement import with_more
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
    found: dict[str, Declaration] = {}
    for name in names.of(noun):
        following: str | None = name
        path: dict[str, Declaration] = {}
        while following and following not in found and following not in path:
            path[following] = declaration = names.table[noun][following]
            following = _next(declaration, noun, names, findings)
        if following in path:
            _refuse_circle(noun, [*path.values()][[*path].index(following) :], findings)
        for own, each in reversed(path.items()):
            like = each.header.like
            other = found.get(like.text) if like else None
            found[own] = _like(each, other) if other else replace(each, whole=False) if like else begun(each)
    return {name: found[name] for name in names.of(noun)}


def _next(declaration: Declaration, noun: str, names: Names, findings: Findings) -> str | None:
    """What a declaration is like; None where it is like nothing that there is."""
    like = declaration.header.like
    return like.text if like and names.find(like, (noun,), findings) else None


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
