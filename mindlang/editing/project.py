"""The project that an edit works on: the files of a mind, main one first, and the declarations of their names."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from mindrun.errors import MindError
from mindrun.graph.graph import Graph
from mindrun.kinds.functions.function import Function
from mindrun.kinds.registry import kinds

from mindlang.compiler import syntax
from mindlang.compiler.compile import Compiled
from mindlang.compiler.diagnostic import Diagnostic, Findings, Label, a, did_you_mean, listed
from mindlang.compiler.model import Mind
from mindlang.compiler.names import READABLE_NOUNS, SHARED, VALUE_NOUNS, Mention, Names, mentions
from mindlang.compiler.parse import parse
from mindlang.compiler.parse.explain import proper
from mindlang.compiler.source import Source, Span, Splice
from mindlang.editing.neighbours import neighbours
from mindlang.lock import lock_sources

MAX_SUGGESTED_NAMES = 8  # names in a message
EXAMPLES = dict.fromkeys((*syntax.PARTS, "thing", "draw", "number"), "left_wheel")  # of the other nouns it is GoThere


class EditError(MindError):
    """An edit that is impossible; the diagnostic has the lines concerned."""

    def __init__(self, message: str, hint: str = "", span: Span | None = None, *labels: Label) -> None:
        super().__init__(message, hint)
        self.diagnostic = Diagnostic("impossible-edit", message, span, hint, labels)


@dataclass(frozen=True, slots=True)
class Renamed:
    """A rename, which the lock has to repeat."""

    noun: str
    old: str
    new: str


@dataclass(frozen=True, slots=True)
class Replaced:
    """A skill whose place another has taken: whoever influenced it, but for the other itself, influences that now."""

    old: str
    new: str


@dataclass(frozen=True, slots=True)
class Unshared:
    """A skill that was like its `owner` and now stands for itself.

    What it `reads` and to what it `sends` instead, by the names that the owner has for it.
    """

    skill: str
    owner: str
    reads: Mapping[str, str]
    sends: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class MindChange:
    """A change of a mind: `splices` of the sources, `created` files, and the names that the weights have to follow.

    One that is `of_families` knows that a line may stand for several. The skill `recast` has another function, which
    does the same.
    """

    splices: tuple[Splice, ...]
    renamed: tuple[Renamed, ...] = ()
    replaced: Replaced | None = None
    unshared: Unshared | None = None
    created: Mapping[Path, str] = field(default_factory=dict)
    of_families: bool = False
    recast: str = ""


@dataclass(frozen=True, slots=True)
class Project:
    """A mind that compiles, and its files as they were written; `neighbours` are the minds that share some of them."""

    mind: Mind
    graph: Graph
    neighbours: tuple["Project", ...] = ()

    @property
    def minds(self) -> tuple["Project", ...]:
        """The mind and its neighbours."""
        return (self, *self.neighbours)

    @property
    def names(self) -> Names:
        return self.mind.names

    @property
    def files(self) -> tuple[syntax.File, ...]:
        """The main file, then those that it uses."""
        return self.mind.files

    @property
    def main(self) -> syntax.File:
        """The file that was named on the command line."""
        return self.mind.files[0]

    def find(self, name: str, *nouns: str) -> syntax.Declaration:
        """The declaration of a name with one of the nouns; EditError where there is none."""
        if noun := self.names.noun_of(name, nouns):
            return self.names.table[noun][name]
        raise EditError(f"There is no {listed(nouns)} called {name}.", suggestion(name, self.names.of(*nouns)))

    def refuse_taken(self, noun: str, name: str) -> None:
        """EditError where a noun has the name already, or a measure that a reading would hide."""
        if noun in VALUE_NOUNS and name in kinds("measure"):
            meant = "number" if noun == "number" else "reading"
            message = f"{name} is a measure: rewards that say it would mean the {meant} then."
            raise EditError(message, "Choose another name.")
        for taken in (noun, *SHARED.get(noun, ())):
            if self.names.noun_of(name, (taken,)):
                label = self.names.place_of(taken, name)
                raise EditError(f"There is already {a(taken)} called {name}.", "Choose another name.", label)

    def declared(
        self, name: str, noun: str, say: str = "--noun {}", among: Sequence[str] = syntax.NOUNS
    ) -> syntax.Declaration:
        """The declaration of a name, of a noun `among` these where none is said; EditError where that is none, or two.

        `say` is how a noun is said on the command line.
        """
        if noun:
            refuse_no_noun(noun, syntax.NOUNS)
            return self.find(name, noun)
        found = [self.names.table[of][name] for of in among if name in self.names.table.get(of, {})]
        if len(found) == 1:
            return found[0]
        if not found:
            return self.find(name, *among)
        labels = [Label(each.header.name.span, f"{a(each.header.noun.text)} of this name") for each in found]
        hint = f"Say which: {say.format(found[0].header.noun.text)}"
        raise EditError(f"There are {len(found)} declarations called {name}.", hint, labels[0].span, *labels[1:])

    def refuse_existing(self, skill: syntax.Declaration, verb: str, name: str) -> None:
        """EditError where a skill reads, drives or influences something already."""
        for fact in skill.facts:
            if isinstance(fact, syntax.Reads | syntax.Sends) and (syntax.verb_of(fact), fact.name.text) == (verb, name):
                raise EditError(f"{skill.header.name.text} already {verb} {name}.", "", fact.span)

    def refuse_used(self, noun: str, name: str, but: Sequence[syntax.Declaration]) -> None:
        """EditError where a name stands anywhere `but` in these declarations."""
        used = [mention for mention in self.mentions(noun, name) if mention.by not in but]
        hint = "Take these lines out first."
        if any(mention.by is None for mention in used):
            hint = "Let another skill be the master first: " + self.main.source.edit("replace", name, "OTHER")
        refuse_mentioned(name, used, hint)

    @property
    def paths(self) -> dict[Path, syntax.File]:
        return {file.source.path: file for file in self.files}

    @property
    def texts(self) -> dict[Path, str]:
        return {path: file.source.text for path, file in self.paths.items()}

    @property
    def taught(self) -> list[Path]:
        """The files whose locks tell of the skills of this mind."""
        return lock_sources(file.source for file in self.files)

    def mentions(self, noun: str, name: str) -> Iterator[Mention]:
        """The mentions of a name in all files."""
        return (m for m in mentions(self.files, self.names) if m.noun == noun and m.name.text == name)

    def sharing(self, noun: str, name: str) -> list["Project"]:
        """The neighbours in which a name means the same: it stands in a file that they share."""
        paths = self.paths
        return [
            other
            for other in self.neighbours
            if any(mention.name.span.source.path in paths for mention in other.mentions(noun, name))
        ]

    def everywhere(self, noun: str, name: str) -> Iterator[Mention]:
        """The mentions of a name in all files and in those of the neighbours that share it."""
        yield from self.mentions(noun, name)
        seen = set(self.paths)
        for other in self.sharing(noun, name):
            yield from (m for m in other.mentions(noun, name) if m.name.span.source.path not in seen)
            seen |= set(other.paths)

    def parents(self, skill: str) -> list[syntax.Declaration]:
        """The skills that say that they influence a skill, or another in its place."""
        declared = (each.declaration for each in self.mind.skills)
        return [each for each in declared if any(_influenced(each, skill))]

    def own_skill(self, name: str) -> syntax.Declaration:
        """The declaration of a skill; EditError where it is like another, of which only what it reads is its own."""
        declaration = self.find(name, "skill")
        if (header := declaration.header).like:
            other = header.like.text
            hint = f"Edit {other}, or first: {self.main.source.edit('unshare', name)}"
            raise EditError(f"{name} is like {other}, and says nothing of its own.", hint, header.span)
        return declaration

    def refuse_new_skill(self, name: str, function: str, reads: Sequence[str]) -> None:
        """EditError where there cannot be a new skill of this name and function that reads this."""
        refuse_misnamed("skill", name)
        refuse_lines(function)
        self.refuse_taken("skill", name)
        for reading in reads:
            self.find(reading, *READABLE_NOUNS)

    def places(self, skill: str) -> Iterator[Mention]:
        """The mentions that place a skill in the hierarchy: as a subskill, and as the master."""
        for parent in self.parents(skill):
            yield from (Mention("skill", name, parent) for name in _influenced(parent, skill))
        masters = (setting.name for setting in self.main.settings if isinstance(setting, syntax.Master))
        yield from (Mention("skill", name, None) for name in masters if name.text == skill)


def _influenced(parent: syntax.Declaration, skill: str) -> Iterator[syntax.Name]:
    """The places where a skill's lines `influences` name another."""
    for fact in syntax.of_form(parent.facts, syntax.Influences):
        yield from (name for name in (fact.name, fact.stands_for) if name and name.text == skill)


