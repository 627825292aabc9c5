"""`mindrun FILE.bundle` on a robot, or with --dry in a simulated world: what the command line says, done."""

import argparse
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from dataclasses import replace
from functools import partial
from pathlib import Path

from mindrun.driver import DeviceError
from mindrun.errors import MindError
from mindrun.graph.bundle import Bundle, digest, read_bundle
from mindrun.graph.graph import Graph, Task
from mindrun.graph.tasks import default_task
from mindrun.graph.wiring import still
from mindrun.robot.device_locks import hold_devices
from mindrun.robot.drive import DriveOptions, drive
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.dry_run import DryRun, beginning, outcome, refuse_environment
from mindrun.robot.identity import IdentityError, is_adopted
from mindrun.robot.live_view import live_view
from mindrun.robot.loop import Loop
from mindrun.robot.seen_world import SeenWorld
from mindrun.robot.temporary_recording import temporary_recording
from mindrun.robot.view_breakpoints import mistakes
from mindrun.terminal.command_line import command_line
from mindrun.terminal.status_line import StatusLine

MAX_END_TICKS = 20  # in which a recording gets the end of its run; one that cannot be written gets none


def run(options: argparse.Namespace) -> int:
    """Drive until a signal comes; the exit code."""
    bundle = read_bundle(options.bundle)
    line = StatusLine(_quiet, columns=lambda: None) if options.quiet else StatusLine(_print_error)
    _refuse_wrong_breakpoints(options, bundle.graph)
    if not options.arm:
        line.tell("nothing will move: --arm lets it")
    with _seen(options, line.tell) as (record, view):
        drive_options = DriveOptions(
            options.arm, record, options.ticks, options.master, view, is_kept=bool(options.record)
        )
        loop = (_dry if options.dry else _wired)(options, bundle, drive_options, line)
    line.tell(_summary(loop))
    return 0


def _refuse_wrong_breakpoints(options: argparse.Namespace, graph: Graph) -> None:
    """MindError where a line of the file of --break is wrong, before anything moves; the mistakes have been printed."""
    if options.breaks is None:
        return
    task = _task(graph, options.task)[0].name if options.dry else None
    if found := mistakes(options.breaks, options.bundle, task, options.master):
        for sentence in found:
            _print_error(sentence)
        raise MindError("nothing moves: the page cannot pause where that file says", "mend it, or leave --break out")


@contextmanager
def _seen(
    options: argparse.Namespace, tell: Callable[[str], None]
) -> Iterator[tuple[Path | None, AbstractContextManager[None] | None]]:
    """Where to record to, and the page of that recording, if one is asked for; its address is told in any case."""
    if not options.view:
        yield options.record, None
        return
    with nullcontext(options.record) if options.record else temporary_recording(tell) as record:
        yield (
            record,
            live_view(
                record, options.bundle, options.view_port, _print_error if options.quiet else tell, options.breaks
            ),
        )


def _wired(options: argparse.Namespace, bundle: Bundle, drive_options: DriveOptions, line: StatusLine) -> Loop:
    if bundle.wiring is None:
        raise MindError("this bundle is wired to no robot", "mindc build … --robot robot.yaml, or try it with --dry")
    wiring = bundle.wiring
    if not is_adopted(wiring, bundle.graph):
        remedy = f"if it is wired as this bundle has it: {command_line('mindrun', 'adopt', options.bundle)}"
        if drive_options.armed:
            raise IdentityError("nothing may move yet: this robot has not said how it is wired", remedy)
        line.tell("this robot has not said how it is wired: no actuator is opened")
        wiring = replace(wiring, actuators=tuple(replace(wire, driver=MockActuator()) for wire in wiring.actuators))
    if not drive_options.armed:
        wiring = replace(wiring, sensors=tuple(map(still, wiring.sensors)))
    with hold_devices(wiring) as held:
        return drive(bundle, digest(options.bundle), wiring, drive_options, line.tell, held)


def _dry(options: argparse.Namespace, bundle: Bundle, drive_options: DriveOptions, line: StatusLine) -> Loop:
    from mindrun.robot.drivers.simulated import dry, status
    from mindrun.robot.simulated_world.process import simulated

    task, why = _task(bundle.graph, options.task)
    refuse_environment(task)
    if why:
        line.tell(why)
    master = options.master or bundle.graph.master
    for sentence in beginning(bundle.graph, task, master, options.seed):
        line.tell(sentence)
    with simulated(options.bundle, task.name, options.seed, master=options.master or "") as socket:
        wiring = dry(bundle.graph, socket, master)
        run = DryRun(bundle.graph, task, master, socket, line)
        with run.shown(), _watched(task, options.seed, socket, drive_options) as watched:
            watch = partial(_goes_on, run, watched.world, iter(range(MAX_END_TICKS)))
            loop = drive(bundle, digest(options.bundle), wiring, watched, line.tell, watch=watch)
        with suppress(DeviceError):  # the run was as good without it
            for sentence in outcome(task, master, status(socket)):
                line.tell(sentence)
        return loop


def _goes_on(run: DryRun, world: SeenWorld | None, more: Iterator[int], loop: Loop) -> bool:
    """After each tick: until the run is over, and a recording has its end, or after so many ticks `more` could not."""
    return run.watch(loop) or (world is not None and not world.has_ended and next(more, None) is not None)


@contextmanager
def _watched(task: Task, seed: int, socket: str, options: DriveOptions) -> Iterator[DriveOptions]:
    """The options of a drive; one that is recorded has the simulated world at a socket recorded, too."""
    if options.record is None:
        yield options
        return
    world = SeenWorld(task, seed, socket)
    with world.watched():
        yield replace(options, world=world)


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
    return f"{loop.pace}; {loop.stopped} at neutral because of a fault{by_guardian}{faults}"


def _print_error(sentence: str) -> None:
    print(sentence, file=sys.stderr, flush=True)


def _quiet(sentence: str) -> None:
    """Say nothing."""
