"""A run, or a recording, with changes or under another mind, beside how it was: where both differ first, in what."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import chain, groupby
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.engine.changes import Change, ChangedEngine, ChangeError, in_tick
from mindrun.graph.bundle import Bundle
from mindrun.graph.graph import Graph
from mindrun.graph.named_readings import physical, reading_names
from mindrun.graph.run_scores import paid_by_text
from mindrun.graph.wiring import read_by
from mindrun.robot.recording import About, read
from mindrun.robot.replay import computed_again
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import take_over
from mindrun.terminal.tick_count import ticks as in_words
from numpy.typing import NDArray
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.compiler.diagnostic import listed
from mindlang.number_format import score
from mindlang.run.outcome import seed_words
from mindlang.run.recorded_run import ROWS, WITH_BEGINNING, RecordedRun, RunResult, result_of_trace, run_result
from mindlang.run.recording import running_bundle
from mindlang.run.setup import RunSetup
from mindlang.run.summary import aligned
from mindlang.whatif.request import Request, changes_of

Array = NDArray[Any]
Columns = Mapping[str, Array]  # by name, a row for each tick
Prepared = tuple[RunSetup, Rollout]  # a run that is set up, in the simulator
OPEN_LOOP = "open loop: the readings are those of the recording, whatever other commands would have led to"
MAX_NAMED_DIFFERENCES = 6  # of one kind in one tick
KINDS = {"reading": "read ", "influence": "influence of ", "command": "command ", "robot": "robot's ", "reward": ""}


@dataclass(frozen=True, slots=True)
class TickDifference:
    """A number of a tick, counted from 1: what it `was`, and what it is `now`, with the changes."""

    tick: int
    what: str
    name: str
    was: float
    now: float

    def as_data(self) -> dict[str, Any]:
        """For `--json`; a number that is not finite is None."""
        return {k: None if isinstance(v, float) and not np.isfinite(v) else v for k, v in asdict(self).items()}


@dataclass(frozen=True, slots=True)
class Compared:
    """A run as it `was` and as it is `now` with changes, and where they differ first, in the order of time."""

    was: RunResult
    now: RunResult
    differences: list[TickDifference]


def compare_runs(
    ours: Prepared, seed: int, tick: int, changes: Sequence[Change], theirs: Prepared | None = None
) -> Compared:
    """Run a seed as it is, and with changes or with another mind from a tick on.

    ChangeError where the run is over before the tick, or the other mind does not fit.
    """
    was = run_result(*ours, seed)
    if tick > was.run.ticks:
        over = f"the run is over after tick {was.run.ticks:,}: there is no tick {tick:,}"
        raise ChangeError(over, "say an earlier one")
    if theirs is None or tick == 1:
        now = run_result(*(theirs or ours), seed, changes)
    else:
        setup, rollout = theirs
        rest = result_of_trace(setup, take_over(ours[1], seed, tick, rollout, changes, setup.robot), seed)
        now = RunResult(_continued(was.run, rest.run, tick - 1), rest.found)
    return Compared(was, now, first_differences(_columns(was.run), _columns(now.run)))


def _continued(was: RecordedRun, rest: RecordedRun, ticks: int) -> RecordedRun:
    """A run whose first ticks are of one run, and the rest of another mind with the same sensors and actuators."""
    before, known = was.until(ticks), was.graph.skill_numbers
    influence = np.full((ticks, len(rest.graph.skills)), np.nan, np.float32)  # NaN of skills that it has alone
    for column, skill in enumerate(rest.graph.skills):
        if skill.name in known:
            influence[:, column] = before.influence[:, known[skill.name]]
    before = replace(before, influence=influence)
    after = replace(rest, events=rest.events + before.events[-1])
    joined: dict[str, Any] = {
        name: np.concatenate([getattr(before, name), getattr(after, name)[name in WITH_BEGINNING :]])
        for name in (*ROWS, "acting")
    }
    return replace(rest, **joined)


def _columns(run: RecordedRun) -> dict[str, Columns]:
    """All numbers of each tick by name, causes before effects."""
    pose = dict(zip(("x", "y", "angle"), run.body[1:].T, strict=True))
    return {
        **mind_columns(run.graph, run.readings, run.influence, run.commands),
        "robot": pose | {"holds": run.held[1:].astype(np.float64)},
        "reward": paid_by_text(run.task.rewards, run.lines),
    }


def mind_columns(graph: Graph, readings: Array, influence: Array, commands: Array) -> dict[str, Columns]:
    """The numbers that a mind reads, thinks and sends in each tick, by name, without those that nobody measured."""
    named = {
        "reading": zip(reading_names(graph), readings.T, strict=True),
        "influence": zip((skill.name for skill in graph.skills), influence.T, strict=True),
        "command": zip((actuator.name for actuator in graph.actuators), commands.T, strict=True),
    }
    return {kind: {name: rows for name, rows in of if not np.isnan(rows).all()} for kind, of in named.items()}


def first_differences(was: Mapping[str, Columns], now: Mapping[str, Columns]) -> list[TickDifference]:
    """The first tick of each kind of numbers, in the order of time: each number that differs in it.

    In one tick they stand in the order of the kinds, which is that of causes. Only names that both have are held
    against each other, in the ticks that both have.
    """
    found: list[TickDifference] = []
    for kind in was:
        pairs = {name: (was[kind][name], now[kind][name]) for name in was[kind] if name in now.get(kind, {})}
        ticks = min((min(len(a), len(b)) for a, b in pairs.values()), default=0)
        cut = {name: (a[:ticks], b[:ticks]) for name, (a, b) in pairs.items()}
        unlike = {name: ~((a == b) | (np.isnan(a) & np.isnan(b))) for name, (a, b) in cut.items()}
        first = min((int(each.argmax()) for each in unlike.values() if each.any()), default=None)
        if first is not None:
            found += [
                TickDifference(first + 1, kind, name, float(a[first]), float(b[first]))
                for name, (a, b) in pairs.items()
                if unlike[name][first]
            ]
    return sorted(found, key=lambda difference: difference.tick)


@dataclass(frozen=True, slots=True)
class OpenLoop:
    """The differences from a recording; ticks are counted from 1 over the whole recording.

    `sent` has by actuator how far its commands are from those recorded: ticks that differ, the mean, the most, when.
    """

    master: str
    ticks: int
    differences: list[TickDifference]
    sent: dict[str, dict[str, Any]]


def compare_recording(path: Path, bundle: Path, request: Request, other: Bundle | None = None) -> OpenLoop:
    """Compute a recording as it was and with changes, under another mind from a tick on where there is one.

    RecordingError where the recording was made with another bundle, or is not what this one computes; ChangeError where
    it ends before the tick. Runs the Python code of both minds' procedures.
    """
    about, parts = read(path)
    mind = running_bundle(bundle, about)
    theirs, master = (other, other.graph.master) if other else (mind, about.master)
    engine = ChangedEngine(theirs.policy, theirs.procedures, master)
    places = _places(about, mind.graph, theirs.graph, master, request.other or bundle.name)
    changes = changes_of(request, theirs.graph, master, bundle)

    def changed(number: int, row: Any) -> tuple[Any, ...]:
        if row["tick"] == 0:  # begun anew
            engine.reset()
        given = np.append(row["readings"], np.float32(np.nan))[places]
        commands = engine.tick_with(given, in_tick(changes, number))
        return engine.readings, engine.influence, commands

    ours = ChangedEngine(mind.policy, mind.procedures, about.master)
    computed = computed_again(path, about, chain.from_iterable(parts), ours)
    ticks = [
        ((ours.readings, ours.influence, row["commands"]), changed(number, row))
        for number, row in enumerate(computed, 1)
    ]
    if len(ticks) < request.tick:
        raise ChangeError(f"{path} has {in_words(len(ticks))}: there is no tick {request.tick:,}", "say an earlier one")
    begin = request.tick - 1  # another mind has read along before, and sent nothing
    whole = (
        mind_columns(graph, *map(np.array, zip(*(each[i] for each in ticks), strict=True)))
        for i, graph in enumerate((mind.graph, theirs.graph))
    )
    was, now = (
        {kind: {name: rows[begin:] for name, rows in of.items()} for kind, of in each.items()} for each in whole
    )
    differ = [replace(each, tick=each.tick + begin) for each in first_differences(was, now)]
    both = was["command"].keys() & now["command"].keys()
    sent = {name: _sent(rows, now["command"][name], begin) for name, rows in was["command"].items() if name in both}
    return OpenLoop(about.master, len(ticks), differ, sent)


def _places(about: About, graph: Graph, other: Graph, master: str, file: str) -> NDArray[np.intp]:
    """The place in a recorded row of each reading of a mind; the place after the last is what nobody measured."""
    known = {name: sensor for name, sensor in physical(graph).items() if name in about.sensors}
    wanted = physical(other)
    found = [name for name in wanted if name in known and known[name].width == wanted[name].width]
    read = read_by(other, master)
    missing = [name for name in wanted if name in read and name not in found]
    if missing:
        raise ChangeError(f"the recording has no {listed(missing, 'and')}, which {Path(file).name} reads")
    places = np.full(other.width, graph.width, np.intp)
    for name in found:
        sensor = wanted[name]
        places[sensor.start : sensor.start + sensor.width] = known[name].start + np.arange(sensor.width)
    return places


def _sent(was: NDArray[np.float32], now: NDArray[np.float32], begin: int) -> dict[str, Any]:
    apart = np.abs(now.astype(np.float64) - was)
    ticks = int(np.count_nonzero(apart))
    most_tick = begin + 1 + int(apart.argmax()) if ticks else None
    return {"ticks": ticks, "mean": float(apart.mean()), "most": float(apart.max()), "most_tick": most_tick}


def differences_text(differences: Sequence[TickDifference]) -> Text:
    """A line for each kind of number: its first tick that differs, and in what."""
    if not differences:
        return Text("nothing differs, to the bit")
    groups = groupby(differences, lambda each: (each.tick, each.what))
    rows = [(Text(f"tick {tick:,}", "dim"), KINDS[what] + _numbers([*group])) for (tick, what), group in groups]
    return aligned(rows, left=(1,))


def _numbers(group: Sequence[TickDifference]) -> str:
    named = [f"{each.name} {each.was:.6g} → {each.now:.6g}" for each in group[:MAX_NAMED_DIFFERENCES]]
    more = len(group) - len(named)
    return ", ".join(named) + (f" and {more} more" if more else "")


def comparison_summary(request: Request, compared: Compared) -> RenderableType:
    """A text: what differs first, and what came of both runs."""
    was, now = compared.was.found, compared.now.found
    columns = zip(*(_column(found, was, now) for found in (was, now)), strict=True)
    return Group(
        Text.assemble(
            (was["task"], "bold"),
            f" with {was['master']} in charge, {seed_words(was)}",
        ),
        Text(request.words),
        "",
        differences_text(compared.differences),
        "",
        _table([("", "as it was", "changed"), *((name, before, after) for (name, before), (_, after) in columns)]),
    )


def _column(found: dict[str, Any], was: dict[str, Any], now: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """The figures of one run by name, for a table of both; – for what only the other one has."""
    yield "ticks", f"{found['ticks']:,}"
    yield "ended by", found["ended_by"] or "time"
    if "succeeded" in was or "succeeded" in now:
        yield "success", "yes" if found.get("succeeded") else "no"
    for event in {**was["by_event"], **now["by_event"]}:
        yield event, str(found["by_event"].get(event, "–"))
    if was["faults"] or now["faults"]:
        yield "faults", f"{found['faults']:,}"
    for line in {**was["by_line"], **now["by_line"]}:
        yield line, score(found["by_line"][line]) if line in found["by_line"] else "–"
    yield "score", score(found["score"])


def comparison_data(request: Request, compared: Compared) -> dict[str, Any]:
    """The contents of `--json`; `differs` has the first tick of each kind of number, the earliest first."""
    was, now = compared.was.found, compared.now.found
    of_both: dict[str, Any] = {name: was[name] for name in ("task", "master", "seed", "robot") if name in was}
    was, now = ({name: value for name, value in found.items() if name not in of_both} for found in (was, now))
    differs = [each.as_data() for each in compared.differences]
    return {**of_both, **_asked(request), "differs": differs, "as_it_was": was, "changed": now}


def recording_summary(request: Request, name: str, found: OpenLoop) -> RenderableType:
    """A text: what the mind would have sent for the readings of a recording."""
    rows = [
        (actuator, f"{of['ticks']:,}", f"{of['mean']:.4g}", f"{of['most']:.4g}", _tick(of["most_tick"]))
        for actuator, of in found.sent.items()
    ]
    return Group(
        Text.assemble((name, "bold"), f" with {found.master} in charge, {in_words(found.ticks)}"),
        Text(request.words),
        Text(OPEN_LOOP),
        "",
        differences_text(found.differences),
        "",
        _table([("command", "differs in ticks", "mean", "most", "in tick"), *rows]),
    )


def recording_data(request: Request, found: OpenLoop) -> dict[str, Any]:
    """The contents of `--json`: `commands` has by how much each differs over the ticks from the first one changed."""
    return {
        "master": found.master,
        "ticks": found.ticks,
        **_asked(request),
        "open_loop": True,
        "differs": [each.as_data() for each in found.differences],
        "commands": found.sent,
    }


def _tick(number: int | None) -> str:
    return f"{number:,}" if number else "–"


def _asked(request: Request) -> dict[str, Any]:
    return {"changes": [*request.parts], "tick": request.tick}


def _table(rows: Sequence[Sequence[str]]) -> Text:
    return aligned([(Text(name, "dim"), *values) for name, *values in rows], left=(0,))
