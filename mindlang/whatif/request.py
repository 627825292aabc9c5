"""Changes asked for on a command line, and made into those of a mind."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from mindrun.engine.changes import Change, ChangeError, What, change_of, silenced
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import Graph
from mindrun.graph.recording_header import About, RecordingError
from mindrun.graph.weights import reachable
from mindrun.robot.recording import read
from mindrun.terminal.command_line import command_line
from mindrun.terminal.tick_count import ticks as in_words

from mindlang.compiler.diagnostic import did_you_mean, listed
from mindlang.run.recording import measured_in, running_bundle

RECORDING_SUFFIX = ".rec"


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
    def parts(self) -> tuple[str, ...]:
        return (*self._lasting, *self.settings)

    @property
    def _lasting(self) -> tuple[str, ...]:
        """Those that go on to the end, if nothing else is said."""
        other = (f"with {self.other}",) if self.other else ()
        return (*other, *(f"without {skill}" for skill in self.without), *self.sensors)

    @property
    def words(self) -> str:
        """The changes in words: without Avoid and proximity=0.5, from tick 812 on."""
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
    first = request.tick
    last = None if request.ticks is None else first + request.ticks - 1
    found: list[Change] = []
    for skill in request.without:
        _refuse_unreached(graph, master, skill)
        found += silenced(graph, skill, first, last)
    for words in request.sensors:
        name, said = _parts(words)
        if said.partition(",")[0].endswith(RECORDING_SUFFIX):
            found += recorded_readings(graph, name, said, own, first, last)
        else:
            found += change_of(graph, "reading", name, [_values(words, "--sensor")], first, last)
    for words in request.settings:
        name, values = _parts(words)[0], _values(words, "--set")
        what = _what(graph, name)
        if what == "influence":
            _refuse_unreached(graph, master, name)
        found += change_of(graph, what, name, [values], first, last or first)
    return tuple(found)


def _parts(words: str) -> tuple[str, str]:
    name, _, said = words.partition("=")
    return name.strip(), said.strip()


def _values(words: str, option: str) -> list[float]:
    """The numbers of `proximity=0.5` or `proximity=1,0.5,1`."""
    name, said = _parts(words)
    try:
        return [float(value) for value in said.split(",")]
    except ValueError:
        raise ChangeError(f"{option} {words} does not say a number", f"write {option} {name or 'NAME'}=0.5") from None


def _what(graph: Graph, name: str) -> What:
    """The kind of change that a name of a sensor, a memory or a skill stands for; ChangeError where it is none."""
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


def recorded_readings(
    graph: Graph, name: str, said: str, own: Path | None, first: int, last: int | None
) -> tuple[Change, ...]:
    """A sensor that reads in each tick from `first` on what it has read in this tick of a recording, while that lasts.

    `said` is the recording and, behind a comma, the bundle or source that was running, without which that is `own`.
    MindError where one cannot be read, the recording is of another bundle, or the sensor is another there.
    """
    file, _, bundle = said.partition(",")
    path = Path(file)
    [begin, *_] = change_of(graph, "reading", name, [[0.0]], first, last)  # or it says what is wrong
    about, parts = read(path)
    mind = _bundle(path, about, Path(bundle) if bundle else own, name, bool(bundle))
    sensor = next((sensor for sensor in mind.graph.sensors if sensor.name == name), None)
    if sensor is None or not measured_in(about, mind)[sensor.start]:
        raise ChangeError(f"{path} has no readings of {name}", f"it has those of {', '.join(about.sensors)}")
    ours = next(each for each in graph.sensors if each.name == name)
    if sensor.width != ours.width:
        many = "1 reading" if sensor.width == 1 else f"{sensor.width} readings"
        raise ChangeError(f"{name} has {many} in {path}, and {ours.width} here", "take a recording of the same sensor")
    if about.tick != graph.tick:
        raise ChangeError(
            f"a tick of {path} is {about.tick:g} s, and one of this run {graph.tick:g} s",
            "take a recording of a mind with the same tick",
        )
    nothing = np.zeros((0, sensor.width), np.float32)  # a recording may have no row
    rows = np.concatenate([nothing, *(part["readings"][:, sensor.place] for part in parts)])
    if len(rows) < first:
        raise ChangeError(f"{path} has {in_words(len(rows))}: there is no tick {first:,}", "say an earlier one")
    end = len(rows) if last is None else min(last, len(rows))
    read_then = rows[first - 1 : end].astype(float).T.tolist()
    return tuple(Change("reading", begin.row + k, tuple(column), first, end) for k, column in enumerate(read_then))


def _bundle(path: Path, about: About, running: Path | None, name: str, is_said: bool) -> Bundle:
    """The bundle of a recording, which knows where the readings of each sensor stand in a row."""
    hint = f"say the bundle that was running behind it: {command_line('--sensor', f'{name}={path},NAME.bundle')}"
    if running is None:
        raise ChangeError(f"nobody says which bundle was running when {path} was recorded", hint)
    try:
        return running_bundle(running, about)
    except RecordingError as error:
        if is_said:
            raise
        raise ChangeError(f"{path}: {error}", hint) from error
