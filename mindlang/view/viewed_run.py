"""A simulated run that is seen while it is made: with changes by which a viewer forks it, or driven by a hand."""

import secrets
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain, count
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.engine.changes import Change, ChangedEngine, What
from mindrun.engine.engine import procedure_sources
from mindrun.errors import system_errors_as
from mindrun.graph.bundle import Bundle
from mindrun.graph.draws import drawn_in_words, drawn_numbers
from mindrun.graph.graph import Graph, Task
from mindrun.graph.named_readings import kept_rows, reading_names
from mindrun.graph.recording_header import About, RecordedWorld, RecordingError
from mindrun.robot.hand import Hand, Said
from mindrun.robot.recording import Recorder
from mindrun.sim.commanded_lanes import CommandedWorld
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import Trace, trace
from mindrun.terminal.tick_count import ticks as in_words
from numpy.typing import NDArray

from mindlang.breakpoints.breakpoint import Breakpoint
from mindlang.breakpoints.watch import RowBlock, watcher
from mindlang.run.outcome import run_names, seed_words
from mindlang.run.recording import about_of, bundle_without_robot, recorded_rows, world_of
from mindlang.run.setup import RunSetup
from mindlang.view import messages
from mindlang.view.about import Texts
from mindlang.view.messages import RefusedError, shown
from mindlang.view.rows import Columns
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_rows import RUN, Filled, Watch, viewed_rows

GROUPS: dict[What, str] = {"reading": "readings", "influence": "influence", "memory": "readings"}
DRIVEN = "driven"  # the source of a run that a hand drives
LOOK_SECONDS = 0.02  # from one look at the hand and the clock to the next, in which all ticks are made that are due
MAX_BEHIND_SECONDS = 0.5  # time that was missed beyond this is not made up for
Rows = NDArray[Any]


@dataclass(frozen=True, slots=True)
class ViewedRun:
    """A run to be seen: `texts` are what its edges say, `breakpoints` are of a setup that notices their events."""

    setup: RunSetup
    rollout: Rollout
    seed: int
    texts: Texts
    breakpoints: Sequence[Breakpoint] = ()
    changes: tuple[Change, ...] = ()

    def begun(self) -> Viewed:
        """The run that the rollout makes of the seed, with the changes."""
        setup, task, policy = self.setup, self.setup.task, self.setup.ready.policy
        run = trace(self.rollout, self.seed, changes=self.changes, robot=setup.robot)
        world = world_of(setup, self.seed, run.boxes, run.begin, run.things, run.turned)
        of = replace(About.of(policy.graph, "", setup.master, ()), world=world)
        mind = Bundle(policy, procedure_sources(policy.graph, setup.folder, setup.master))
        names = run_names(task, setup.master, self.seed, setup.robot)
        title = f"{task.name} with {setup.master} in charge, {seed_words(names)}"
        rows, watch = _rows(run, of, len(task.events)), self._watch()
        viewed = viewed_rows(title, RUN, of, mind, task, setup.folder, rows, task.ticks, watch, self.texts)
        viewed.forked, viewed.watched = partial(self._forked, viewed.columns), self._watched
        return viewed

    def _watched(self, robot: int) -> Viewed:
        """The run seen through another robot, as far as its beginning; SetupError where there is no such robot."""
        viewed = replace(self, setup=self.setup.watching(robot), changes=()).begun()
        viewed.grow()
        return viewed

    def _watch(self) -> Watch | None:
        if not self.breakpoints:
            return None
        watching, drawn = watcher(self.breakpoints, self.setup), drawn_numbers(self.setup.task.draws, self.seed)
        return lambda rows, readings: watching.feed(
            RowBlock(readings, rows["influence"], rows["commands"], rows["world"]["events"].astype(np.int64), drawn)
        )

    def _forked(self, columns: Columns, asked: messages.AskChange) -> tuple[Viewed, str]:
        graph = self.setup.ready.policy.graph
        change = _replacement(graph, self.setup.task, columns, asked)
        beside = replace(self, changes=(*self.changes, change), breakpoints=())  # the page pauses where the run does
        viewed = beside.begun()
        viewed.grow()
        is_influence = change.what == "influence"
        name = graph.skills[change.row].name if is_influence else reading_names(graph)[change.row]
        what = f"the influence of {name} is" if is_influence else f"{name} is"
        ticks = f"tick {change.first}" if change.first == change.last else f"ticks {change.first} to {change.last}"
        return viewed, shown(f"{what} {change.values[0]:g} in {ticks}")


def _rows(run: Trace, of: About, events: int) -> Iterator[Filled]:
    """A run as it is made; what ended it stands in its last row."""
    number, times = 0, np.zeros(events, np.int64)  # how often each event has happened
    for ticks in run.chunks:
        so_far = times + np.cumsum(ticks.events, axis=0)
        rows = recorded_rows(of, number + 1, ticks, so_far)
        if run.jobs.lanes[0] == 0:
            rows["world"]["ended"][-1] = run.jobs.ended[0]
        number, times = number + len(rows), so_far[-1]
        yield rows, rows["readings"]


