"""Orders to a robot that drives: what a person or a program said last, and where they say it.

An order is a line, `wanted 3` or `wanted=3`: of `--order`, of the standard input, or a datagram to an address of the
kernel that has the number of the process that drives. Only the user that drives, and root, is heard there.
"""

import errno
import os
import signal
import socket
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, replace
from functools import partial
from math import isfinite
from threading import Thread, current_thread, main_thread
from time import monotonic, sleep
from typing import Any

from mindrun.driver import DeviceError
from mindrun.errors import MindError, nearest, reason
from mindrun.files.printable import visible
from mindrun.graph.graph import Graph, Sensor
from mindrun.graph.wiring import SensorWire, Wiring
from mindrun.robot.driver_support import OpenSensor
from mindrun.robot.drivers.simulated import VALUE
from mindrun.robot.hand import NO_HAND, Hand
from mindrun.robot.keys import KeyDriving, drive_by_keys, key_by_key
from mindrun.robot.order_client import ADDRESS, DONE, MAX_ORDER_BYTES, REFUSED
from mindrun.robot.ownership import PEER
from mindrun.robot.processes import let_go_in_children
from mindrun.robot.simulated_world import READ, WRITE, WorldConnection
from mindrun.terminal.arguments import shortened

PASS_CREDENTIALS, CREDENTIALS = getattr(socket, "SO_PASSCRED", 16), getattr(socket, "SCM_CREDENTIALS", 2)
PAUSE_SECONDS = 0.0005  # after each order: whoever sends too many waits, and not the loop
BACKGROUND_SECONDS = 1.0  # after which a program in the background of its terminal looks whether it may read
MAX_AGE_SECONDS = 3600.0  # of a sample: an order that was said stays


class Orders:
    """The orders that a mind takes, and what was said last of each. Any thread may say one, or ask.

    Those that are `wired` in robot.yaml are said by their drivers alone. Numbers for what the `hand` holds are said in
    the same way, and passed on to it.
    """

    def __init__(
        self, graph: Graph, wired: Sequence[str] = (), clock: Callable[[], float] = monotonic, hand: Hand = NO_HAND
    ) -> None:
        kinds = {sensor.name: sensor.kind for sensor in graph.sensors if sensor.kind.is_order}
        self.kinds: dict[str, Any] = {name: kind for name, kind in kinds.items() if name not in wired}
        self._wired = kinds.keys() - self.kinds
        self.hand = hand
        self._clock = clock
        self._said: dict[str, tuple[float, float]] = {}

    def say(self, line: str) -> str:
        """Take an order; what it is now, in words. MindError where it is none that this mind takes."""
        name, value = self._order(line)
        if name in self.hand.held:
            self.hand.say(name, value)
        else:
            self._said[name] = value, self._clock()
        return f"{name} is {value:g}"

    def now(self, name: str) -> float | None:
        """The order that counts now: neutral after a silence; None where nobody has said one."""
        value, at = self._said.get(name, (None, 0.0))
        silence = self.kinds[name].timeout
        return self.kinds[name].neutral if value is not None and 0 < silence < self._clock() - at else value

    def _order(self, line: str) -> tuple[str, float]:
        words = line.replace("=", " ", 1).split()
        kinds: dict[str, Any] = {**self.kinds, **self.hand.held}
        known = list(kinds)
        if not known and not self._wired:
            raise MindError("this mind takes no orders", "in the mind: sensor wanted is order 1 to 7")
        if len(words) != 2:
            example = f"an order is a name and a number: {[*known, *self._wired][0]} 1"
            raise MindError(f"{shortened(line.strip())} is no order", example)
        name, said = words
        if name in self._wired:
            raise MindError(f"{name} is wired in robot.yaml: what its device says counts")
        if name not in kinds:
            near = nearest(name, known)
            hint = f"did you mean {near}?" if near else f"there is {', '.join(known)}"
            raise MindError(f"there is no order {shortened(name)}", hint)
        try:
            value = float(said)
        except ValueError:
            value = float("nan")
        why = kinds[name].refusal(value) if isfinite(value) else "an order is a number"
        if why:
            raise MindError(f"{name} cannot be {shortened(said)}: {why}")
        return name, value + 0.0  # there is no -0

    @contextmanager
    def heard(self, tell: Callable[[str], None], by_keys: bool = False) -> Iterator[None]:
        """Hear the standard input and the address of this process as long as this lasts; `tell` gets sentences.

        `by_keys`, the hand is driven by the keys of the terminal, and no lines are read there.
        """
        with ExitStack() as stack:
            if self.kinds or self.hand.held:
                try:
                    listener = stack.enter_context(_listening())
                except OSError as error:
                    tell(f"orders are heard on the standard input alone: {reason(error)}")
                else:
                    Thread(target=self._answer, args=(listener,), name="orders", daemon=True).start()
                if current_thread() is main_thread():  # who reads in the background of a terminal would be stopped
                    signal.signal(signal.SIGTTIN, signal.SIG_IGN)
                if by_keys:
                    stack.enter_context(key_by_key())
                reading = partial(drive_by_keys, KeyDriving(self.hand)) if by_keys else self._read
                Thread(target=reading, args=(tell,), name="typed orders", daemon=True).start()
            yield

    def _answer(self, listener: socket.socket) -> None:
        """Answer datagrams until the listener is closed."""
        # There is room for credentials alone: descriptors that somebody sends along stay outside.
        room = socket.CMSG_SPACE(PEER.size)
        while True:
            try:
                data, said, _, sender = listener.recvmsg(MAX_ORDER_BYTES, room)
            except OSError:
                return
            if not data and not said:  # it is closed: all that is sent has credentials
                return
            users = [PEER.unpack(held[: PEER.size])[1] for _, sort, held in said if sort == CREDENTIALS]
            answer = self._answered(data, users)
            with suppress(OSError):  # who does not listen is not answered, nor who has no address
                listener.sendto(answer, socket.MSG_DONTWAIT, sender or b"")
            sleep(PAUSE_SECONDS)

    def _answered(self, data: bytes, users: Sequence[int]) -> bytes:
        try:
            if not {*users} & {os.getuid(), 0}:
                raise MindError("this robot is driven by another user")
            return DONE + self.say(data.decode(errors="replace")).encode()
        except MindError as error:
            return REFUSED + "\n".join(filter(None, (str(error), error.hint))).encode()

    def _read(self, tell: Callable[[str], None]) -> None:
        """Take orders line by line from the standard input, until it ends."""
        # Not through `sys.stdin`: its lock would be held when the process ends.
        waiting, refused, is_person = b"", "", bool(sys.stdin) and sys.stdin.isatty()
        while sys.stdin and (part := _typed()):
            *lines, waiting = (waiting + part).split(b"\n")
            for line in (line[:MAX_ORDER_BYTES].decode(errors="replace") for line in lines if line.strip()):
                try:
                    now = self.say(line)
                    refused = ""
                    if is_person:
                        tell(now)
                except MindError as error:
                    why = visible("; ".join(filter(None, (str(error), error.hint))))
                    if why != refused:  # once: a program may go on and on
                        tell(f"order not taken: {why}")
                    refused = why
                sleep(PAUSE_SECONDS)
            waiting = waiting[:MAX_ORDER_BYTES]


