"""Explanations of what stands under the mouse, as Markdown: a name, a kind, an argument, a word."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mindrun.errors import MindError
from mindrun.kinds.registry import arguments, kinds
from mindrun.kinds.variation import VARIED_NOUNS
from networkx import DiGraph, single_target_shortest_path

from mindlang.compiler.drawing import text_after_name
from mindlang.compiler.resolve.curricula import USING
from mindlang.compiler.source import Span, comment_of
from mindlang.compiler.syntax import (
    NOUNS,
    Argument,
    Contains,
    Declaration,
    Drives,
    Expression,
    File,
    Header,
    Influences,
    Name,
    Phrase,
    Reads,
    Teaches,
    Varies,
)
from mindlang.explaining import markdown
from mindlang.explaining.kinds import kind_article
from mindlang.explaining.parameters import parameter
from mindlang.explaining.words import language_words
from mindlang.lock import lock_sources
from mindlang.lock.report import Row, made_by, rows
from mindlang.lock.status import Trained
from mindlang.server.workspace import MindView, declaration_at, path_to

_WORD = re.compile(r"[A-Za-z_][\w.]*(?:\+[A-Z]\w*)*|%")


@dataclass(frozen=True, slots=True)
class Hover:
    """An explanation in Markdown, and what it is about."""

    text: str
    span: Span


def hover(view: MindView, path: Path, offset: int) -> Hover | None:
    """The explanation of what stands at an offset."""
    file = view.file(path)
    if file is None:
        return None
    if mention := view.mention_at(path, offset):
        text = card(view, mention.noun, mention.name.text)
        return Hover(text, mention.name.span) if text else None
    return _kind(view, file, offset) or _word(view, file, offset)


def noun_of(above: object) -> str:
    """The noun of the kind that a phrase names, told by what is around it."""
    match above:
        case Header(noun=noun):
            return noun.text
        case Contains():
            return "content"
        case Expression():
            return "measure"
    return "event"


def _kind(view: MindView, file: File, offset: int) -> Hover | None:
    """A kind, or an argument of one; those of a lesson are of its own learner or the curriculum's."""
    if varies := next((node for node in path_to(file, offset) if isinstance(node, Varies)), None):
        return _varied(view, varies) if varies.argument.span.start <= offset <= varies.argument.span.end else None
    match _owned(path_to(file, offset)):
        case above, Phrase(kind=kind), Name() as name if name is kind:
            return _kind_itself(noun_of(above), kind)
        case above, Phrase() as phrase, Argument() as argument:
            return _argument(noun_of(above), phrase.kind.text, argument)
        case _, Teaches() as lesson, Argument() as argument if declaration := declaration_at(file, offset):
            return _of_lesson(lesson, declaration.header.phrase, argument, offset)
    return None


def _varied(view: MindView, fact: Varies) -> Hover | None:
    """The argument that varies, of the part of the robot or the thing that has it."""
    noun = view.names.noun_of(fact.of.text, VARIED_NOUNS)
    phrase = view.names.table[noun][fact.of.text].header.phrase if noun else None
    classes = [cls for name, cls in kinds(noun or "content").items() if not phrase or name == phrase.kind.text]
    known = [each for cls in classes for each in arguments(cls) if each.field in cls.varying]
    found = next((markdown.parameter_line(parameter(each)) for each in known if each.field == fact.argument.text), None)
    return Hover(found, fact.argument.span) if found else None


def _of_lesson(lesson: Teaches, of_all: Phrase | None, argument: Argument, offset: int) -> Hover | None:
    """The kind after `using`, or an argument of the lesson's learner."""
    own = [said.value for said in lesson.arguments if said.key.text == USING]
    learner = own[0] if own else of_all and of_all.kind
    if not isinstance(learner, Name):
        return None
    if argument.value is learner and learner.span.start <= offset:
        return _kind_itself("curriculum", learner)
    return _argument("curriculum", learner.text, argument)


def _kind_itself(noun: str, kind: Name) -> Hover | None:
    cls = kinds(noun).get(kind.text)
    return Hover(markdown.card(kind_article(noun, kind.text)), kind.span) if cls else None


