"""Offers of which completions are made: words, declared names, kinds and their arguments, values."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path

from mindrun.graph.graph import VARIED_NOUNS
from mindrun.kinds.registry import Argument, arguments, kinds
from mindrun.numbers.quantity import Quantity

from mindlang.compiler.names import declared_things
from mindlang.compiler.source import comment_of
from mindlang.compiler.syntax import Declaration, Draws, Reads, Sends, Varies, of_form
from mindlang.explaining.article import article_card, parameter_line
from mindlang.explaining.kinds import kind_article, language_words, meaning, parameter
from mindlang.files import files_beside, readable_text
from mindlang.server.workspace import MindView

_FUNCTION = re.compile(r"^def ([a-z]\w*)\(", re.MULTILINE)
MAX_MODULES = 100  # modules that are read


@dataclass(frozen=True, slots=True)
class Offer:
    """Something that may be written: of a sort (a noun, "word", "kind", "key", "unit"), with what there is to say."""

    label: str
    sort: str
    detail: str = ""
    text: str = ""


def words(*labels: str) -> list[Offer]:
    return [Offer(label, "word", text=_summary(label)) for label in labels]


def units(*labels: str) -> list[Offer]:
    return [Offer(label, "unit", _summary(label)) for label in labels]


def _summary(label: str) -> str:
    article = language_words().get(label) or language_words().get(f"is {label}")
    return article.summary if article else ""


def names(view: MindView, *nouns: str) -> list[Offer]:
    said = [(name, noun, each.header.span) for noun in nouns for name, each in view.names.declarations(noun)]
    said += [(name, "number", each.span) for name, each in view.names.numbers.items() if "number" in nouns]
    worlds = (each for noun in ("task", "scene") for _, each in view.names.declarations(noun) if "draw" in nouns)
    said += [(fact.name.text, "draw", fact.span) for each in worlds for fact in of_form(each.facts, Draws)]
    return [Offer(name, noun, span.text.strip(), comment_of(span)) for name, noun, span in said]


def kinds_of(noun: str) -> list[Offer]:
    return [Offer(name, "kind", noun, article_card(kind_article(noun, name))) for name in sorted(kinds(noun))]


def said_of(view: MindView, skill: str, form: type[Reads | Sends]) -> set[str]:
    """The names behind a verb of a skill, by its own lines and by those of the skills that it is like."""
    found: set[str] = set()
    replaced: set[str] = set()
    declared = dict(view.names.declarations("skill"))
    while (declaration := declared.pop(skill, None)) is not None:
        facts = of_form(declaration.facts, form)
        found |= {fact.name.text for fact in facts} - replaced
        replaced |= {fact.stands_for.text for fact in facts if fact.stands_for}
        skill = declaration.header.like.text if declaration.header.like else ""
    return found


def things(view: MindView, task: Declaration | None, about: Iterable[str]) -> list[Offer]:
    """The things of a task, or of all, of which a kind can be."""
    fit = set(about)
    worlds = [each for noun in ("task", "scene") for _, each in view.whole.declarations(noun)]
    own = [each for each in worlds if task and each.header.name is task.header.name]
    found: dict[str, set[str]] = {}
    for declaration in own or ([task] if task else worlds):
        for name, kinds_ in declared_things(declaration).items():
            found.setdefault(name, set()).update(kinds_)
    return [Offer(name, "thing", " ".join(sorted(is_))) for name, is_ in found.items() if is_ & fit]


def places(view: MindView) -> list[Offer]:
    """The memories that are places, of which a bearing can be."""
    return [Offer(name, "memory") for name in view.names.of("memory") if view.names.is_place(name)]


def functions(folder: Path) -> list[str]:
    """`module.function` for each function of the modules in a folder that has a name of the language."""
    modules = [path for path in files_beside(folder, ".py") if "a" <= path.name[0] <= "z"][:MAX_MODULES]
    return [f"{path.stem}.{name}" for path in modules for name in _FUNCTION.findall(readable_text(path))]


def keys(parameters: Iterable[Argument]) -> list[Offer]:
    """Arguments that may be said, those first that must be."""
    first = sorted(parameters, key=lambda each: not each.required)
    return [Offer(each.key, "key", meaning(each), parameter_line(parameter(each))) for each in first]


def units_of(parameter: Argument) -> list[Offer]:
    return units(*filter(None, parameter.type.units)) if isinstance(parameter.type, Quantity) else []


def varying_parts(view: MindView, task: Declaration | None) -> Iterator[tuple[Offer, list[Argument]]]:
    """Each part of the robot and thing of a task, with its arguments that can differ from run to run."""
    for noun in VARIED_NOUNS:
        for part in names(view, noun):
            phrase = view.names.table[noun][part.label].header.phrase
            yield part, _varying(noun, phrase.kind.text if phrase else "")
    for thing in things(view, task, kinds("content")):
        yield thing, _varying("content", *thing.detail.split())


def varied(view: MindView, task: Declaration | None, fact: Varies) -> Argument | None:
    """The argument that a line varies, of the part or the thing that it names."""
    its = (varying for part, varying in varying_parts(view, task) if part.label == fact.of.text)
    return next((each for varying in its for each in varying if each.key == fact.argument.text), None)


def _varying(noun: str, *of: str) -> list[Argument]:
    classes = [cls for name, cls in kinds(noun).items() if name in of]
    return [each for cls in classes for each in arguments(cls) if each.field in cls.varying]
