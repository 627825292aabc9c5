"""What an editor may offer to be written at a place, and the names from which it is chosen."""

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mindrun.kinds.registry import Argument, arguments, kinds, named_arguments
from mindrun.kinds.variation import VARIED_NOUNS
from mindrun.numbers.quantity import Quantity, Reference

from mindlang.compiler.names import things_of
from mindlang.compiler.references import READABLE_NOUNS
from mindlang.compiler.resolve.kinds import about
from mindlang.compiler.source import comment_of
from mindlang.compiler.syntax import Declaration, Reads
from mindlang.explaining import markdown
from mindlang.explaining.kinds import kind_article
from mindlang.explaining.parameters import meaning, parameter
from mindlang.explaining.words import language_words
from mindlang.files import files_beside, text_of
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
    return [Offer(label, "word", text=_word(label)) for label in labels]


def _word(label: str) -> str:
    """What a word of the language is for."""
    article = language_words().get(label)
    return article.summary if article else ""


def names(view: MindView, *nouns: str, but: Iterable[str] = ()) -> list[Offer]:
    """What is declared with one of these nouns, but for some."""
    left = set(but)
    return [
        Offer(name, noun, declaration.header.span.text.strip(), declaration.comment)
        for noun in nouns
        for name, declaration in view.names.declarations(noun)
        if name not in left
    ]


def inputs_of(view: MindView, skill: str) -> set[str]:
    """What a skill reads, by what it says or the skills say that it is like."""
    found: set[str] = set()
    replaced: set[str] = set()
    seen: set[str] = set()
    declared = dict(view.names.declarations("skill"))
    while skill in declared and skill not in seen:
        seen.add(skill)
        reads = [fact for fact in declared[skill].facts if isinstance(fact, Reads)]
        found |= {fact.name.text for fact in reads} - replaced
        replaced |= {fact.stands_for.text for fact in reads if fact.stands_for}
        like = declared[skill].header.like
        skill = like.text if like else ""
    return found


def numbers(view: MindView) -> list[Offer]:
    """The names of numbers."""
    declared = view.names.numbers.items()
    return [Offer(name, "number", number.span.text.strip(), comment_of(number.span)) for name, number in declared]


def kinds_of(noun: str) -> list[Offer]:
    """The kinds of a noun with their documentation."""
    return [Offer(name, "kind", noun, markdown.card(kind_article(noun, name))) for name in sorted(kinds(noun))]


def things(view: MindView, task: Declaration | None, about: Iterable[str]) -> list[Offer]:
    """The things of a task, or of all, of which a kind can be."""
    fit = set(about)
    worlds = [each for noun in ("task", "scene") for _, each in view.whole.declarations(noun)]
    own = [each for each in worlds if task and each.header.name is task.header.name]
    tasks = own or ([task] if task else worlds)
    found: dict[str, set[str]] = {}
    for declaration in tasks:
        for name, kinds_ in things_of(declaration).items():
            found.setdefault(name, set()).update(kinds_)
    return [Offer(name, "thing", " ".join(sorted(is_))) for name, is_ in found.items() if is_ & fit]


@dataclass(frozen=True, slots=True)
class WrittenArguments:
    """What has been said after a kind: the argument that was begun last, its values, and which others there are."""

    current: Argument | None
    values: tuple[str, ...]
    left: tuple[Argument, ...]

    @property
    def awaits_name(self) -> bool:
        """Whether a name must come next."""
        return self.current is not None and self.current.shape == "name" and not self.values

    @property
    def awaits_number(self) -> bool:
        """Whether a number must come next."""
        return self.current is not None and self.current.shape != "name" and self._is_open

    @property
    def _is_open(self) -> bool:
        return not self.values or self.values[-1] in ("to", "by", "-", "+")