def _owned(path: list[Any]) -> tuple[Any, ...]:
    """The last phrase or lesson on the way to an offset, between what is around it and what is in it."""
    places = [place for place, node in enumerate(path) if isinstance(node, Phrase | Teaches)]
    return tuple(path[places[-1] - 1 : places[-1] + 2]) if places else ()


def _argument(noun: str, kind: str, argument: Argument) -> Hover | None:
    article = kind_article(noun, kind) if kind in kinds(noun) else None
    said = next((each for each in article.parameters if each.key == argument.key.text), None) if article else None
    return Hover(markdown.parameter_card(said, article), argument.span) if article and said else None


def _word(view: MindView, file: File, offset: int) -> Hover | None:
    """A word of the language or, in a line that cannot be read, a name that is declared."""
    source = file.source
    start = source.text.rfind("\n", 0, offset) + 1
    line = source.text[start:].partition("\n")[0].partition("#")[0]
    found = next((word for word in _WORD.finditer(line) if word.start() <= offset - start <= word.end()), None)
    if found is None:
        return None
    words = language_words()
    joints = re.finditer(rf"\b(?:{'|'.join(word for word in words if ' ' in word)})\b", line)
    for joint in (each for each in joints if each.start() <= offset - start <= each.end()):
        return Hover(markdown.card(words[joint[0]]), Span(source, start + joint.start(), start + joint.end()))
    span = Span(source, start + found.start(), start + found.end())
    if noun := view.names.noun_of(found[0], NOUNS):
        return Hover(card(view, noun, found[0]), span)
    return Hover(markdown.card(words[found[0]]), span) if found[0] in words else None


def card(view: MindView, noun: str, name: str) -> str:
    """Everything about a name; nothing where another declaration has it already."""
    if noun == "thing":
        return _thing(view, name)
    if noun == "number" and name in view.names.numbers:
        return _number(view, name)
    declaration = view.names.table.get(noun, {}).get(name)
    if declaration is None:
        return ""
    parts = [f"```mind\n{declaration.header.span.text.strip()}\n```", declaration.comment]
    match noun:
        case "skill":
            parts += _skill(view, name, declaration)
        case "task" | "scene":
            parts += _world(view, noun, name)
        case "sensor" | "memory" | "actuator":
            parts += _part(view, noun, name)
    parts.append(_of_kind(noun, declaration))
    return "\n\n".join(filter(None, parts))


def paths_to(view: MindView, skill: str) -> list[str]:
    """The ways on which influence comes down to a skill, the shortest one from each top."""
    influences = DiGraph()
    for name, declaration in view.names.declarations("skill"):
        influences.add_node(name)
        facts = (fact for fact in declaration.facts if isinstance(fact, Influences))
        influences.add_edges_from((name, fact.name.text) for fact in facts)
    ways = single_target_shortest_path(influences, skill).items()
    return [" → ".join(way) for top, way in ways if top != skill and not influences.pred[top]]


def _skill(view: MindView, name: str, declaration: Declaration) -> Iterator[str]:
    lines = []
    for verb, form in (("reads", Reads), ("drives", Drives), ("influences", Influences)):
        if said := [_edge(view, fact) for fact in declaration.facts if isinstance(fact, form)]:
            lines.append(f"- {verb} {', '.join(said)}")
    if by := _users(view, name, "skill", (Influences,)):
        lines.append(f"- influenced by {', '.join(by)}")
    if view.compiled.mind and view.compiled.mind.master == name:
        lines.append("- the master")
    lines += [f"- place: {path}" for path in paths_to(view, name)]
    yield "\n".join(lines)
    yield "\n".join(f"- `{lesson}`" for lesson in _lessons(view, "skill", name))
    yield _weights(view, name)


def _edge(view: MindView, fact: Reads | Drives | Influences) -> str:
    width = _width(view, fact.name.text) if isinstance(fact, Reads) else 1
    said = "" if isinstance(fact, Reads) else text_after_name(fact)
    return f"{fact.name.text} ({width})" if width > 1 else f"{fact.name.text}{said}"