def open_project(compiled: Compiled) -> Project:
    """The project of a file that compiled, with its neighbours."""
    alone = project_alone(compiled)
    return replace(alone, neighbours=tuple(map(project_alone, neighbours(tuple(alone.paths)))))


def project_alone(compiled: Compiled) -> Project:
    """The project of a file that compiled, without its neighbours."""
    assert compiled.mind is not None
    assert compiled.graph is not None
    return Project(compiled.mind, compiled.graph)


def kind_of(declaration: syntax.Declaration) -> str:
    """The kind that a declaration says after `is` or `in`."""
    return declaration.header.phrase.kind.text if declaration.header.phrase else ""


def influence(kind: str, skill: str) -> str:
    """The fact that lets a skill of a kind influence another; one without outputs of its own has to say how much."""
    return f"influences {skill}" if has_outputs(kind) else f"influences {skill} at 1"


def has_outputs(kind: str) -> bool:
    """True if the functions of a kind have outputs that edges without `at` send."""
    cls: type[Function] = kinds("skill").get(kind, Function)
    return cls.has_outputs


def suggestion(name: str, known: Sequence[str]) -> str:
    """The known name that a name was meant to be, or else what is known."""
    more = ", …" if len(known) > MAX_SUGGESTED_NAMES else ""
    declared = f"Declared are {', '.join(known[:MAX_SUGGESTED_NAMES])}{more}." if known else "None is declared."
    return did_you_mean(name, known) or declared


