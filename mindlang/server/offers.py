"""Offers of which completions are made: words, declared names, kinds and their arguments, values."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mindrun.graph.graph import VARIED_NOUNS
from mindrun.kinds.registry import Argument, arguments, kinds, named_arguments
from mindrun.numbers.quantity import Quantity, Reference

from mindlang.compiler.names import declared_things
from mindlang.compiler.references import READABLE_NOUNS
from mindlang.compiler.resolve.kinds import about
from mindlang.compiler.source import comment_of
from mindlang.compiler.syntax import Declaration, Reads
from mindlang.explaining import markdown
from mindlang.explaining.kinds import kind_article
from mindlang.explaining.parameters import meaning, parameter
from mindlang.explaining.words import language_words
from mindlang.files import files_beside, readable_text
from mindlang.server.workspace import MindView

NUMBER = "0123456789"
_FUNCTION = re.compile(r"^def ([a-z]\w*)\(", re.MULTILINE)
MAX_MODULES = 100  # modules that are read
COMPARISONS = ("<", ">", "<=", ">=")
JOINTS = ("when", "and", "or", "at", "otherwise")  # behind which an expression begins
OPENINGS = ("+", "-", "*", "/", "(", *COMPARISONS, *JOINTS)  # behind which a value stands
SEVERAL = ("least", "greatest")  # of


@dataclass(frozen=True, slots=True)
class Offer:
    """Something that may be written: of a sort (a noun, "word", "kind", "key", "unit"), with what there is to say."""

    label: str
    sort: str
    detail: str = ""
    text: str = ""


def words(*labels: str) -> list[Offer]:
    """Words of the language."""
    return [Offer(label, "word", text=_summary(label)) for label in labels]


def units(*labels: str) -> list[Offer]:
    """Units of a number."""
    return [Offer(label, "unit", _summary(label)) for label in labels]


def _summary(label: str) -> str:
    article = language_words().get(label)
    return article.summary if article else ""


def names(view: MindView, *nouns: str, but: Iterable[str] = ()) -> list[Offer]:
    """Offers of the names that are declared with one of these nouns, without those in `but`."""
    left = set(but)
    return [
        Offer(name, noun, declaration.header.span.text.strip(), declaration.comment)
        for noun in nouns
        for name, declaration in view.names.declarations(noun)
        if name not in left
    ]


def numbers(view: MindView) -> list[Offer]:
    """The names of numbers."""
    declared = view.names.numbers.items()
    return [Offer(name, "number", number.span.text.strip(), comment_of(number.span)) for name, number in declared]


def kinds_of(noun: str) -> list[Offer]:
    """The kinds of a noun with their documentation."""
    return [Offer(name, "kind", noun, markdown.article_card(kind_article(noun, name))) for name in sorted(kinds(noun))]


def inputs_of(view: MindView, skill: str) -> set[str]:
    """The names that a skill reads, by its own lines and by those of the skills that it is like."""
    found: set[str] = set()
    replaced: set[str] = set()
    declared = dict(view.names.declarations("skill"))
    while (declaration := declared.pop(skill, None)) is not None:
        reads = [fact for fact in declaration.facts if isinstance(fact, Reads)]
        found |= {fact.name.text for fact in reads} - replaced
        replaced |= {fact.stands_for.text for fact in reads if fact.stands_for}
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


def functions(folder: Path) -> list[str]:
    """`module.function` for each function of the modules in a folder that has a name of the language."""
    modules = [path for path in files_beside(folder, ".py") if "a" <= path.name[0] <= "z"][:MAX_MODULES]
    return [f"{path.stem}.{name}" for path in modules for name in _FUNCTION.findall(readable_text(path))]


@dataclass(frozen=True, slots=True)
class WrittenArguments:
    """The arguments after a kind: the one that was begun last, its values, and those that have not been said."""

    current: Argument | None
    values: tuple[str, ...]
    left: tuple[Argument, ...]

    @property
    def awaits_name(self) -> bool:
        """True if a name must come next."""
        return self.current is not None and self.current.shape == "name" and not self.values

    @property
    def awaits_number(self) -> bool:
        """True if a number must come next."""
        is_open = not self.values or self.values[-1] in ("to", "by", "-", "+")
        return self.current is not None and self.current.shape != "name" and is_open


def written_arguments(cls: type[Any], rest: Iterable[str]) -> WrittenArguments:
    """The arguments in the words after a kind."""
    left = {parameter.key: parameter for parameter in arguments(cls)}
    parameters, current, values = dict(left), None, list[str]()
    for word in rest:
        if word in parameters and not (current and current.shape == "name" and not values):
            current, values = parameters[word], []
            left.pop(word, None)
        else:
            values.append(word)
    named = {each.key for each in named_arguments(cls)}
    return WrittenArguments(current, tuple(values), tuple(each for key, each in left.items() if key in named))


def arguments_of(view: MindView, noun: str, kind: str, rest: Iterable[str], task: Declaration | None) -> list[Offer]:
    """Offers after a kind and some of its arguments."""
    cls = kinds(noun).get(kind)
    if cls is None:
        return []
    rest = [*rest]
    if kind in {each.key for each in arguments(cls)} and not any(word[0] in NUMBER for word in rest):
        return []  # here comes the number that stands behind the kind itself
    state = written_arguments(cls, rest)
    if state.awaits_number:
        return numbers(view)
    if not state.awaits_name or state.current is None:
        return [*_after_number(state), *keys(state.left)]
    match state.current.type:
        case Reference(noun="thing"):
            return things(view, task, about(noun, kind, state.current.key))
        case Reference(noun="sensor"):
            return names(view, "sensor", "memory")
        case Reference(noun=of, words=allowed) if of != "Python function":
            return [Offer(word, "word") for word in allowed]
    return []


def keys(parameters: Iterable[Argument]) -> list[Offer]:
    """Arguments that may be said, those first that must be."""
    first = sorted(parameters, key=lambda each: not each.required)
    return [Offer(each.key, "key", meaning(each), markdown.parameter_line(parameter(each))) for each in first]


def _after_number(state: WrittenArguments) -> Iterator[Offer]:
    """The units of a number, and the words of a range."""
    if state.current and state.values and state.values[-1][0] in NUMBER:
        yield from units_of(state.current)
        if state.current.shape == "span" and "to" not in state.values:
            yield Offer("to", "word")
        elif state.current.shape == "span" and "by" not in state.values:
            yield Offer("by", "word")


def units_of(parameter: Argument) -> list[Offer]:
    """The units that an argument takes."""
    return units(*filter(None, parameter.type.units)) if isinstance(parameter.type, Quantity) else []


def varying_parts(view: MindView, task: Declaration | None) -> Iterator[tuple[Offer, list[Argument]]]:
    """Each part of the robot and thing of a task, with its arguments that can differ from run to run."""
    for noun in VARIED_NOUNS:
        for part in names(view, noun):
            phrase = view.names.table[noun][part.label].header.phrase
            yield part, _varying(noun, phrase.kind.text if phrase else "")
    for thing in things(view, task, kinds("content")):
        yield thing, _varying("content", *thing.detail.split())


def _varying(noun: str, *of: str) -> list[Argument]:
    classes = [cls for name, cls in kinds(noun).items() if name in of]
    return [each for cls in classes for each in arguments(cls) if each.field in cls.varying]


def values(view: MindView, rest: Sequence[str], readings: Sequence[Offer]) -> list[Offer]:
    """Offers for a number behind the words `rest`: these readings, the names of numbers, the least of some."""
    if rest and rest[-1] in SEVERAL:
        return [Offer("of", "word")]
    return [*readings, *numbers(view), *words("least of", "greatest of")]


def awaits_value(rest: Sequence[str]) -> bool:
    """True if a value must come next."""
    begins_several = len(rest) > 1 and rest[-1] == "of" and rest[-2] in SEVERAL
    return not rest or rest[-1] in (*OPENINGS, *SEVERAL) or begins_several


def takes_value(rest: Sequence[str]) -> bool:
    """True if a value may come next: one must, or it is one more of several."""
    return awaits_value(rest) or any(word in SEVERAL for word in _since(rest, OPENINGS))


def condition_words(rest: Sequence[str]) -> list[Offer]:
    """Offers that join the comparison before with a next one; none where it is not over."""
    is_compared = any(word in COMPARISONS for word in _since(rest, JOINTS))
    return words("and", "or") if is_compared and not awaits_value(rest) else []


def _since(rest: Sequence[str], joints: Sequence[str]) -> Sequence[str]:
    """The words behind the last one of these."""
    last = max((place for place, word in enumerate(rest) if word in joints), default=-1)
    return rest[last + 1 :]


def term_offers(view: MindView, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
    """A reading or a measure, or what the measure that was begun still needs."""
    if takes_value(rest):
        readings = names(view, *READABLE_NOUNS, "actuator")  # the name of an actuator is its command
        return values(view, rest, [*readings, *kinds_of("measure")])
    begun = _begun(rest)
    return arguments_of(view, "measure", begun[0], begun[1:], task) if begun else []


def is_term_over(rest: Sequence[str]) -> bool:
    """True if the words end with a term to which nothing is missing."""
    if awaits_value(rest):
        return False
    begun = _begun(rest)
    state = written_arguments(kinds("measure")[begun[0]], begun[1:]) if begun else None
    return state is None or not (state.awaits_name or state.awaits_number)


def _begun(rest: Sequence[str]) -> Sequence[str]:
    """The measure that was begun last, with its arguments; nothing where it is over."""
    begun = max((place for place, word in enumerate(rest) if word in kinds("measure")), default=len(rest))
    return () if any(word in OPENINGS for word in rest[begun:]) else rest[begun:]