def written_arguments(cls: type[Any], rest: Iterable[str]) -> WrittenArguments:
    """What the words after a kind say."""
    parameters = {parameter.key: parameter for parameter in arguments(cls)}
    current: Argument | None = None
    values: list[str] = []
    left = dict(parameters)
    for word in rest:
        if current and current.shape == "name" and not values:
            values.append(word)
        elif word in parameters:
            current, values = parameters[word], []
            left.pop(word, None)
        else:
            values.append(word)
    named = {each.key for each in named_arguments(cls)}
    return WrittenArguments(current, tuple(values), tuple(each for key, each in left.items() if key in named))


def arguments_of(view: MindView, noun: str, kind: str, rest: Iterable[str], task: Declaration | None) -> list[Offer]:
    """What can come after a kind and some of its arguments."""
    cls = kinds(noun).get(kind)
    if cls is None:
        return []
    rest = [*rest]
    if kind in {each.key for each in arguments(cls)} and not any(word[0] in NUMBER for word in rest):
        return []  # here comes the number that stands behind the kind itself
    state = written_arguments(cls, rest)
    if state.awaits_name and state.current:
        return _named(view, noun, kind, state.current, task)
    if state.awaits_number:
        return numbers(view)
    return [*_after_number(state), *keys(state.left)]


def keys(parameters: Iterable[Argument]) -> list[Offer]:
    """Arguments that may be said, those first that must be."""
    first = sorted(parameters, key=lambda each: not each.required)
    return [Offer(each.key, "key", meaning(each), markdown.parameter_line(parameter(each))) for each in first]


def _after_number(state: WrittenArguments) -> Iterator[Offer]:
    """The units of a number, and the words of a range."""
    if state.current and state.values and state.values[-1][0] in NUMBER:
        if isinstance(state.current.type, Quantity):
            yield from units(*state.current.type.units)
        if state.current.shape == "span":
            yield from (Offer(word, "word") for word in ("to", "by") if _fits(word, state.values))


def units(*units_: str) -> list[Offer]:
    """Units of a number."""
    return [Offer(unit, "unit", _word(unit)) for unit in units_ if unit]


def units_of(parameter: Argument) -> list[Offer]:
    """The units that an argument takes."""
    return units(*parameter.type.units) if isinstance(parameter.type, Quantity) else []


def varying_parts(view: MindView, task: Declaration | None) -> Iterator[tuple[Offer, list[Argument]]]:
    """What has arguments that can differ from run to run, and which: parts of the robot, things of a task."""
    declared = [(offer, noun) for noun in VARIED_NOUNS for offer in names(view, noun)]
    for offer, noun in declared:
        phrase = view.names.table[noun][offer.label].header.phrase
        yield offer, _varying(noun, {phrase.kind.text} if phrase else set())
    for thing in things(view, task, kinds("content")):
        yield thing, _varying("content", set(thing.detail.split()))


def _varying(noun: str, of: Iterable[str]) -> list[Argument]:
    classes = [cls for name, cls in kinds(noun).items() if name in of]
    return [each for cls in classes for each in arguments(cls) if each.field in cls.varying]


def _fits(word: str, values: tuple[str, ...]) -> bool:
    return "to" not in values if word == "to" else "to" in values and "by" not in values


def _named(view: MindView, noun: str, kind: str, parameter: Argument, task: Declaration | None) -> list[Offer]:
    assert isinstance(parameter.type, Reference)
    match parameter.type:
        case Reference(noun="thing"):
            return things(view, task, about(noun, kind, parameter.key))
        case Reference(noun="sensor"):
            return names(view, "sensor", "memory")
        case Reference(noun="Python function"):
            return []
        case Reference(words=allowed):
            return [Offer(word, "word") for word in allowed]


def functions(folder: Path) -> list[str]:
    """`module.function` for each function of the modules in a folder that has a name of the language."""
    modules = [path for path in files_beside(folder, ".py") if "a" <= path.name[0] <= "z"][:MAX_MODULES]
    return [f"{path.stem}.{name}" for path in modules for name in _FUNCTION.findall(text_of(path))]