def refuse_no_noun(word: str, nouns: Sequence[str]) -> None:
    """EditError where a word is none of the nouns."""
    if word not in nouns:
        raise EditError(f"{word} is no noun.", did_you_mean(word, nouns) or f"The nouns are {listed(nouns, 'and')}.")


def refuse_misnamed(noun: str, name: str) -> None:
    """EditError where the grammar takes a text for no name of a noun."""
    if not _is_name(noun, name):
        better = proper("sensor" if noun in ("thing", "draw", "number") else noun, name)
        hint = f"Write {better}." if _is_name(noun, better) else f"Write for example {EXAMPLES.get(noun, 'GoThere')}."
        raise EditError(f"{name} cannot be the name of {a(noun)}.", hint)


def refuse_mentioned(name: str, used: Sequence[Mention], hint: str) -> None:
    """EditError where there are such mentions of a name."""
    if used:
        first, *others = (mention.name.span for mention in used)
        raise EditError(f"{name} is still used.", hint, first, *(Label(span, "and here") for span in others))


def refuse_lines(text: str) -> None:
    """EditError where a text would be more than a part of a line."""
    if "\n" in text or "#" in text:
        raise EditError("This is more than a part of a line.", "Add lines and comments with: mindc edit add")


def _is_name(noun: str, name: str) -> bool:
    """True if a line that gives this name can be read, and gives this and no other."""
    facts = {"thing": f"contains {name} is item", "draw": f"draws {name} from 0 1"}
    line = facts.get(noun) or f"{noun} {name} {'in' if noun == 'task' else 'is'} kind"
    findings = Findings()
    if noun == "number":
        read = parse(Source("name", f"number {name} is 1"), findings).settings
        return not findings.diagnostics and [each.name.text for each in read if isinstance(each, syntax.Number)] == [
            name
        ]
    task, *others = parse(Source("name", f"task Task in plain\n{line}"), findings).declarations
    names = [other.header.name for other in others] or [
        fact.name for fact in task.facts if isinstance(fact, syntax.Contains | syntax.Draws)
    ]
    return not findings.diagnostics and [known.text for known in names] == [name]
