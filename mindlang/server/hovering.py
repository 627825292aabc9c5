"""Explanations of what stands under the mouse, as Markdown: a name, a kind, an argument, a word."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from mindrun.errors import MindError
from mindrun.kinds.registry import kinds
from networkx import DiGraph, single_target_shortest_path

from mindlang.compiler import syntax
from mindlang.compiler.drawing import text_after_name
from mindlang.compiler.resolve.curricula import USING
from mindlang.compiler.source import Span, comment_of
from mindlang.explaining.article import article_card, parameter_line
from mindlang.explaining.kinds import kind_article, language_words, parameter
from mindlang.lock import lock_sources
from mindlang.lock.report import made_by, rows
from mindlang.lock.status import Trained
from mindlang.server.offers import varied
from mindlang.server.places import declaration_at, noun_of_kind, path_to, said_argument
from mindlang.server.workspace import MindView

F = TypeVar("F", bound=syntax.Fact)
_WORD = r"[A-Za-z_][\w.]*(?:\+[A-Z]\w*)*|%"


@dataclass(frozen=True, slots=True)
class Hover:
    """An explanation in Markdown, and what it is about."""

    text: str
    span: Span


def hover(view: MindView, path: Path, offset: int) -> Hover | None:
    file = view.file(path)
    if file is None:
        return None
    if mention := view.mention_at(path, offset):
        text = card(view, mention.noun, mention.name.text)
        return Hover(text, mention.name.span) if text else None
    return _kind(view, file, offset) or _word(view, file, offset)


def _kind(view: MindView, file: syntax.File, offset: int) -> Hover | None:
    """A kind, or an argument of one; those of a lesson are of its own learner or the curriculum's."""
    path = path_to((*file.settings, *file.declarations), offset)
    if varies := next((node for node in path if isinstance(node, syntax.Varies)), None):
        argument = varied(view, declaration_at(file, offset), varies)
        if argument is None or not varies.argument.span.start <= offset <= varies.argument.span.end:
            return None
        return Hover(parameter_line(parameter(argument)), varies.argument.span)
    match path:
        case [*_, above, syntax.Phrase(kind=kind), syntax.Name() as name] if name is kind:
            return _kind_itself(noun_of_kind(above), kind)
    said = said_argument(path, declaration_at(file, offset))
    if said is None:
        return None
    value = said.argument.value
    if isinstance(value, syntax.Name) and said.argument.key.text == USING and value.span.start <= offset:
        return _kind_itself("curriculum", value)
    if said.meaning is None:
        return None
    article = kind_article(said.noun, said.kind)
    known = next(each for each in article.parameters if each.key == said.meaning.key)
    parts = [parameter_line(known), f"of **{article.name}**: {article.summary}", *article.paragraphs]
    return Hover("\n\n".join(parts), said.argument.span)


def _kind_itself(noun: str, kind: syntax.Name) -> Hover | None:
    return Hover(article_card(kind_article(noun, kind.text)), kind.span) if kind.text in kinds(noun) else None


def _word(view: MindView, file: syntax.File, offset: int) -> Hover | None:
    """A word of the language or, in a line that cannot be read, a name that is declared."""
    start = file.source.text.rfind("\n", 0, offset) + 1
    line = file.source.text[start:].partition("\n")[0].partition("#")[0]
    words = language_words()

    def here(pattern: str) -> tuple[str, Span] | None:
        found = (word for word in re.finditer(pattern, line) if word.start() <= offset - start <= word.end())
        return next(((word[0], Span(file.source, start + word.start(), start + word.end())) for word in found), None)

    if (found := here(_WORD)) is None:
        return None
    if joint := here(rf"\b(?:{'|'.join(word for word in words if ' ' in word)})\b"):
        return Hover(article_card(words[joint[0]]), joint[1])
    word, span = found
    if noun := view.names.noun_of(word, syntax.NOUNS):
        return Hover(card(view, noun, word), span)
    return Hover(article_card(words[word]), span) if word in words else None


def card(view: MindView, noun: str, name: str) -> str:
    """The card of a name, with everything about it; "" where no declaration of the noun has it."""
    if noun == "thing":
        said = _saying(view, syntax.Contains, "scene", "task")
        lines = [f"- in {world}: `{fact.phrase.span.text}`" for world, fact in said if fact.name.text == name]
        return "\n".join([f"**{name}**, a thing", "", *lines])
    if noun == "draw":
        drawn = (fact for _, fact in _saying(view, syntax.Draws, "scene", "task") if fact.name.text == name)
        return "\n\n".join(f"```mind\n{fact.span.text.strip()}\n```" for fact in drawn)
    if noun == "number" and name in view.names.numbers:
        number = view.names.numbers[name]
        return f"```mind\n{number.span.text.strip()}\n```\n\n{comment_of(number.span)}".strip()
    declaration = view.names.table.get(noun, {}).get(name)
    if declaration is None:
        return ""
    header = declaration.header
    parts = [f"```mind\n{header.span.text.strip()}\n```", declaration.comment]
    match noun:
        case "skill":
            parts += [_skill(view, name, declaration), _lessons(view, "skill", name), _weights(view, name)]
        case "task" | "scene":  # all that it says, that of its scene and of what it is like, too
            whole = view.whole.table[noun][name]
            parts.append("\n".join(f"- {fact.span.text.strip()}" for fact in whole.facts))
            parts.append(_lessons(view, "task", name) if noun == "task" else "")
        case "sensor" | "memory" | "actuator":
            parts.append(_part(view, noun, name))
    if header.phrase and header.phrase.kind.text in kinds(noun):
        parts.append(f"---\n{article_card(kind_article(noun, header.phrase.kind.text))}")
    return "\n\n".join(filter(None, parts))


