"""`mindrun FILE.bundle` on a robot, or with --dry in a simulated world.

A bundle in charge of its robot: opened, run until somebody says stop, and brought to neutral whatever happens.
"""

import argparse
import os
import socket
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from time import monotonic, sleep

from mindrun.driver import DeviceError
from mindrun.engine.changes import ChangedEngine
from mindrun.engine.promises import PromiseWatcher
from mindrun.errors import MindError
from mindrun.graph.bundle import Bundle, digest
from mindrun.graph.graph import Graph, Task
from mindrun.graph.measured import measured_in_world
from mindrun.graph.tasks import default_task
from mindrun.graph.wiring import Wiring, known_sensors, read_by, reckoned, still
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.dry_run import DryRun, beginning, outcome, simulated_wiring
from mindrun.robot.guardian.client import Guardian
from mindrun.robot.guardian.plan import plan_of
from mindrun.robot.hand import NO_HAND, Hand, hand_on
from mindrun.robot.keys import can_drive_by_keys
from mindrun.robot.live_view import breakpoint_mistakes, live_view
from mindrun.robot.loop import Loop, Rate
from mindrun.robot.orders import Orders, with_orders
from mindrun.robot.ownership import hold_devices, is_adopted
from mindrun.robot.processes import refuse_success, stopping
from mindrun.robot.recording import About, Recorder, TemporaryRecorder
from mindrun.robot.sensing import ReadingFilter, Sampler
from mindrun.robot.servos import reckoned_servos
from mindrun.robot.simulated_world import simulated, status
from mindrun.terminal.command_line import command_line
from mindrun.terminal.standard_streams import StatusLine

FIRST_READING_SECONDS = 10.0  # for every sensor to have been measured once
STOP_SECONDS = 2.0  # or ticks where these are longer, in which a tick has to end once a signal has come
CLOSE_SECONDS = 1.0  # for all sensors to be closed


def run(options: argparse.Namespace, bundle: Bundle) -> int:
    """Drive until a signal comes; the exit code. A bundle without wiring can be driven dry alone."""
    line = StatusLine(lambda sentence: None, columns=lambda: None) if options.quiet else StatusLine(_print_error)
    _refuse_wrong_breakpoints(options, bundle.graph)
    wired = bundle.wiring.sensors if bundle.wiring and not options.dry else ()
    hand = hand_on(bundle.graph, options.master or bundle.graph.master, options.drive)
    orders = Orders(bundle.graph, [wire.sensor for wire in wired], hand=hand)
    for said in options.order:
        orders.say(said)
    if not options.arm:
        line.tell("nothing will move: --arm lets it")
    with orders.heard(line.tell, bool(hand.held) and not options.view and can_drive_by_keys()):
        loop = (_dry if options.dry else _wired)(options, bundle, line, orders)
    line.tell(_summary(loop))
    return 0


def _refuse_wrong_breakpoints(options: argparse.Namespace, graph: Graph) -> None:
    """MindError where a line of the file of --break is wrong, before anything moves; the mistakes have been printed."""
    if options.breaks is None:
        return
    task = _task(graph, options.task)[0].name if options.dry else None
    if found := breakpoint_mistakes(options.breaks, options.bundle, task, options.master):
        for sentence in found:
            _print_error(sentence)
        raise MindError("nothing moves: the page cannot pause where that file says", "mend it, or leave --break out")


def _wired(options: argparse.Namespace, bundle: Bundle, line: StatusLine, orders: Orders) -> Loop:
    wiring = bundle.wiring
    assert wiring
    if not is_adopted(wiring, bundle.graph):
        remedy = f"if it is wired as this bundle has it: {command_line('mindrun', 'adopt', options.bundle)}"
        if options.arm:
            raise MindError("nothing may move yet: this robot has not said how it is wired", remedy)
        line.tell("this robot has not said how it is wired: no actuator is opened")
        wiring = replace(wiring, actuators=tuple(replace(wire, driver=MockActuator()) for wire in wiring.actuators))
    if not options.arm:
        wiring = replace(wiring, sensors=tuple(map(still, wiring.sensors)))
    for sensor, servo in reckoned(wiring, bundle.graph).items():
        line.tell(f"{sensor} is reckoned from what {servo} is sent")
    with hold_devices(wiring) as held:
        wiring = with_orders(wiring, bundle.graph, bundle.graph.sensors, orders)
        return drive(bundle, wiring, options, line.tell, held, hand=orders.hand)


def _dry(options: argparse.Namespace, bundle: Bundle, line: StatusLine, orders: Orders) -> Loop:
    task, why = _task(bundle.graph, options.task)
    master = options.master or bundle.graph.master
    begins = beginning(bundle.graph, task, master, options.seed)
    for sentence in (*filter(None, [why]), *begins):
        line.tell(sentence)
    with simulated(options.bundle, task.name, options.seed, options.master or "") as socket:
        seed = options.seed if options.record or options.view else None
        run = DryRun(bundle.graph, task, master, socket, line, seed)
        measured, wiring = measured_in_world(bundle.graph, master, task), simulated_wiring(bundle.graph, socket, master)
        wiring = with_orders(wiring, bundle.graph, measured, orders, socket)
        with run.shown():
            loop = drive(bundle, wiring, options, line.tell, watch=run.watch, world=run, hand=orders.hand)
        with suppress(DeviceError):  # the run was as good without it
            for sentence in outcome(task, master, status(socket)):
                line.tell(sentence)
        return loop


