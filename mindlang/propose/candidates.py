"""Candidates for a task's skill: what each reads and sends, as lines of a source, in the order in which they are tried.

Those that need no lesson come first: a taught skill as it is, or one that is like another with its readings exchanged.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from typing import Literal

from mindrun.graph.graph import Graph
from mindrun.kinds.registry import phrase
from mindrun.kinds.sensors.sensor import SensorKind

from mindlang.compiler.model import Task
from mindlang.propose.static import Known

Way = Literal["nothing", "unchanged", "like", "from", "master", "scratch"]
WIDEST_MASTER = 6  # taught skills of which all pairs are tried
BIAS = "bias"
LEARNER = "genetic population 50 octaves 2"
FOUNDER_TICKS, MOST_FOUNDERS = 30_000_000, 3000  # random genomes that a lesson begins with, fewer for long runs
SHORT_TICKS = 2500  # of the runs with which a lesson begins


@dataclass(frozen=True, slots=True)
class Candidate:
    """A way to do a task: a skill that `reads` sensors and `sends`, in the words of its lines.

    Of one that is `like` another, or `unchanged`, `origin` is that, and `reads` and `sends` have what is exchanged. One
    that begins `from` another has its weights. Readings that are `held` are constants, for what they are worth.
    """

    way: Way
    reads: tuple[str, ...] = ()
    sends: tuple[str, ...] = ()
    origin: str = ""
    function: str = "mlp hidden 2"
    held: Mapping[str, tuple[float, ...]] = field(default_factory=dict)

    @property
    def learns(self) -> bool:
        """True if it has to be taught."""
        return self.way in ("from", "master", "scratch")

    @property
    def subskills(self) -> tuple[str, ...]:
        """The skills that it influences, in the order of its lines."""
        return tuple(line.split()[1] for line in self.sends if line.startswith("influences "))

    def without(self, reading: str) -> "Candidate":
        """The candidate that does not read something."""
        return replace(self, reads=tuple(name for name in self.reads if name != reading))

    def holding(self, means: Mapping[str, tuple[float, ...]]) -> "Candidate":
        """The candidate with some of its readings held at constants."""
        return replace(self, held={**self.held, **means})

    def skill(self, name: str, remarks: Mapping[str, str] | None = None) -> list[str]:
        """The lines of its declaration, with remarks as comments behind what they are about."""
        kind = f"like {self.origin}" if self.way == "like" else self.function
        lines = {f"skill {name} is {kind}": ""}
        for read in self.reads:
            wide = len(self.held.get(read, ()))
            said = [f"held_{read}_{number}" for number in range(wide)] or [read]
            lines |= {f"  reads {each}": read for each in said}
        lines |= {f"  {line}": line for line in self.sends}
        about = remarks or {}
        return [f"{line}  # {about[what]}" if what in about else line for line, what in lines.items()]

    def sensors(self, known: Known) -> list[str]:
        """The declarations of what it reads that the mind does not have: a bias, and readings that are held."""
        there = {sensor.name for sensor in known.mind.sensors}
        bias = [f"sensor {BIAS} is computed at 1"] if BIAS in self.reads and BIAS not in there else []
        held = (
            f"sensor held_{read}_{number} is computed at {value:.6f}"
            for read, values in self.held.items()
            for number, value in enumerate(values)
        )
        return [*bias, *held]

    def curriculum(self, skill: str, task: Task, name: str, generations: int) -> list[str]:
        """The lines of its lesson; none where it learns nothing."""
        if not self.learns:
            return []
        founders = min(MOST_FOUNDERS, max(100, FOUNDER_TICKS // task.ticks))
        short = max(0.01, SHORT_TICKS / task.ticks)
        begins = f"from {self.origin}" if self.origin else f"founders {founders} from scratch"
        shorter = f" short {100 * short:.0f}%" if short < 1 else ""
        lesson = f"  teaches {skill} on {task.name} for {generations} generations{shorter} {begins}"
        return [f"curriculum {name} is {LEARNER}", lesson]


def like_candidates(known: Known, able: Sequence[str]) -> Iterator[Candidate]:
    """Each taught skill with what it reads of one thing exchanged for what there is of one of the task's things."""
    kinds = {part.name: part.kind for part in known.mind.sensors}
    for name in able:
        skill = known.skills[name]
        if skill.like:
            continue
        about = {thing for read in _all_reads(known, name) for thing in kinds[read].things if read in kinds}
        for old in sorted(about - known.things):
            for new in sorted(known.things):
                if exchanged := _exchanged(known, name, kinds, old, new):
                    yield Candidate("like", *exchanged, origin=name)