def _replacement(graph: Graph, task: Task, columns: Columns, asked: messages.AskChange) -> Change:
    """The change that was asked for; RefusedError where there is no such value, or no such tick."""
    what, (block, index) = asked.what, asked.column
    group = columns[GROUPS[what]]
    row = index - group.first
    sensed = sum(sensor.width for sensor in graph.sensors)
    first, last = {"reading": (0, sensed), "influence": (0, group.count), "memory": (sensed, group.count)}[what]
    if block != group.block or not first <= row < last:
        raise RefusedError(f"column {index} of block {block} has no {what}")
    if asked.tick > task.ticks:
        raise RefusedError(f"tick is a whole number from 1 to {task.ticks}")
    return Change(what, row, (asked.value,), asked.tick, asked.tick + asked.lasts - 1)


class DrivenRun:
    """A world of a setup's task and a seed, and the mind beside the hand, tick by tick. Its rows are a recording's."""

    def __init__(self, setup: RunSetup, hand: Hand, seed: int) -> None:
        policy = setup.ready.policy
        self.mind = bundle_without_robot(setup.ready, setup.folder)
        self.engine = ChangedEngine(policy, setup.folder, setup.master)
        self.world = CommandedWorld(policy.graph, setup.task.name, seed, setup.master)
        self.hand, self.ticks = hand, 0
        columns = self.world.columns()
        begin = [*columns["pose"], *columns["things"].ravel()]
        world = RecordedWorld.of(setup.task, seed, self.world.boxes, begin)
        self.about = about_of(setup, self.mind, world, hand.names)

    def tick(self, said: Said) -> Rows:
        """Make a tick with these numbers of the hand; its row [1]."""
        engine, row = self.engine, np.zeros(1, self.about.row)
        commands = engine.tick_with(self.world.readings(), self.hand.influence(said))
        sent = self.hand.exchanged(commands, said)
        self.world.remember({name: float(engine.readings[row]) for name, row in kept_rows(engine.graph).items()})
        self.world.step(sent)
        row["tick"], row["time"] = self.ticks, (self.ticks + 1) * self.about.tick
        row["armed"], row["ages"] = 1, np.nan  # what is simulated has no age
        row["readings"], row["influence"] = engine.readings, engine.influence
        row["commands"], row["sent"] = commands, sent
        for name, value in self.world.columns().items():
            row["world"][name][0] = value
        self.ticks += 1
        return row


class DrivenRuns:
    """Runs that a hand drives one after the other, each of a seed, and recorded where there is a `record`.

    A recording begins with the first tick, and none is written over: the next has a number, `drive-2.rec`. `tell` gets
    a sentence when one is complete.
    """

    def __init__(
        self,
        setup: RunSetup,
        hand: Hand,
        texts: Texts,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        record: Path | None = None,
        tell: Callable[[str], None] = lambda sentence: None,
    ) -> None:
        self._setup, self._hand, self._texts, self._record, self._tell = setup, hand, texts, record, tell
        self._clock, self._sleep = clock, sleep
        self._run: DrivenRun | None = None
        self._recorder: Recorder | None = None
        self._path = Path()

    def begun(self, seed: int | None) -> Viewed:
        """The run of a seed, by default a drawn one, in the place of the one before it."""
        self.close()
        seed = secrets.randbits(31) if seed is None else seed
        task, folder = self._setup.task, self._setup.folder
        self._run = run = DrivenRun(self._setup, self._hand, seed)
        title = f"{task.name} by hand, seed {seed}{drawn_in_words(drawn_numbers(task.draws, seed))}"
        viewed = viewed_rows(title, DRIVEN, run.about, run.mind, task, folder, self._rows(run), None, texts=self._texts)
        viewed.hand, viewed.anew = self._hand, self.begun
        return viewed

    def close(self) -> None:
        """End the run, and bring what is recorded of it to the disk."""
        run, self._run = self._run, None
        if run and self._recorder:
            self._recorder.close()
            self._tell(f"{self._path}: {in_words(run.ticks)}")
        self._recorder = None

    def _rows(self, run: DrivenRun) -> Iterator[Filled]:
        """The ticks of a run in real time, as long as the hand holds it; no rows where it has let go."""
        due: float | None = None
        while self._run is run and run.world.ended is None:
            now, said, made = self._clock(), self._hand.now(), [np.zeros(0, run.about.row)]
            due = None if said is None else now if due is None or now - due > MAX_BEHIND_SECONDS else due
            while said is not None and due is not None and due <= now and run.world.ended is None:
                made.append(run.tick(said))
                self._write(run, made[-1][0])
                due += run.about.tick
            rows = np.concatenate(made)
            yield rows, rows["readings"]
            self._sleep(LOOK_SECONDS)
        if self._run is run:
            self.close()

    def _write(self, run: DrivenRun, row: Any) -> None:
        """Write a row, the first one into a new file; RecordingError where that cannot be."""
        if self._record is None:
            return
        if self._recorder is None:
            numbered = (self._record.with_stem(f"{self._record.stem}-{number}") for number in count(2))
            self._path = next(path for path in chain([self._record], numbered) if not path.exists())
            with system_errors_as(RecordingError, f"{self._path} cannot be written"):
                self._recorder = Recorder(self._path, run.about)
        self._recorder.write(**{name: row[name] for name in run.about.row.names or ()})
