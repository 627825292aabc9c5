"""Signals between robots on a local network: a datagram for each command, and the last that others have sent."""

import socket
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from time import monotonic
from typing import Annotated

from mindrun.driver import DeviceError
from mindrun.errors import reason
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import SECONDS, Quantity
from mindrun.robot.driver_support import TEXT, OpenSensor, share

PORT = Quantity("a UDP port", {"": 1.0}, low=1024, high=65535, whole=True)
DEFAULT_PORT = 47807
EVERYBODY = "255.255.255.255"  # on this network
MAX_PACKET_BYTES = 256
MAX_PACKETS = 1000  # that are read in one tick, however many a stranger sends
MAGIC = b"mind signal"


def packet(name: str, number: int, value: float) -> bytes:
    """A datagram: who says it, the how manieth of its own it is, and the value."""
    return b"%s %s %d %r" % (MAGIC, name.encode(), number, value)


def said(data: bytes) -> tuple[str, int, float] | None:
    """What a datagram says; None where it is none of ours, or damaged."""
    with suppress(ValueError, UnicodeDecodeError):
        magic, name, number, value = data.rsplit(b" ", 3)
        if magic == MAGIC and 0.0 <= (found := float(value)) <= 1.0:  # of NaN that is false
            return name.decode(), int(number), found
    return None


def opened(make: Callable[[socket.socket], None], what: str) -> socket.socket:
    """A socket that is made ready; DeviceError where the network has none."""
    sock = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        sock.setblocking(False)
        make(sock)
    except OSError as error:
        sock.close()
        raise DeviceError(f"{what}: {reason(error)}") from error
    return sock


@dataclass(slots=True)
class UdpActuatorDevice:
    """An actuator that sends each command as a datagram. What is lost on the way is said again with the next one."""

    sock: socket.socket
    name: str
    address: tuple[str, int]
    number: int = 0

    def write(self, value: float) -> None:
        """Send it. No network is no fault of the robot's: nobody hears it then."""
        self.number += 1
        data = packet(self.name, self.number, share(value))
        with suppress(OSError):
            self.sock.sendto(data, self.address)

    def close(self) -> None:
        self.sock.close()


@kind("actuator driver", "udp")
class UdpActuator:
    """A signal to the other robots of a local network, by UDP: each command is a datagram to the `port` of all.

    `name` tells this robot from the others, which each have another; `to` is an address of one of them, or of all.
    """

    name: Annotated[str, TEXT]
    port: Annotated[int, PORT] = DEFAULT_PORT
    to: Annotated[str, TEXT] = EVERYBODY

    @property
    def device(self) -> str:
        return f"udp {self.to}:{self.port} as {self.name}"

    def open(self) -> UdpActuatorDevice:
        """The socket; DeviceError where it cannot be."""
        sock = opened(lambda sock: sock.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1), self.device)
        return UdpActuatorDevice(sock, self.name, (self.to, self.port))


@dataclass(slots=True)
class Heard:
    """What others have said last, and when, by their names."""

    sock: socket.socket
    own: str
    lasts: float
    last: dict[str, tuple[int, float, float]] = field(default_factory=dict)  # number, value, time

    def read(self) -> tuple[float]:
        """The value that was said last, of what is no older than it may be; 0 where nobody has said anything."""
        now = monotonic()
        for name, number, value in self._new():
            before = self.last.get(name)
            # What was sent earlier may come later; who begins anew begins with small numbers.
            if before is None or number > before[0] or now - before[2] > self.lasts:
                self.last[name] = number, value, now
        self.last = {name: each for name, each in self.last.items() if now - each[2] <= self.lasts}
        newest = max(self.last.values(), key=lambda each: each[2], default=(0, 0.0, 0.0))
        return (newest[1],)

    def _new(self) -> Iterator[tuple[str, int, float]]:
        for _ in range(MAX_PACKETS):
            try:
                data = self.sock.recv(MAX_PACKET_BYTES)
            except OSError:  # nothing more has come
                return
            if (found := said(data)) and found[0] != self.own:
                yield found


@kind("sensor driver", "udp")
class UdpSensor:
    """What another robot of a local network says, of several the one that spoke last: 0 where nobody does.

    It stays for `lasts`, in which datagrams may be lost, and is 0 then, as of a robot that is out of range. `name` is
    this robot's own, whose datagrams are not heard.
    """

    name: Annotated[str, TEXT]
    port: Annotated[int, PORT] = DEFAULT_PORT
    lasts: Annotated[float, SECONDS] = 0.5

    unit = ""
    usual = (0.0, 1.0)
    readings = 1

    def open(self) -> OpenSensor:
        """The socket; DeviceError where the port is not free."""

        def bind(sock: socket.socket) -> None:
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)  # several robots may be of one machine
            sock.bind(("", self.port))

        heard = Heard(opened(bind, f"udp port {self.port}"), self.name, self.lasts)
        return OpenSensor(heard.read, heard.sock.close)
