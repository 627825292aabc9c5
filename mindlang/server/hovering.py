"""What stands under the mouse, explained."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mindrun.kinds.registry import arguments, kinds
from mindrun.kinds.variation import VARIED_NOUNS

from mindlang.compiler.resolve.curricula import USING
from mindlang.compiler.source import Span
from mindlang.compiler.syntax import NOUNS, Argument, Contains, Expression, File, Header, Name, Phrase, Teaches, Varies
from mindlang.explaining import markdown
from mindlang.explaining.kinds import kind_article
from mindlang.explaining.parameters import parameter
from mindlang.explaining.words import language_words
from mindlang.server.cards import card
from mindlang.server.tree import path_to
from mindlang.server.view import MindView, declaration_at

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
