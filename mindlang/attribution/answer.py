"""Runs and recordings that attribution is asked about, and its answers as plain data: the contents of `--json`."""

from dataclasses import asdict, dataclass
from math import isfinite, nan
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.engine.changes import ChangedEngine
from mindrun.engine.engine import procedure_sources
from mindrun.engine.think import hierarchy
from mindrun.graph.weights import reachable
from mindrun.kinds.sensors.sensor import directions
from mindrun.numbers.arrays import Bools, Doubles
from mindrun.robot.recording import RecordingError, read
from mindrun.robot.replay import computed_again
from mindrun.terminal.tick_count import ticks as in_words

from mindlang.attribution.shares import NAMED_PATHS, Contribution, shares
from mindlang.compiler.diagnostic import did_you_mean, listed
from mindlang.run.chosen_task import SetupError
from mindlang.run.edge_flow import EdgeFlows, Singles, Sink, edge_flows, sink_named
from mindlang.run.outcome import events, rewards_data, run_names
from mindlang.run.promises import promises_of
from mindlang.run.recorded_run import RecordedRun
from mindlang.run.recording import run_of, running_bundle

REWARD = "reward"  # asks for the score, where nothing has that name
DIRECTION_TOLERANCE = 1e-6  # of a unit vector: directions that lead no farther together have no mean
MAX_EDGE_TICKS = 10_000_000  # edges times ticks of one answer


@dataclass(frozen=True, slots=True)
class AttributedRun:
    """A run or a recording with its flows; `acted` [ticks, actuators] are the commands after delay or guardian.

    `stopped` [ticks] says when a robot was. `about` says which one it is, `run` has the rewards where there are any.
    """

    about: dict[str, Any]
    flows: EdgeFlows
    acted: Singles
    stopped: Bools
    run: RecordedRun | None = None

    @property
    def ticks(self) -> int:
        """The number of ticks, the first of which is 1."""
        return len(self.acted)


def attributed_run(run: RecordedRun, seed: int) -> AttributedRun:
    """A run in the simulator with its flows."""
    setup = run.setup
    sources = procedure_sources(run.graph, setup.folder, setup.master)
    flows = edge_flows(setup.ready.policy, sources, setup.master, run)
    about = run_names(setup.task, setup.master, seed)
    return AttributedRun(about, flows, run.commands, np.zeros(len(run.commands), bool), run)


def attributed_recording(path: Path, bundle: Path) -> AttributedRun:
    """A robot's recording with its flows, whose ticks are its rows; what it does not have is computed again.

    RecordingError where it was made with another bundle, or is not what this one computes. Runs the Python code of the
    bundle's procedures.
    """
    of, parts = read(path)
    mind = running_bundle(bundle, of)
    rows = np.concatenate([*parts, np.zeros(0, of.row)])
    if not len(rows):
        raise RecordingError(f"{path} has no tick in it")
    engine = ChangedEngine(mind.policy, mind.procedures, of.master)
    readings, influence = np.array([engine.readings for _ in computed_again(path, of, rows, engine)]), rows["influence"]
    ready, begins = hierarchy(mind.policy, mind.procedures, of.master), np.flatnonzero(rows["tick"] == 0).tolist()
    flows = EdgeFlows(mind.graph, ready, lambda places: (readings[places], influence[places]), begins)
    about = {"recording": path.name, "master": of.master}
    run = run_of(of, rows, mind, bundle.parent) if of.world else None
    return AttributedRun(about, flows, rows["sent"], rows["stopped"] != 0, run)


class QuestionError(SetupError):
    """A question that has no answer; the text is for the user."""

    def __init__(self, message: str, hint: str = "") -> None:
        super().__init__(message, hint, misuse=True)


def answer(attributed: AttributedRun, what: str, span: tuple[int, int] | None, paths: int | None) -> dict[str, Any]:
    """The shares in an actuator, memory, skill or the reward, in the ticks of a span from 1 on, or in all of them."""
    first, last = _within(attributed, span)
    about = attributed.about | {"ticks": [first, last], "seconds_per_tick": attributed.flows.graph.tick}
    target = sink_named(attributed.flows, what)
    if target is not None:
        return about | _shares(attributed, target, range(first - 1, last), paths or NAMED_PATHS)
    if what != REWARD:
        raise _unknown(attributed, what)
    if attributed.run is None:
        raise QuestionError("a robot's recording has no rewards", "Ask for an actuator, a memory or a skill.")
    if paths is not None:
        raise QuestionError("a reward comes along no paths", "Leave --paths out: all of its lines are said.")
    return about | _rewards(attributed.run, first, last)


