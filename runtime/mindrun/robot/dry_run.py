"""A dry run: a robot that is wired to a simulated world; in words, how it begins, stands and ends; and recorded."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from math import isfinite
from threading import Event, Thread
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mindrun.driver import DeviceError
from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Task
from mindrun.graph.named_readings import kept_rows, physical
from mindrun.graph.recording_header import BOX_COLUMNS, GOES_ON, RecordedWorld, world_row_of
from mindrun.graph.skill_sets import driving, movers
from mindrun.graph.wiring import ActuatorWire, SensorWire, Wiring, read_by
from mindrun.robot.drivers.simulated import SimulatedActuator, SimulatedSensor
from mindrun.robot.loop import Loop
from mindrun.robot.simulated_world import BOXES, WORLD, WRITE, WorldConnection, status
from mindrun.terminal.standard_streams import StatusLine
from mindrun.terminal.tick_count import ticks as in_words

SHOW_SECONDS = 0.25  # from one state of the line to the next
MAX_SILENT_QUESTIONS = 8  # in a row, after which the world is gone
MAX_THINGS_NAMED = 6
MAX_END_TICKS = 20  # in which a recording gets the end of its run; one that cannot be written gets none
MAX_ACTING_NAMED, LEAST_ACTING_INFLUENCE = 2, 0.01


def simulated_wiring(graph: Graph, path: str, master: str) -> Wiring:
    """A robot whose actuators, and the sensors that are read below the master, are those of the world at a socket.

    Each sensor is read twice a tick, so that what the loop sees is never much more than half a tick older than in
    training.
    """
    read = read_by(graph, master)
    rate = min(max(2 / graph.tick, 0.01), 1000.0)
    max_age = min(max(0.25, 5 * graph.tick), 3600.0)  # a computer that simulates has other things to do, too
    return Wiring(
        robot="simulated",
        sensors=tuple(
            SensorWire(name, SimulatedSensor(path, name, sensor.width), 0.0, 1.0, rate=rate, max_age=max_age)
            for name, sensor in physical(graph).items()
            if name in read
        ),
        actuators=tuple(
            ActuatorWire(actuator.name, SimulatedActuator(path, actuator.name)) for actuator in graph.actuators
        ),
    )


def beginning(graph: Graph, task: Task, master: str, seed: int) -> list[str]:
    """Sentences before a run: what is run, in which world, that nothing real moves, and what ends it.

    MindError where no world of the task can be simulated beside the robot.
    """
    if name := task.scene.environment:
        said = f"there is no dry run of {task.name}, which is in the environment {name}"
        raise MindError(said, "mindc run and mindc view step it, from the source of this bundle")
    scene, seconds = task.scene, task.ticks * graph.tick
    size = f"of {' x '.join(f'{side:g}' for side in scene.sides)}" if scene.is_bounded else "without walls"
    things = list(dict.fromkeys(thing.name for thing in task.things))
    if (more := len(things) - MAX_THINGS_NAMED) > 0:
        things[MAX_THINGS_NAMED:] = [f"{more} more"]
    contents = f" with {', '.join(things)}" if things else ""
    return [
        f"dry run: {task.name} with {master} in charge, in a world {size}{contents}, seed {seed}",
        "no device is touched: the world is simulated, in real time",
        f"it ends with its run, after {in_words(task.ticks)} ({seconds:,.0f} s) at the latest; Ctrl-C ends it now",
    ]


class DryRun:
    """Says on a status line how a run in the world at a socket stands, and tells the world the mind's memories.

    With the `seed` of that world it has its state for a recording: `about` as it was first, `latest` as a tick ago. The
    loop only leaves influence and readings of its last tick here: it waits neither for the world nor for a terminal,
    which threads do.
    """

    def __init__(
        self, graph: Graph, task: Task, master: str, socket: str, line: StatusLine, seed: int | None = None
    ) -> None:
        self._graph, self._task, self._socket, self._line = graph, task, socket, line
        self._acting_skills = movers(graph, master) or driving(graph, master, range(len(graph.actuators)))
        self._influence: NDArray[np.float32] | None = None
        self._readings = np.zeros(graph.width, np.float32)
        self._is_over, self._end_ticks = False, 0
        self._lost: DeviceError | None = None
        self._stop, self._ticked = Event(), Event()
        self._link, self._row = WorldConnection(socket), world_row_of(task)
        self.about: RecordedWorld | None = None
        if seed is not None:
            self._latest = self._recorded = self._asked()
            boxes = np.frombuffer(self._link.ask(BOXES), "<f8").reshape(-1, BOX_COLUMNS)
            begin = [*self._latest["pose"][0], *self._latest["things"][0].ravel()]
            self.about = RecordedWorld.of(task, seed, boxes, begin)

    def watch(self, loop: Loop) -> bool:
        """True if, after a tick, the run goes on or its recording waits for its end; DeviceError without a world."""
        self._influence, self._readings = loop.engine.influence, loop.engine.readings
        self._ticked.set()
        if self._lost:
            raise self._lost
        if not self._is_over:
            return True
        self._end_ticks += 1
        return self.about is not None and not self.has_ended and self._end_ticks <= MAX_END_TICKS

    def latest(self) -> NDArray[Any]:
        """The row of the world [1] that was asked for when the loop had done its last tick. Never waits."""
        self._recorded = self._latest
        return self._recorded

    @property
    def has_ended(self) -> bool:
        """True if the row that `latest` returned last says how the run has ended."""
        return bool(self._recorded["ended"][0] != GOES_ON)

    @contextmanager
    def shown(self) -> Iterator[None]:
        """Show how the run stands, and follow it, as long as this lasts."""
        threads = [Thread(target=each, name="dry_run", daemon=True) for each in (self._show, self._follow)]
        for thread in threads:
            thread.start()
        try:
            yield
        finally:
            self._stop.set()
            self._ticked.set()
            for thread in threads:
                thread.join()
            self._link.close()
            self._line.clear()

    def _follow(self) -> None:
        """After each tick tell the world which memories have changed, for its rewards and ends, and ask how it is."""
        told, rows = dict[str, float](), kept_rows(self._graph)
        while (self._graph.memories or self.about) and self._ticked.wait() and not self._stop.is_set():
            self._ticked.clear()
            now = self._readings
            for name, value in ((name, float(now[row])) for name, row in rows.items()):
                if told.get(name) != value:
                    with suppress(DeviceError):  # next time
                        self._link.ask(WRITE, name, value)
                        told[name] = value
            if self.about:
                with suppress(DeviceError):  # it answers next time; the loop says where it does not at all
                    self._latest = self._asked()

    def _asked(self) -> NDArray[Any]:
        held = self._link.ask(WORLD)
        if len(held) != self._row.itemsize:
            raise DeviceError(f"the simulated world has {len(held)} bytes to be recorded, not {self._row.itemsize}")
        return np.frombuffer(held, self._row)

    def _show(self) -> None:
        silent = 0
        while not self._stop.wait(SHOW_SECONDS):
            try:
                run = status(self._socket)
            except DeviceError as error:  # most often it answers next time
                silent += 1
                self._lost = error if silent >= MAX_SILENT_QUESTIONS else None
                continue
            silent, self._lost = 0, None
            self._line.show(self.state(run))
            self._is_over = bool(run["ended"])

    def state(self, run: Mapping[str, Any]) -> str:
        """The line for the status of a world: time, who acts, what has happened and been paid, and the commands.

        What matters less comes last, where a narrow terminal cuts.
        """
        parts = [
            f"{run['tick'] * self._graph.tick:.1f} s, tick {run['tick']:,} of {self._task.ticks:,}",
            self._acting(),
            *(f"{times} × {event}" for event, times in run["events"].items() if times),
            f"score {run['score']:,.2f}",
            *(f"{name} {value:.2f}" for name, value in run["commands"].items()),
        ]
        return "  ".join(part for part in parts if part)

    def _acting(self) -> str:
        """The skills with the most influence of those that move the robot, or drive anything where none does."""
        if self._influence is None:
            return ""
        influence = [(float(self._influence[index]), name) for name, index in self._acting_skills.items()]
        strongest = sorted(influence, key=lambda each: -each[0])
        acting = [f"{name} {value:.2f}" for value, name in strongest if value >= LEAST_ACTING_INFLUENCE]
        return ", ".join(acting[:MAX_ACTING_NAMED]) or "nobody acts"


def outcome(task: Task, master: str, run: Mapping[str, Any]) -> list[str]:
    """Lines after a run, as `mindc run` prints them: how it ended, what it counted, what each reward line paid."""
    facts = [("seed", str(run["seed"]))]
    for number, (event, times) in enumerate(run["events"].items()):
        facts.append(("" if number else "events", f"{times} × {event}"))
    facts.append(("ticks", f"{run['tick']:,} of {task.ticks:,}, {_ending(run['ended'])}"))
    paid = [
        (f"{value:,.2f}" if isfinite(value) else "not a number", text)
        for text, value in [*run["by_line"].items(), ("score", run["score"])]
    ]
    return [f"{task.name} with {master} in charge", *_aligned(facts), "", *_aligned(paid)]


def _ending(ended: str | None) -> str:
    match ended:
        case None:
            return "ended before it was over"
        case "time":
            return "lasted its time"
        case event if event.startswith("success: "):
            return f"ended by {event.removeprefix('success: ')}, a success"
        case event:
            return f"ended by {event}"


def _aligned(rows: Sequence[tuple[str, str]]) -> list[str]:
    """A line per row, the first column to the right."""
    width = max(len(first) for first, _ in rows)
    return [f"{first:>{width}}  {second}" for first, second in rows]
