"""Runs and recordings that attribution is asked about; its answers as plain data, for `--json`, and as text."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from math import isfinite, nan
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.engine.changes import ChangedEngine
from mindrun.engine.think import hierarchy
from mindrun.errors import MindError
from mindrun.graph.tasks import robots_in
from mindrun.graph.weights import reachable
from mindrun.kinds.sensors.sensor import directions
from mindrun.numbers.arrays import Bools, Doubles
from mindrun.robot.recording import RecordingError, read
from mindrun.robot.replay import computed_again
from mindrun.terminal.tick_count import ticks as in_words
from rich.console import Group, RenderableType
from rich.text import Text

from mindlang.attribution.shares import MAX_COUNTED_PATHS, NAMED_PATHS, Contribution, shares
from mindlang.compiler.diagnostic import did_you_mean, listed
from mindlang.number_format import score
from mindlang.run.edge_flow import EdgeFlows, Singles, Sink, sink_named
from mindlang.run.outcome import events, rewards_data, robot_words, run_names, seed_words
from mindlang.run.promises import promises_of
from mindlang.run.recorded_run import RecordedRun
from mindlang.run.recording import run_of, running_bundle
from mindlang.run.summary import shortened

REWARD = "reward"  # asks for the score, where nothing has that name
DIRECTION_TOLERANCE = 1e-6  # of a unit vector: directions that lead no farther together have no mean
MAX_EDGE_TICKS = 10_000_000  # edges times ticks of one answer
LINE_CHARACTERS = 80
MAX_NAMED_SKILLS = 4  # of those that sent nothing
MAX_NAMED_READINGS = 5  # of one sensor
BAR_CHARACTERS = 5
PATH_COLUMN = 35  # where paths begin
GAIN_NOTED = 1e-6  # by which rounding or a delay changes a command, for it to be said


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
    about = run_names(setup.task, setup.master, seed, setup.robot)
    return AttributedRun(about, setup.flows(run), run.commands, np.zeros(len(run.commands), bool), run)


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
    run = run_of(of, rows, mind, bundle.parent) if of.world else None
    watched = {"robot": run.setup.robot} if run and robots_in(run.task) > 1 else {}
    about = {"recording": path.name, "master": of.master, **watched}
    return AttributedRun(about, flows, rows["sent"], rows["stopped"] != 0, run)


class QuestionError(MindError):
    """A question that has no answer; the text is for the user."""


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


def answer_text(found: dict[str, Any]) -> RenderableType:
    """An answer, 80 characters wide where names let it."""
    body = _reward_lines(found) if found["kind"] == "reward" else _share_lines(found)
    return Group(_heading(found), "", *body)


def _heading(found: dict[str, Any]) -> Text:
    first, last = found["ticks"]
    seconds = found["seconds_per_tick"]
    when = (
        f"in tick {first:,} ({first * seconds:.2f} s)"
        if first == last
        else f"in ticks {first:,} to {last:,} ({first * seconds:.2f} to {last * seconds:.2f} s)"
    )
    whose = (
        f"{found['recording']}, {found['master']} in charge{robot_words(found)}"
        if "recording" in found
        else f"{found['task']} with {found['master']} in charge, {seed_words(found)}"
    )
    return Text.assemble((found["of"], "bold"), f" {when}\n", (whose, "dim"))


def _reward_lines(found: dict[str, Any]) -> Iterator[Text]:
    rows = [(score(paid, 6), text) for text, paid in found["by_line"].items()]
    rows.append((score(found["score"], 6), "paid in all"))
    width = max(len(number) for number, _ in rows)
    for number, text in rows:
        yield Text(f"{number:>{width}}  {text}", "bold" if text == rows[-1][1] else "")
    if found["by_event"]:
        happened = ", ".join(f"{times} × {name}" for name, times in found["by_event"].items())
        yield Text(f"\nhappened: {happened}", "dim")


def _share_lines(found: dict[str, Any]) -> Iterator[Text]:
    noun, value = ("influence", "sent") if found["kind"] == "skill" else ("share", "command")
    yield Text(f"{noun:>9}   {'of influence':<13}{value:>8}  path", "dim")
    for each in found["paths"]:
        bar = "█" * round(each["part"] * BAR_CHARACTERS)
        yield Text(f"{each['share']:9.4f}  {each['part']:6.1%} {bar:<7}{each['value']:8.4f}  {_path(each['path'])}")
        if each["reads"]:
            line = f"{'':11}read {', '.join(f'{name} {_values(values)}' for name, values in each['reads'].items())}"
            yield Text(shortened(line, LINE_CHARACTERS), "dim")
    for number, text in _others(found):
        yield Text(f"{number:9.4f}  {text}")
    command = f"{'–':>9}" if found["command"] is None else f"{found['command']:9.4f}"
    yield Text(f"{command}  {_total(found)}", "bold")
    for note in _notes(found):
        yield Text(note, "dim")


def _path(names: Sequence[str]) -> str:
    """The skills of a path; of one that is too long for a line the master, and as many of the last as fit."""
    skills = [*names[:-1]] or [*names]
    text = " → ".join(skills)
    for left_out in range(2, len(skills)):
        if len(text) <= LINE_CHARACTERS - PATH_COLUMN:
            break
        text = " → ".join([skills[0], f"{left_out - 1} more", *skills[left_out:]])
    return text


def _values(values: Sequence[float | None]) -> str:
    few = ["no number" if value is None else f"{value:.3g}" for value in values[:MAX_NAMED_READINGS]]
    return " ".join(few) + " …" * (len(values) > MAX_NAMED_READINGS)


def _others(found: dict[str, Any]) -> Iterator[tuple[float, str]]:
    """The parts of a command that no named path has made."""
    rest = found["rest"]
    if many := rest["paths"]:
        paths = "10^15 paths or" if many >= MAX_COUNTED_PATHS else "1 path" if many == 1 else f"{many:,} paths"
        larger = "" if found["are_largest"] else ", of which some may be larger"
        yield rest["share"], f"{rest['part']:6.1%} over {paths} more{larger}"
    if found["undriven"] and found["kind"] == "actuator":
        yield found["neutral"], f"nothing influenced it{_often(found, 'undriven')}: its neutral"
    if abs(found["rounding"]) > GAIN_NOTED:
        yield found["rounding"], "rounding of the engine's sums"


def _total(found: dict[str, Any]) -> str:
    mean = _mean(found)
    if found["kind"] == "memory" and 0 < found["undriven"] < _tick_count(found):
        mean += " where it was sent one"
    if found["kind"] == "skill":
        return f"influence on {found['of']}{mean}"
    return f"command to {found['of']}{mean}; influence {found['influence']:.4g} in all"


def _notes(found: dict[str, Any]) -> Iterator[str]:
    if found["undriven"] and found["kind"] != "actuator":
        nothing = "nothing influenced it" if found["kind"] == "skill" else "nothing drove it"
        yield f"{nothing}{_often(found, 'undriven')}"
    if silent := found["silent"]:
        more = len(silent) - MAX_NAMED_SKILLS
        names = silent if more <= 1 else [*silent[:MAX_NAMED_SKILLS], f"{more:,} more"]
        yield f"sent it nothing: {listed(names, 'and')}"
    for each in found.get("promises", ()):
        by = {"it": each["by_skill"], "those above it": each["by_influence"]}
        judged = in_words(each["held"] + sum(by.values()))
        broken = " and ".join(f"by {who} in {many:,}" for who, many in by.items() if many)
        where = f", first in tick {each['first_broken']:,}" if broken else ""
        told = f"broken {broken} of {judged}{where}" if broken else f"held in {judged}"
        yield f"it {each['promise']}\n  {told}"
    if found["kind"] == "actuator" and abs(found["acted"] - found["command"]) > GAIN_NOTED:
        if "recording" in found:
            why = f": the robot was stopped{_often(found, 'stopped')}" if found["stopped"] else ""
            yield f"what was sent to the guardian is {found['acted']:.4f}{_mean(found)}{why}"
        else:
            yield f"what reached it then is {found['acted']:.4f}{_mean(found)}: its commands act later"


def _often(found: dict[str, Any], what: str) -> str:
    ticks = _tick_count(found)
    return "" if ticks == 1 else f" in {found[what]:,} of {ticks:,} ticks"


def _mean(found: dict[str, Any]) -> str:
    return "" if _tick_count(found) == 1 else ", in the mean"


def _tick_count(found: dict[str, Any]) -> int:
    first, last = found["ticks"]
    return int(last - first + 1)