def _skill(view: MindView, name: str, declaration: syntax.Declaration) -> str:
    lines = []
    for verb, form in (("reads", syntax.Reads), ("drives", syntax.Drives), ("influences", syntax.Influences)):
        if said := [_edge(view, fact) for fact in declaration.facts if isinstance(fact, form)]:
            lines.append(f"- {verb} {', '.join(said)}")
    if by := _users(view, name, syntax.Influences):
        lines.append(f"- influenced by {', '.join(by)}")
    if view.compiled.mind and view.compiled.mind.master == name:
        lines.append("- the master")
    influences = DiGraph((above, fact.name.text) for above, fact in _saying(view, syntax.Influences, "skill"))
    influences.add_node(name)
    ways = single_target_shortest_path(influences, name).items()  # the shortest one from each skill above
    paths = [" → ".join(way) for top, way in ways if top != name and not influences.pred[top]]
    return "\n".join([*lines, *(f"- place: {path}" for path in paths)])


def _edge(view: MindView, fact: Any) -> str:
    if not isinstance(fact, syntax.Reads):
        return f"{fact.name.text}{text_after_name(fact)}"
    width = _width(view, fact.name.text)
    return f"{fact.name.text} ({width})" if width > 1 else fact.name.text


def _width(view: MindView, sensor: str) -> int:
    graph = view.compiled.graph
    return next((known.width for known in graph.sensors if known.name == sensor), 1) if graph else 1


def _weights(view: MindView, skill: str) -> str:
    """How a skill stands to its weights, as `mindc status` says it."""
    if view.compiled.graph is None:
        return ""
    try:
        found = rows(view.compiled.graph, lock_sources(view.compiled.sources))
    except MindError as error:
        return f"Weights: {error}"
    row = next((row for row in found if row.skill == skill), None)
    if row is None:
        return ""
    lines = [f"Weights: **{', '.join([row.word, *['frozen'] * row.is_frozen])}**"]
    if isinstance(row.status, Trained):
        how = f"those of {row.like}" if row.like else made_by(row.status.entry.taught)
        lines.append(f"- {row.status.entry.weights[:8]}…, {how}")
    return "\n".join([*lines, *(f"- {remark}" for remark in row.remarks)])


def _part(view: MindView, noun: str, name: str) -> str:
    lines = []
    if noun == "sensor" and (width := _width(view, name)) > 1:
        lines.append(f"- {width} readings")
    if noun != "actuator" and (by := _users(view, name, syntax.Reads)):
        lines.append(f"- read by {', '.join(by)}")
    if noun != "sensor" and (by := _users(view, name, syntax.Drives)):
        lines.append(f"- driven by {', '.join(by)}")
    mentions = (m for m in view.mentions if (m.noun, m.name.text) == (noun, name) and not m.is_own)
    headers = (m.by.header for m in mentions if m.by)  # other sensors, and tasks in their rewards
    others = dict.fromkeys(f"{h.noun.text} {h.name.text}" for h in headers if h.noun.text != "skill")
    return "\n".join([*lines, *([f"- stands in {', '.join(others)}"] if others else [])])


def _saying(view: MindView, form: type[F], *nouns: str) -> Iterator[tuple[str, F]]:
    """Each fact of a verb in the declarations of some nouns, with their names."""
    for noun in nouns:
        for name, declaration in view.names.declarations(noun):
            yield from ((name, fact) for fact in syntax.of_form(declaration.facts, form))


def _users(view: MindView, name: str, form: type[syntax.Reads | syntax.Drives | syntax.Influences]) -> list[str]:
    """The skills that have a fact of this verb about a name."""
    return list(dict.fromkeys(skill for skill, fact in _saying(view, form, "skill") if fact.name.text == name))


def _lessons(view: MindView, part: str, name: str) -> str:
    """The lessons that teach a skill, or are on a task."""
    said = _saying(view, syntax.Teaches, "curriculum")
    its = ((of, fact.span.text.strip()) for of, fact in said if getattr(fact, part).text == name)
    return "\n".join(f"- `{curriculum}: {line}`" for curriculum, line in its)