def values(view: MindView, rest: Sequence[str], readings: Sequence[Offer]) -> list[Offer]:
    """What can stand for a number behind the words `rest`: these readings, the names of numbers, the least of some."""
    if rest and rest[-1] in SEVERAL:
        return [Offer("of", "word")]
    return [*readings, *numbers(view), *words("least of", "greatest of")]


def awaits_value(rest: Sequence[str]) -> bool:
    """Whether a value must come next."""
    return not rest or rest[-1] in (*OPENINGS, *SEVERAL) or _begins_several(rest)


def takes_value(rest: Sequence[str]) -> bool:
    """Whether a value may come next: one must, or it is one more of several."""
    since = _since(rest, OPENINGS)
    return awaits_value(rest) or any(word in SEVERAL for word in since)


def condition_words(rest: Sequence[str]) -> list[Offer]:
    """What may join the comparison before it with the next; nothing where it is not over."""
    is_compared = any(word in COMPARISONS for word in _since(rest, JOINTS))
    return words("and", "or") if is_compared and not awaits_value(rest) else []


def _begins_several(rest: Sequence[str]) -> bool:
    return len(rest) > 1 and rest[-1] == "of" and rest[-2] in SEVERAL


def _since(rest: Sequence[str], joints: Sequence[str]) -> Sequence[str]:
    """The words behind the last one of these."""
    last = max((place for place, word in enumerate(rest) if word in joints), default=-1)
    return rest[last + 1 :]


def condition_offers(view: MindView, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
    """What can come after `when` in a task."""
    return [*_term(view, task, rest), *condition_words(rest)]


def reward_offers(view: MindView, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
    """What can come after the words `rest` of a reward."""
    if "when" in rest:
        return condition_offers(view, task, rest[rest.index("when") :])
    match rest:
        case [*_, "on", "its"]:
            return [Offer("end", "word")]
        case [*_, "its"]:
            return [Offer("reward", "word")]
        case [*_, "per"]:
            return [Offer("tick", "word")]
        case [*_, "for"]:
            return [Offer("each", "word")]
        case [*_, "each"] | [*_, "each", _]:
            return words("in") if rest[-1] != "each" else []
        case [*_, "each", _, "in"]:
            return names(view, *READABLE_NOUNS)
        case [*_, "each", _, "in", _]:
            return words("when")
        case [*_, "per", "tick"]:
            return words("for each", "when")
        case [*_, "on"]:
            return kinds_of("event")
    if "on" in rest:
        kind, *arguments = rest[rest.index("on") + 1 :]
        return [*arguments_of(view, "event", kind, arguments, task), *words("when")]
    joints = words("per tick", "on") if rest and not awaits_value(rest) and not _waits(rest) else []
    return [*_term(view, task, rest), *joints]


def _term(view: MindView, task: Declaration | None, rest: Sequence[str]) -> list[Offer]:
    """A reading or a measure, or what the measure that was begun still needs."""
    if takes_value(rest):
        readings = names(view, *READABLE_NOUNS, "actuator")  # the name of an actuator is its command
        return values(view, rest, [*readings, *kinds_of("measure")])
    begun = _begun(rest)
    return arguments_of(view, "measure", begun[0], begun[1:], task) if begun else []


def _begun(rest: Sequence[str]) -> Sequence[str]:
    """The measure that was begun last, with its arguments; nothing where it is over."""
    begun = max((place for place, word in enumerate(rest) if word in kinds("measure")), default=len(rest))
    return () if any(word in OPENINGS for word in rest[begun:]) else rest[begun:]


def _waits(rest: Sequence[str]) -> bool:
    """Whether an argument of a measure waits for its value."""
    begun = _begun(rest)
    state = written_arguments(kinds("measure")[begun[0]], begun[1:]) if begun else None
    return state is not None and (state.awaits_name or state.awaits_number)
