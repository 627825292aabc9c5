"""What is to be different, as it is said on a command line, and as changes of a mind."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mindrun.engine.changes import Change, ChangeError, What, change_of, silenced
from mindrun.graph.graph import Graph
from mindrun.graph.weights import reachable

from mindlang.compiler.diagnostic import did_you_mean, listed
from mindlang.whatif.recorded_readings import is_recording, recorded_readings


@dataclass(frozen=True, slots=True)
class Request:
    """Skills to go `without`, `sensors` as `proximity=0.5`, `settings` as `battery=0.1`; from `tick` on, for `ticks`.

    A sensor may also read what it read in a recording: `proximity=day.rec`, or `proximity=day.rec,ball.bundle`.
    `other` is the file of another mind that takes over.
    Without `ticks`, a setting is for one tick and all else goes on to the end.
    """

    tick: int = 1
    ticks: int | None = None
    without: tuple[str, ...] = ()
    sensors: tuple[str, ...] = ()
    settings: tuple[str, ...] = ()
    other: str | None = None

    @property
    def is_empty(self) -> bool:
        """Whether nothing is to be different."""
        return not self.parts

    @property
    def parts(self) -> tuple[str, ...]:
        """Each change as it is said."""
        return (*self._lasting, *self.settings)

    @property
    def _lasting(self) -> tuple[str, ...]:
        """Those that go on to the end, if nothing else is said."""
        other = (f"with {self.other}",) if self.other else ()
        return (*other, *(f"without {skill}" for skill in self.without), *self.sensors)

    @property
    def words(self) -> str:
        """For reading: without Avoid and proximity=0.5, from tick 812 on."""
        if self.ticks is not None:
            groups: list[tuple[tuple[str, ...], int | None]] = [(self.parts, self.ticks)]
        else:
            groups = [(self._lasting, None), (self.settings, 1)]
        return "; ".join(f"{listed(parts, 'and')}, {self._span(ticks)}" for parts, ticks in groups if parts)

    def _span(self, ticks: int | None) -> str:
        if ticks is None:
            return f"from tick {self.tick:,} on" if self.tick > 1 else "from the first tick on"
        return f"in tick {self.tick:,}" if ticks == 1 else f"in ticks {self.tick:,} to {self.tick + ticks - 1:,}"


def changes_of(request: Request, graph: Graph, master: str, own: Path | None = None) -> tuple[Change, ...]:
    """The changes of a mind under a master; MindError where one cannot be made.

    `own` is its source or bundle, with which a recording was made where nothing else is said.
    """
    last = None if request.ticks is None else request.tick + request.ticks - 1
    found: list[Change] = []
    for skill in request.without:
        _refuse_unreached(graph, master, skill)
        found += silenced(graph, skill, request.tick, last)
    for words in request.sensors:
        name, said = _parts(words)
        if is_recording(said):
            found += recorded_readings(graph, name, said, own, request.tick, last)
            continue
        _, values = _assignment(words, "--sensor")
        found += change_of(graph, "reading", name, [values], request.tick, last)
    for words in request.settings:
        name, values = _assignment(words, "--set")
        what = _what(graph, name)
        if what == "influence":
            _refuse_unreached(graph, master, name)
        found += change_of(graph, what, name, [values], request.tick, request.tick if last is None else last)
    return tuple(found)


def _assignment(words: str, option: str) -> tuple[str, list[float]]:
    """The name and the numbers of `proximity=0.5` or `proximity=1,0.5,1`."""
    name, said = _parts(words)
    try:
        values = [float(value) for value in said.split(",")]
    except ValueError:
        raise ChangeError(f"{option} {words} does not say a number", f"write {option} {name or 'NAME'}=0.5") from None
    return name, values


def _parts(words: str) -> tuple[str, str]:
    name, _, said = words.partition("=")
    return name.strip(), said.strip()


def _what(graph: Graph, name: str) -> What:
    """Whether a name is that of a sensor, a memory or a skill; ChangeError where it is none."""
    known: dict[What, Sequence[str]] = {
        "reading": [sensor.name for sensor in graph.sensors],
        "memory": [memory.name for memory in graph.memories],
        "influence": [skill.name for skill in graph.skills],
    }
    for what, names in known.items():
        if name in names:
            return what
    hint = did_you_mean(name, [each for names in known.values() for each in names])
    raise ChangeError(f"there is no sensor, memory or skill called {name}", hint)


def _refuse_unreached(graph: Graph, master: str, skill: str) -> None:
    """ChangeError where a skill has no influence anyway."""
    names = [each.name for each in reachable(graph, master)]
    if skill not in names:
        known = skill in {each.name for each in graph.skills}
        said = f"{master} does not influence {skill}" if known else f"there is no skill called {skill}"
        raise ChangeError(said, did_you_mean(skill, names) or f"Below {master} there is {listed(names, 'and')}.")