def _within(attributed: AttributedRun, span: tuple[int, int] | None) -> tuple[int, int]:
    first, last = span or (1, attributed.ticks)
    if last > attributed.ticks:
        many = in_words(attributed.ticks)
        raise QuestionError(
            f"there is no tick {last:,}: it was over after {many}", f"Say one from 1 to {attributed.ticks}."
        )
    edges = len(attributed.flows.links)
    if (last - first + 1) * edges > MAX_EDGE_TICKS:
        most = MAX_EDGE_TICKS // edges
        raise QuestionError(
            f"{last - first + 1:,} ticks of {edges:,} edges are too much for one answer",
            f"Ask for {most:,} ticks at most: --tick {first}..{first + most - 1}",
        )
    return first, last


def _unknown(attributed: AttributedRun, what: str) -> QuestionError:
    graph, master = attributed.flows.graph, attributed.flows.master
    if what in {skill.name for skill in graph.skills}:
        return QuestionError(f"{what} is not below {master}, which is in charge", _instead(attributed, what))
    below = [graph.skills[index].name for index in attributed.flows.skills]
    acting = [*(actuator.name for actuator in graph.actuators), *(memory.name for memory in graph.memories)]
    acting += [REWARD] if attributed.run else []
    hint = did_you_mean(what, [*acting, *below]) or f"There is {listed(acting, 'and')}."
    return QuestionError(f"there is no actuator, memory or skill called {what}", hint)


def _instead(attributed: AttributedRun, skill: str) -> str:
    """The hint for a skill that the master does not reach: a skill above it."""
    if "recording" in attributed.about:
        return "It had no influence while this was recorded."
    graph = attributed.flows.graph
    above = next(each.name for each in graph.skills if skill in {below.name for below in reachable(graph, each.name)})
    return f"{'It is below another' if above != skill else 'Nothing is above it'}: --master {above}"


def _shares(attributed: AttributedRun, target: Sink, rows: range, paths: int) -> dict[str, Any]:
    found, graph = shares(attributed.flows, target, rows, paths), attributed.flows.graph
    data = asdict(found) | {
        "of": graph.named(*target),
        "kind": target[0],
        "ticks": [rows.start + 1, rows.stop],
        "paths": [asdict(each) | {"reads": _reads(attributed, each, rows)} for each in found.paths],
        "silent": [graph.skills[index].name for index in found.silent],
    }
    del data["target"]
    if target[0] == "skill" and (promises := promises_of(data["of"], attributed.flows, rows)):
        data["promises"] = promises
    return data | (_acted(attributed, target[1], rows) if target[0] == "actuator" else {})


def _reads(attributed: AttributedRun, of: Contribution, rows: range) -> dict[str, list[float | None]]:
    """Readings of the skill that sent it, by sensor or memory: means over the ticks, None where that is no number."""
    graph = attributed.flows.graph
    name = of.path[-2] if len(of.path) > 1 else of.path[0]  # before what was asked about, unless that is the master
    inputs = next(skill.inputs for skill in graph.skills if skill.name == name)
    read = attributed.flows.rows(np.array(rows))[0][:, list(inputs)].astype(float)
    around = directions({each.name: each.kind for each in graph.sensors})
    owners = dict(enumerate(name for name, _ in graph.readings))
    found: dict[str, list[float | None]] = {}
    for place, values in zip(inputs, read.T, strict=True):
        value = float((mean_direction if owners[place] in around else np.mean)(values))
        found.setdefault(owners[place], []).append(value if isfinite(value) else None)
    return found


def mean_direction(turns: Doubles) -> float:
    """The mean of directions in turns, 0..1: where their unit vectors lead together; NaN where that is nowhere."""
    together = np.exp(2j * np.pi * turns).mean()
    return float(np.angle(together) / (2 * np.pi) % 1.0) if abs(together) > DIRECTION_TOLERANCE else nan


def _acted(attributed: AttributedRun, actuator: int, rows: range) -> dict[str, Any]:
    """The mean command that reached the actuator, its delay, and in how many ticks the robot was stopped."""
    acted = attributed.acted[rows.start : rows.stop, actuator]
    return {
        "acted": float(acted.astype(float).mean()),
        "delay": attributed.flows.graph.actuators[actuator].kind.delay,
        "stopped": int(attributed.stopped[rows.start : rows.stop].sum()),
    }


def _rewards(run: RecordedRun, first: int, last: int) -> dict[str, Any]:
    """The rewards that each line has paid in these ticks; lines of one text are one, as in the outcome of a run."""
    paid = run.lines[last - 1] - (run.lines[first - 2] if first > 1 else 0.0)
    happened = run.events[last - 1] - (run.events[first - 2] if first > 1 else 0)
    return {
        "of": REWARD,
        "kind": REWARD,
        **rewards_data(run.task, paid),
        "by_event": {name: int(times) for name, times in zip(events(run.task), happened, strict=True) if times},
    }