def _task(graph: Graph, name: str | None) -> tuple[Task, str]:
    """The task of that name, or the default one, and why it is that one where this needs saying."""
    if not graph.tasks:
        raise MindError(
            "this mind has no task, and so no world to be simulated in", "add one: task Play in arena size 40"
        )
    if name is None:
        return default_task(graph)
    tasks = {task.name: task for task in graph.tasks}
    if name not in tasks:
        raise MindError(f"this mind has no task {name or 'without a name'}", f"it has {', '.join(tasks)}")
    return tasks[name], ""


def _summary(loop: Loop) -> str:
    faults = f", {loop.engine.faults} outputs not sent because a number was not finite" if loop.engine.faults else ""
    held = "; ".join(f"{count}: {why}" for why, count in loop.held.items())
    by_guardian = f", {loop.held.total()} because of the guardian ({held})" if held else ""
    by_nobody = f", {loop.alone} because nobody drove" if loop.alone else ""
    return f"{loop.pace}; {loop.stopped} at neutral because of a fault{by_nobody}{by_guardian}{faults}"


def _print_error(sentence: str) -> None:
    print(sentence, file=sys.stderr, flush=True)


def drive(
    bundle: Bundle, wiring: Wiring, options: argparse.Namespace, tell: Callable[[str], None], held: Sequence[int] = (),
    watch: Callable[[Loop], bool] = lambda loop: True, world: DryRun | None = None, hand: Hand = NO_HAND,
) -> Loop:  # fmt: skip
    """Run a mind on a robot until a signal comes or the ticks are over; the loop as it ended.

    `tell` gets sentences; the guardian inherits the descriptors `held`; `watch` sees the loop after each tick, and says
    whether it goes on; `world` is that of a dry run. Where MindError is raised all is at neutral, too.
    """
    graph, master = bundle.graph, options.master or bundle.graph.master
    engine = ChangedEngine(bundle.policy, bundle.procedures, options.master)
    sensors = known_sensors(wiring, graph)
    if missing := read_by(graph, master) - {*sensors}:
        raise MindError(f"{master} reads {', '.join(sorted(missing))}, which is not wired", "add it to robot.yaml")
    plan = plan_of(graph.tick, {actuator.name: actuator.kind.neutral for actuator in graph.actuators}, wiring)
    servos = reckoned_servos(wiring, graph, plan)
    with ExitStack() as stack:
        stop = stack.enter_context(stopping(STOP_SECONDS * max(1.0, graph.tick)))
        about = replace(About.of(graph, digest(options.bundle), master, sensors), by_hand=hand.names)
        recorder = stack.enter_context(_recording(options, about, world, tell))
        stack.enter_context(refuse_success("; every actuator comes to neutral"))
        samplers = stack.enter_context(_sampling(wiring))
        guardian = stack.enter_context(Guardian(plan, inherited=held))
        senses = ReadingFilter(graph, sorted((*samplers, *servos), key=lambda each: sensors.index(each.wire.sensor)))
        loop = Loop(
            engine, senses, guardian, Rate(graph.tick), options.arm, recorder, tell, servos=servos, hand=hand,
            promises=PromiseWatcher(graph, master), stops_on_broken=wiring.on_broken == "neutral",
        )  # fmt: skip
        until = monotonic() + FIRST_READING_SECONDS
        while monotonic() < until and not stop and not all(sampler.latest for sampler in samplers):
            guardian.send(loop.neutral.tolist(), False)
            sleep(loop.pace.tick)
        notify("READY=1")
        stack.callback(stop.in_order)
        loop.pace.begin()
        while not stop and (not options.ticks or loop.ticks < options.ticks) and (not loop.ticks or watch(loop)):
            loop.tick()
            notify("WATCHDOG=1")
            stop.hear()
        return loop


@contextmanager
def _recording(
    options: argparse.Namespace, about: About, world: DryRun | None, tell: Callable[[str], None]
) -> Iterator[Recorder | None]:
    """Record, if that is wished for, and show the page of the recording, if there is one; its address is told.

    MindError where it would write over something, or cannot write.
    """
    if not options.record and not options.view:
        yield None
        return
    latest = None
    if world:
        about, latest = replace(about, world=world.about), world.latest
    with ExitStack() as stack:
        if not (path := options.record):
            path = Path(stack.enter_context(TemporaryDirectory(prefix="mind-"))) / "live.rec"
            tell("recorded for the view alone, and deleted at the end: --record FILE keeps it")
        try:
            is_kept = path == options.record
            recorder = Recorder(path, about, world=latest) if is_kept else TemporaryRecorder(path, about, tell, latest)
        except FileExistsError:
            raise MindError(f"{path} exists already", "record to another file, or delete it") from None
        except OSError as error:
            raise MindError(f"{path} cannot be written: {error.strerror}") from error
        stack.enter_context(recorder)
        if options.view:
            told = _print_error if options.quiet else tell
            stack.enter_context(live_view(path, options.bundle, options.view_port, told, options.breaks))
        yield recorder


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
