"""A run that a hand drives while it is seen: a simulated world in real time, which stands still where it lets go."""

import secrets
from collections.abc import Callable, Iterator
from dataclasses import replace
from hashlib import sha256
from itertools import chain, count
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.engine.changes import ChangedEngine
from mindrun.errors import system_errors_as
from mindrun.graph.bundle import pack
from mindrun.graph.draws import drawn_in_words, drawn_numbers
from mindrun.graph.named_readings import kept_rows, physical
from mindrun.graph.recording_header import About, RecordedWorld, RecordingError
from mindrun.graph.wiring import read_by
from mindrun.robot.hand import Hand, Said
from mindrun.robot.recording import Recorder
from mindrun.sim.commanded_lanes import CommandedWorld
from mindrun.terminal.tick_count import ticks as in_words
from numpy.typing import NDArray

from mindlang.run.recording import bundle_without_robot
from mindlang.run.setup import RunSetup
from mindlang.view.about import Texts
from mindlang.view.viewed import Viewed
from mindlang.view.viewed_rows import Filled, viewed_rows

DRIVEN = "driven"  # the source of such a run
LOOK_SECONDS = 0.02  # from one look at the hand and the clock to the next, in which all ticks are made that are due
MAX_BEHIND_SECONDS = 0.5  # time that was missed beyond this is not made up for
Rows = NDArray[Any]


class DrivenRun:
    """A world of a setup's task and a seed, and the mind beside the hand, tick by tick. Its rows are a recording's."""

    def __init__(self, setup: RunSetup, hand: Hand, seed: int) -> None:
        policy = setup.ready.policy
        self.mind = bundle_without_robot(setup.ready, setup.folder)
        self.engine = ChangedEngine(policy, setup.folder, setup.master)
        self.world = CommandedWorld(policy.graph, setup.task.name, seed, setup.master)
        self.hand, self.ticks = hand, 0
        read, columns = read_by(policy.graph, setup.master), self.world.columns()
        about = About.of(
            policy.graph,
            sha256(pack(self.mind)).hexdigest(),
            setup.master,
            [name for name in physical(policy.graph) if name in read],
        )
        begin = [*columns["pose"], *columns["things"].ravel()]
        world = RecordedWorld.of(setup.task, seed, self.world.boxes, begin)
        self.about = replace(about, world=world, by_hand=hand.names)

    def tick(self, said: Said) -> Rows:
        """Make a tick with these numbers of the hand; its row [1]."""
        engine, row = self.engine, np.zeros(1, self.about.row)
        commands = engine.tick_with(self.world.readings(), self.hand.influence(said))
        sent = self.hand.exchanged(commands, said)
        self.world.remember({name: float(engine.readings[row]) for name, row in kept_rows(engine.graph).items()})
        self.world.step(sent)
        row["tick"], row["time"] = self.ticks, (self.ticks + 1) * self.about.tick
        row["armed"], row["ages"] = 1, np.nan  # what is simulated has no age
        row["readings"], row["influence"], row["commands"], row["sent"] = (
            engine.readings,
            engine.influence,
            commands,
            sent,
        )
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