def _all_reads(known: Known, skill: str) -> set[str]:
    read = {*known.skills[skill].reads}
    for other in known.skills[skill].subskills:
        read |= _all_reads(known, other)
    return {name for name in read if name in {part.name for part in known.mind.sensors}}


def _exchanged(
    known: Known, skill: str, kinds: Mapping[str, SensorKind], old: str, new: str
) -> tuple[tuple[str, ...], tuple[str, ...]] | None:
    """The lines that make a skill about another thing: what it reads instead, and whom it influences; None if none."""
    own = known.skills[skill]
    reads = {name: counterpart(kinds, name, old, new) for name in own.reads if name in kinds}
    lines = tuple(f"{other} for {name}" for name, other in reads.items() if other and other != name)
    sends = list[str]()
    for below in own.subskills:
        if not any(counterpart(kinds, read, old, new) not in (None, read) for read in _all_reads(known, below)):
            continue
        if (other := _skill_for(known, below, kinds, old, new)) is None:
            return None
        sends.append(f"influences {other} for {below}")
    return (lines, tuple(sends)) if lines or sends else None


def _skill_for(known: Known, skill: str, kinds: Mapping[str, SensorKind], old: str, new: str) -> str | None:
    """The skill of the mind that reads of one thing what another reads of an old one, and sends the same."""
    own = known.skills[skill]
    wanted = {counterpart(kinds, read, old, new) or read for read in own.reads}
    sends = {edge.target for edge in own.edges}
    found = (each for each in known.mind.skills if {*each.reads} == wanted and {e.target for e in each.edges} == sends)
    return next((each.name for each in found), None)


def counterpart(kinds: Mapping[str, SensorKind], name: str, old: str, new: str) -> str | None:
    """The sensor that reads of one thing what another reads of an old one; itself where it reads neither; else None."""
    kind = kinds[name]
    sources = {source: counterpart(kinds, source, old, new) for source in kind.sources if source in kinds}
    if old not in kind.things and all(other == source for source, other in sources.items()):
        return name
    meant = _renamed(kind, {old: new, **{source: other for source, other in sources.items() if other}})
    return next((other for other, each in kinds.items() if each == meant), None)


def _renamed(kind: SensorKind, names: Mapping[str, str]) -> SensorKind:
    """A sensor of a kind with other names in its arguments."""
    fields = {each: getattr(kind, each) for each in kind.__dataclass_fields__}  # type: ignore[attr-defined]
    changed = {key: names[value] for key, value in fields.items() if isinstance(value, str) and value in names}
    return replace(kind, **changed)  # type: ignore[type-var]


def learning_candidates(known: Known, able: Sequence[str], probed: Mapping[str, float]) -> Iterator[Candidate]:
    """What could learn the task: from scratch by each reading and by all, masters over pairs, and from the best two.

    `able` are the skills that can act, `probed` how much better each does alone than nothing.
    """
    drives = tuple(f"drives {name}" for name in known.actuators)
    for name in known.changing:
        yield Candidate("scratch", (name, BIAS), drives)
    if len(known.changing) > 1:
        yield Candidate("scratch", (*known.changing, BIAS), drives)
    learnt = [name for name in able if known.skills[name].function.learns]
    ranked = sorted(learnt, key=lambda name: (-probed[name], -len(known.named & {*known.reads_of(name)})))
    for pair in combinations(sorted(ranked[:WIDEST_MASTER]), 2):
        yield master_over(known, able, pair)
    for name in ranked[:2]:
        if probed[name] > 0 and not known.skills[name].like:
            yield from_candidate(known, name)


def master_over(known: Known, able: Sequence[str], skills: Sequence[str]) -> Candidate:
    """A master over some skills: it reads what they read and can change, and what the task's words are about.

    Where the task needs a claw and none of them drives it, a rule that does is there as well, with full influence.
    """
    rules = [name for name in able if not known.skills[name].function.learns]
    missing = {*known.actuators} - known.driven_by(skills)
    helping = [rule for rule in rules if known.driven_by([rule]) & missing]
    read = {name for skill in (*skills, *helping) for name in known.reads_of(skill)}
    sends = (*(f"influences {name}" for name in skills), *(f"influences {name} at 1" for name in helping))
    return Candidate("master", tuple(name for name in known.changing if name in read), sends)


def from_candidate(known: Known, name: str) -> Candidate:
    """A skill that begins with the weights of another, and reads what the task's words are about besides."""
    own = known.skills[name]
    reads = (*own.reads, *(each for each in known.changing if each in known.named and each not in own.reads))
    sends = tuple(edge.fact.span.text for edge in own.edges)
    return Candidate("from", reads, sends, name, function_of(known.graph, name))


def function_of(graph: Graph, name: str) -> str:
    """The words for the function of a skill, with what is derived left out."""
    return phrase(next(each.function for each in graph.skills if each.name == name))
