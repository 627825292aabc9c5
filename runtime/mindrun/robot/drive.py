"""A bundle in charge of its robot: opened, run until somebody says stop, and brought to neutral whatever happens."""

import os
import socket
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from time import monotonic, sleep

import mindrun.robot.drivers  # noqa: F401  every driver is known once this is imported
from mindrun.engine.engine import Engine
from mindrun.errors import MindError
from mindrun.graph.bundle import Bundle
from mindrun.graph.wiring import Wiring, read_by
from mindrun.robot.dry_run import SeenWorld
from mindrun.robot.guardian.client import Guardian
from mindrun.robot.guardian.plan import plan_of
from mindrun.robot.loop import Loop, TickResult
from mindrun.robot.processes import Stop, refuse_success, stopping
from mindrun.robot.rate import Rate
from mindrun.robot.recording import About, Recorder, TemporaryRecorder
from mindrun.robot.sensing import ReadingFilter, Sampler

FIRST_READING_SECONDS = 10.0  # for every sensor to have been measured once
STOP_SECONDS = 2.0  # or ticks where these are longer, in which a tick has to end once a signal has come
CLOSE_SECONDS = 1.0  # for all sensors to be closed


class DriveError(MindError):
    """A robot that cannot be driven with this bundle."""


@dataclass(frozen=True, slots=True)
class DriveOptions:
    """What is asked for: whether anything may move, where to record to, after how many ticks to end (0: never).

    `master` is another skill than the mind's own to be in charge. `view` is entered for as long as there is a
    recording, of which it can read each tick at once; `world` is that of a dry run, to be recorded. The robot stops
    where a recording that `is_kept` cannot be written; one that is not is given up.
    """

    armed: bool = False
    record: Path | None = None
    ticks: int = 0
    master: str | None = None
    view: AbstractContextManager[None] | None = None
    world: SeenWorld | None = None
    is_kept: bool = True


def drive(
    bundle: Bundle,
    digest: str,
    wiring: Wiring,
    options: DriveOptions,
    tell: Callable[[str], None],
    held: Sequence[int] = (),
    watch: Callable[[Loop], bool] = lambda loop: True,
) -> Loop:
    """Run a mind on a robot until a signal comes or the ticks are over; the loop as it ended.

    `tell` gets sentences for people; the guardian inherits the descriptors `held`; `watch` sees the loop after each
    tick, and says whether it goes on. MindError where something fails; then every actuator is at neutral, too.
    """
    graph, master = bundle.graph, options.master or bundle.graph.master
    engine = Engine(bundle.policy, bundle.procedures, options.master)
    if missing := read_by(graph, master) - {wire.sensor for wire in wiring.sensors}:
        raise DriveError(f"{master} reads {', '.join(sorted(missing))}, which is not wired", "add it to robot.yaml")
    neutrals = {actuator.name: actuator.kind.neutral for actuator in graph.actuators}
    with ExitStack() as stack:
        stop = stack.enter_context(stopping(STOP_SECONDS * max(1.0, graph.tick)))
        about = About.of(graph, digest, master, tuple(wire.sensor for wire in wiring.sensors))
        recorder = stack.enter_context(_recorder(options, about, tell))
        stack.enter_context(options.view or nullcontext())
        stack.enter_context(refuse_success("; every actuator comes to neutral"))
        samplers = stack.enter_context(_sampling(wiring))
        guardian = stack.enter_context(Guardian(plan_of(graph.tick, neutrals, wiring), inherited=held))
        loop = Loop(engine, ReadingFilter(graph, samplers), guardian, Rate(graph.tick), options.armed, recorder, tell)
        _wait(samplers, guardian, loop, stop)
        notify("READY=1")
        try:
            if not stop:
                loop.run(lambda tick: _goes_on(tick, options.ticks, stop) and watch(loop))
        finally:
            stop.in_order()
        return loop


def _recorder(
    options: DriveOptions, about: About, tell: Callable[[str], None]
) -> AbstractContextManager[Recorder | None]:
    """The recorder that is wished for; DriveError where it would write over something, or cannot write."""
    path, world, latest = options.record, options.world, None
    if path is None:
        return nullcontext()
    if world is not None:
        about, latest = replace(about, world=world.about), world.latest
    try:
        if not options.is_kept:
            return TemporaryRecorder(path, about, tell, world=latest)
        return Recorder(path, about, world=latest)
    except FileExistsError:
        raise DriveError(f"{path} exists already", "record to another file, or delete it") from None
    except OSError as error:
        raise DriveError(f"{path} cannot be written: {error.strerror}") from error


def _goes_on(tick: TickResult, ticks: int, stop: Stop) -> bool:
    notify("WATCHDOG=1")
    stop.hear()
    return not stop and (not ticks or tick.number + 1 < ticks)


def _wait(samplers: list[Sampler], guardian: Guardian, loop: Loop, stop: Stop) -> None:
    """Until every sensor has been measured once, or for some seconds; the guardian hears all the while, unarmed."""
    until = monotonic() + FIRST_READING_SECONDS
    while monotonic() < until and not stop and not all(sampler.latest for sampler in samplers):
        guardian.send(loop.neutral.tolist(), False)
        sleep(loop.pace.tick)


@contextmanager
def _sampling(wiring: Wiring) -> Iterator[list[Sampler]]:
    samplers = [Sampler(wire) for wire in wiring.sensors]
    for sampler in samplers:
        sampler.start()
    try:
        yield samplers
    finally:
        until = monotonic() + CLOSE_SECONDS
        for sampler in samplers:
            sampler.stop(0.0)
        for sampler in samplers:  # together: each may hang
            sampler.stop(max(0.0, until - monotonic()))


def notify(state: str) -> None:
    """Tell systemd "READY=1", "WATCHDOG=1" or "STOPPING=1"; nothing happens where it is not the one who started us."""
    address = os.environ.get("NOTIFY_SOCKET", "")
    if not address:
        return
    if address.startswith("@"):
        address = f"\0{address[1:]}"
    with suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM | socket.SOCK_CLOEXEC) as manager:
        manager.setblocking(False)
        manager.sendto(state.encode(), address)
