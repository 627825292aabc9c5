"""The control loop: sense, think, send, at a fixed rate. Whatever goes wrong in it, the guardian stops the robot."""

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from time import monotonic, sleep

import numpy as np
from numpy.typing import NDArray

from mindrun.engine.changes import ChangedEngine
from mindrun.engine.promises import BY_INFLUENCE, HELD, NOT_JUDGED, PromiseWatcher
from mindrun.graph.recording_header import BY_LOOP, NOT_STOPPED, by_guardian
from mindrun.robot.guardian.client import Guardian
from mindrun.robot.guardian.guard import failing
from mindrun.robot.hand import NO_HAND, Hand, Said
from mindrun.robot.recording import Recorder
from mindrun.robot.sensing import ReadingFilter
from mindrun.robot.servos import ReckonedServo
from mindrun.terminal.tick_count import ticks as in_words

LATENESS_BINS = 400  # of lateness, each a hundredth of a tick
MISSED_TICKS_LIMIT = 3  # ticks in a row that were missed, after which every actuator is neutral until one is not
MAX_THINKING_TICKS = 2  # that thinking may take


@dataclass(slots=True)
class Rate:
    """Ticks at `begin + n·tick`, each with its lateness counted. One that would begin a whole tick late is left out."""

    tick: float
    clock: Callable[[], float] = monotonic
    sleep: Callable[[float], None] = sleep
    ticks: int = 0
    missed: int = 0
    counts: NDArray[np.int64] = field(default_factory=lambda: np.zeros(LATENESS_BINS, np.int64))
    _due: float = 0.0

    def begin(self) -> None:
        """Begin: the first tick is due now."""
        self._due = self.clock()

    def wait(self) -> float:
        """Wait for the next tick; the time when it begins. A tick that is past is missed, not made up for."""
        now = self.clock()
        if now < self._due:
            self.sleep(self._due - now)
            now = self.clock()
        late = now - self._due
        skipped = int(late / self.tick)
        self.missed += skipped
        self.ticks += 1
        self.counts[min(LATENESS_BINS - 1, int(late / self.tick * 100))] += 1
        self._due += (skipped + 1) * self.tick
        return now

    def late(self, share: float) -> float:
        """The lateness, in seconds, that this share of the ticks did not exceed, to a hundredth of a tick."""
        if not self.ticks:
            return 0.0
        place = int(np.searchsorted(np.cumsum(self.counts), share * self.ticks))
        return (min(place, LATENESS_BINS - 1) + 1) * self.tick / 100

    def __str__(self) -> str:
        if not self.ticks:
            return f"no tick of {self.tick * 1e3:.1f} ms"
        half, most = self.late(0.5) * 1e3, self.late(0.99) * 1e3
        kept = f"{in_words(self.ticks)} of {self.tick * 1e3:.1f} ms, {self.missed} missed"
        return f"{kept}; half began within {half:.1f} ms, 99 % within {most:.1f} ms of their time"


@dataclass(slots=True)
class Loop:
    """A mind in charge of a robot. `armed` lets the guardian move it; `tell` gets sentences as they become true.

    It counts the ticks in which it `stopped` the robot because of a fault, those in which the `hand` had let go and
    left it `alone`, and the others in which the guardian `held` it, by the reason. It watches `promises`: of one that
    is broken `tell` gets a sentence, and again once it has held. Where the robot `stops_on_broken`, it is stopped while
    a skill acts against what it requires or maintains. The `servos` turn as they are commanded, and say where they
    look.
    """

    engine: ChangedEngine
    senses: ReadingFilter
    guardian: Guardian
    pace: Rate
    armed: bool = False
    recorder: Recorder | None = None
    tell: Callable[[str], None] = lambda sentence: None
    faulty: set[str] = field(default_factory=set)
    ticks: int = 0
    stopped: int = 0
    held: Counter[str] = field(default_factory=Counter)
    promises: PromiseWatcher | None = None
    stops_on_broken: bool = False
    broken: set[int] = field(default_factory=set)
    servos: Sequence[ReckonedServo] = ()
    hand: Hand = NO_HAND
    alone: int = 0
    let_go: bool = False

    def tick(self) -> None:
        """Wait until a tick is due, and do it; MindError where the mind or the guardian fails."""
        missed = self.pace.missed
        time = self.pace.wait()
        behind = self.pace.missed - missed >= MISSED_TICKS_LIMIT
        for servo in self.servos:
            servo.look(time)
        sensed = self.senses.now(time)
        for name, why in sensed.why.items():
            if name not in self.faulty:
                self.tell(f"{name} {why}")
        for name in self.faulty - sensed.why.keys():
            self.tell(f"{name} is fine again")
        self.faulty = {*sensed.why}
        said = self._said()
        commands = self.engine.tick_with(sensed.readings, self.hand.influence(said))
        too_old = self.pace.clock() - time >= MAX_THINKING_TICKS * self.pace.tick  # to act on what was sensed then
        must_stop = self._broken(self.promises) if self.promises and self.promises.promises else False
        stopped = sensed.must_stop or behind or too_old or must_stop or said is None
        sent = self.neutral if stopped or said is None else self.hand.exchanged(commands, said)
        self.guardian.send(sent.tolist(), self.armed and not stopped)  # unarmed, neutral is not slowed down by slew
        held = self.guardian.holds if self.armed and not stopped else ""  # as it had said when the tick was sent
        for servo in self.servos:
            servo.turn(float(sent[servo.place]) if self.armed and not stopped and not held else None)
        if self.recorder:
            self.recorder.write(
                tick=self.ticks, time=time, stopped=self._stopped_by(stopped, held), armed=self.armed,
                faults=sensed.faults, ages=sensed.ages, readings=self._measured(), influence=self.engine.influence,
                commands=commands, sent=sent,
            )  # fmt: skip
        self.ticks += 1
        self.stopped += stopped and said is not None
        self.alone += said is None
        self.held.update([held] * bool(held))

    def _said(self) -> Said | None:
        """The numbers of the hand in this tick, None where it has let go; telling where that has changed."""
        said = self.hand.now()
        if self.hand.held and (said is None) != self.let_go:
            self.let_go = said is None
            self.tell("nobody drives, and every actuator is at neutral" if self.let_go else "the hand drives")
        return said

    def _broken(self, promises: PromiseWatcher) -> bool:
        """Tell of a promise that is broken in this tick, and again once it has held; True where one stops the robot."""
        judged = promises.feed(self._measured()[None], self.engine.influence[None])[0]
        must_stop = False
        for place, (skill, promise) in enumerate(promises.promises):
            if (verdict := judged[place]) == HELD:
                self.broken.discard(place)
            elif verdict != NOT_JUDGED:
                must_stop |= self.stops_on_broken and promise.word != "achieves"
                if place not in self.broken:
                    by = " by those above it" if verdict == BY_INFLUENCE else ""
                    self.tell(f"{skill} {promise.text}: broken{by}")
                self.broken.add(place)
        return must_stop

    @property
    def neutral(self) -> NDArray[np.float32]:
        """The neutral command of each actuator."""
        return np.array([actuator.kind.neutral for actuator in self.engine.graph.actuators], np.float32)

    def _measured(self) -> NDArray[np.float32]:
        """The readings of the engine, without those that nothing measures."""
        return np.where(self.senses.measured, self.engine.readings, np.float32(np.nan))

    def _stopped_by(self, stopped: bool, held: str) -> int:
        if held:
            return by_guardian(failing(held, [actuator.name for actuator in self.engine.graph.actuators]))
        return BY_LOOP if stopped else NOT_STOPPED