def _width(view: MindView, sensor: str) -> int:
    graph = view.compiled.graph
    return next((known.width for known in graph.sensors if known.name == sensor), 1) if graph else 1


def _weights(view: MindView, skill: str) -> str:
    """How a skill stands to its weights, as `mindc status` says it."""
    if view.compiled.graph is None:
        return ""
    try:
        found = rows(view.compiled.graph, lock_sources(view.compiled.sources))
        row = next((row for row in found if row.skill == skill), None)
    except MindError as error:
        return f"Weights: {error}"
    return _row(row) if row else ""


def _row(row: Row) -> str:
    words = [row.word] + ["frozen"] * row.is_frozen
    made = []
    if isinstance(row.status, Trained):
        how = f"those of {row.like}" if row.like else made_by(row.status.entry.taught)
        made.append(f"{row.status.entry.weights[:8]}…, {how}")
    return "\n".join([f"Weights: **{', '.join(words)}**", *(f"- {line}" for line in [*made, *row.remarks])])


def _world(view: MindView, noun: str, name: str) -> Iterator[str]:
    """All that a task or scene says, that of its scene and of what it is like, too."""
    declaration = view.whole.table[noun][name]
    yield "\n".join(f"- {fact.span.text.strip()}" for fact in declaration.facts)
    if noun == "task":
        yield "\n".join(f"- `{lesson}`" for lesson in _lessons(view, "task", name))


def _number(view: MindView, name: str) -> str:
    """A number, and what its comment says."""
    number = view.names.numbers[name]
    return f"```mind\n{number.span.text.strip()}\n```\n\n{comment_of(number.span)}".strip()


def _part(view: MindView, noun: str, name: str) -> Iterator[str]:
    lines = []
    if noun == "sensor" and (width := _width(view, name)) > 1:
        lines.append(f"- {width} readings")
    if noun != "actuator" and (by := _users(view, name, noun, (Reads,))):
        lines.append(f"- read by {', '.join(by)}")
    if noun != "sensor" and (by := _users(view, name, noun, (Drives,))):
        lines.append(f"- driven by {', '.join(by)}")
    if others := _others(view, noun, name):
        lines.append(f"- stands in {', '.join(others)}")
    yield "\n".join(lines)


def _others(view: MindView, noun: str, name: str) -> list[str]:
    """What else names a part: other sensors, and tasks in their rewards."""
    found = (m for m in view.mentions if (m.noun, m.name.text) == (noun, name) and m.by and not m.is_own)
    headers = (m.by.header for m in found if m.by)
    others = (f"{h.noun.text} {h.name.text}" for h in headers if h.noun.text != "skill")
    return list(dict.fromkeys(others))


def _users(view: MindView, name: str, noun: str, forms: tuple[type[Reads | Drives | Influences], ...]) -> list[str]:
    """The skills that have a fact of one of these verbs about a name."""
    return [
        skill
        for skill, declaration in view.names.declarations("skill")
        if any(isinstance(fact, forms) and fact.name.text == name for fact in declaration.facts)
    ]


def _lessons(view: MindView, part: str, name: str) -> Iterator[str]:
    """The lessons that teach a skill, or are on a task."""
    for curriculum, declaration in view.names.declarations("curriculum"):
        for fact in declaration.facts:
            if isinstance(fact, Teaches) and getattr(fact, part).text == name:
                yield f"{curriculum}: {fact.span.text.strip()}"


def _thing(view: MindView, name: str) -> str:
    """Where a thing is."""
    lines = []
    for noun in ("scene", "task"):
        for world, declaration in view.names.declarations(noun):
            for fact in declaration.facts:
                if isinstance(fact, Contains) and fact.name.text == name:
                    lines.append(f"- in {world}: `{fact.phrase.span.text}`")
    return "\n".join([f"**{name}**, a thing", "", *lines])


def _of_kind(noun: str, declaration: Declaration) -> str:
    phrase = declaration.header.phrase
    is_known = phrase is not None and phrase.kind.text in kinds(noun)
    return f"---\n{markdown.card(kind_article(noun, phrase.kind.text))}" if phrase and is_known else ""