def _typed() -> bytes:
    """The next bytes of the standard input; none where it has ended."""
    while True:
        try:
            return os.read(0, MAX_ORDER_BYTES)
        except OSError as error:
            if error.errno != errno.EIO:
                return b""
            sleep(BACKGROUND_SECONDS)


@contextmanager
def _listening() -> Iterator[socket.socket]:
    """A socket at the address of this process, which says who sends."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as listener:
        listener.setsockopt(socket.SOL_SOCKET, PASS_CREDENTIALS, 1)
        listener.bind(f"{ADDRESS}{os.getpid()}")
        let_go_in_children.add(listener.close)
        try:
            yield listener
        finally:
            let_go_in_children.discard(listener.close)
            with suppress(OSError):
                listener.shutdown(socket.SHUT_RDWR)


@dataclass(frozen=True, slots=True)
class OrderDriver:
    """The driver of an order: its readings are what was said last. In a simulated `world` it is said there.

    There it is what the task draws until somebody says one.
    """

    orders: Orders
    name: str
    readings: int
    world: str = ""

    unit = ""
    usual = (0.0, 1.0)

    def open(self) -> OpenSensor:
        """The order, which is always there."""
        if not self.world:
            return OpenSensor(self._now, lambda: None)
        link, told = WorldConnection(self.world), list[float]()
        return OpenSensor(lambda: self._now_in_world(link, told), link.close)

    def _now(self) -> tuple[float, ...]:
        kind, value = self.orders.kinds[self.name], self.orders.now(self.name)
        return tuple(kind.readings(kind.neutral if value is None else value))

    def _now_in_world(self, link: WorldConnection, told: list[float]) -> tuple[float, ...]:
        """The readings there, which is `told` an order that is new."""
        value = self.orders.now(self.name)
        if value is not None and told[-1:] != [value]:
            link.ask(WRITE, self.name, value)
            told[:] = [value]
        held = link.ask(READ, self.name)
        if len(held) != self.readings * VALUE.size:
            raise DeviceError("the simulated world has another mind")
        return tuple(value for (value,) in VALUE.iter_unpack(held))


def with_orders(wiring: Wiring, graph: Graph, measured: Iterable[Sensor], orders: Orders, world: str = "") -> Wiring:
    """A wiring in which those of the `measured` sensors that are orders read what is said, here or in a world."""
    rate = min(max(2 / graph.tick, 0.01), 1000.0)
    known = {wire.sensor: wire for wire in wiring.sensors}
    for sensor in (sensor for sensor in measured if sensor.name in orders.kinds):
        driver = OrderDriver(orders, sensor.name, sensor.width, world)
        known[sensor.name] = SensorWire(sensor.name, driver, 0.0, 1.0, rate=rate, max_age=MAX_AGE_SECONDS)
    return replace(wiring, sensors=tuple(known[each.name] for each in graph.sensors if each.name in known))
