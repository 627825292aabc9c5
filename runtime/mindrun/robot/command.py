"""`mindrun FILE.bundle` on a robot, or with --dry in a simulated world: what the command line says, done."""

import argparse
import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from dataclasses import replace
from pathlib import Path

from mindrun.driver import DeviceError
from mindrun.errors import MindError
from mindrun.graph.bundle import Bundle, digest, read_bundle
from mindrun.graph.default_task import default_task
from mindrun.graph.graph import Graph, Task
from mindrun.graph.wiring import still
from mindrun.robot.drive import DriveOptions, drive
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.dry_run import DryRun, SeenWorld, beginning, dry, outcome, refuse_environment
from mindrun.robot.live_view import breakpoint_mistakes, live_view
from mindrun.robot.loop import Loop
from mindrun.robot.ownership import IdentityError, hold_devices, is_adopted
from mindrun.robot.recording import temporary_recording
from mindrun.robot.simulated_world import simulated, status
from mindrun.terminal.command_line import command_line
from mindrun.terminal.standard_streams import StatusLine


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
    if found := breakpoint_mistakes(options.breaks, options.bundle, task, options.master):
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
    task, why = _task(bundle.graph, options.task)
    refuse_environment(task)
    master = options.master or bundle.graph.master
    for sentence in (*filter(None, [why]), *beginning(bundle.graph, task, master, options.seed)):
        line.tell(sentence)
    with simulated(options.bundle, task.name, options.seed, options.master or "") as socket:
        seen = SeenWorld(task, options.seed, socket) if drive_options.record else None
        run = DryRun(bundle.graph, task, master, socket, line, seen)
        wiring, watched = dry(bundle.graph, socket, master), replace(drive_options, world=seen)
        with run.shown(), seen.watched() if seen else nullcontext():
            loop = drive(bundle, digest(options.bundle), wiring, watched, line.tell, watch=run.watch)
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
    return f"{loop.pace}; {loop.stopped} at neutral because of a fault{by_guardian}{faults}"


def _print_error(sentence: str) -> None:
    print(sentence, file=sys.stderr, flush=True)


def _quiet(sentence: str) -> None:
    """Say nothing."""
