"""Grove ultrasonic rangers on a GrovePi board, over I2C (protocol of the board's firmware 1.2 to 1.4)."""

from time import monotonic, sleep
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity
from mindrun.robot.driver_support import ADDRESS, BUS, METRES, OpenSensor, Ranging, answering
from mindrun.robot.i2c import I2C_BYTE_SECONDS, I2cDevice, on_bus

PORT = Quantity("a digital port of the GrovePi", {"": 1.0}, low=2, high=8, whole=True)
RANGER_COMMAND, VERSION_COMMAND = 7, 8  # commands
BUSY_BYTE, IDLE_BUS_BYTE = 23, 255  # first bytes of an answer: still measuring; nobody drives the bus
UNUSED_BYTE = 0
POLL_SECONDS = 0.003  # seconds between two questions
COMMAND_BYTES, ANSWER_BYTES = 5, 4  # of a transfer, with the address
RANGER_SECONDS = 0.04  # that a ranger may take, of the 10 to 40 ms
ANSWERED_IN = 0.15  # seconds; the board itself listens for 75 ms
MAX_DISTANCE_METRES = 5.2  # metres: where nothing echoes the ranger's pulse ends at about 5 m, and is longer on some


def ask(board: I2cDevice, command: int, port: int = UNUSED_BYTE, *, count: int) -> bytes:
    """The board's answer, without the command that it repeats; asks until a deadline that no answer can put off."""
    with board.lock:
        board.write(command, port, UNUSED_BYTE, UNUSED_BYTE)
        begin = monotonic()
        while monotonic() - begin < ANSWERED_IN:
            sleep(POLL_SECONDS)
            answer = board.transfer(b"", count)
            if answer[0] == command:
                return answer[1:]
            if answer[0] not in (BUSY_BYTE, IDLE_BUS_BYTE):
                raise board.error(f"answers nonsense ({answer.hex(' ')})")
        raise board.error("does not finish measuring")


@kind("sensor driver", "grove_ultrasonic")
class GroveUltrasonic(Ranging):
    """Grove ultrasonic rangers on the digital ports of a GrovePi board: metres to an echo.

    `ports` lists the numbers of the ports (4 for D4) in the order of the sensor's angles; not two neighbours in a row.
    Each takes 10 to 40 ms. What is farther away than `range`, or does not echo, is none.
    """

    ports: Annotated[tuple[int, ...], PORT]
    range: Annotated[float, METRES] = 3.5
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x04

    @property
    def readings(self) -> int:
        return len(self.ports)

    @property
    def seconds(self) -> float:
        """The most seconds for which the board listens to all of them."""
        return len(self.ports) * RANGER_SECONDS

    @property
    def bus_seconds(self) -> float:
        """The seconds on the bus of each command, and of asking until there is an answer."""
        return len(self.ports) * (COMMAND_BYTES + ANSWER_BYTES * RANGER_SECONDS / POLL_SECONDS) * I2C_BYTE_SECONDS

    @property
    def queue(self) -> str:
        """The board: it listens to one ranger at a time."""
        return on_bus(self.bus, self.address)

    def open(self) -> OpenSensor:
        board = I2cDevice("the GrovePi", self.bus, self.address)
        device = OpenSensor(lambda: tuple(self.metres(board, port) for port in self.ports), board.close)
        return answering(device, lambda: ask(board, VERSION_COMMAND, count=4))

    def metres(self, board: I2cDevice, port: int) -> float | None:
        """Metres to what echoed to the ranger on a port, None where nothing did."""
        high, low = ask(board, RANGER_COMMAND, port, count=3)
        centimetres = high << 8 | low
        if not centimetres:  # the board heard no pulse at all; where nothing echoes there is a long one
            raise board.error(f"hears no ranger on port D{port}")
        metres = centimetres / 100
        return metres if metres <= min(self.range, MAX_DISTANCE_METRES) else None
