"""Wheels on a Grove I2C motor driver V1.3 (Seeed, two motors; commands as in Seeed's Grove_I2C_Motor_Driver_v1_3)."""

from contextlib import suppress
from dataclasses import dataclass, field
from threading import Lock
from time import monotonic, sleep
from typing import Annotated

from mindrun.driver import DeviceError
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity
from mindrun.robot.driver_support import ADDRESS, BUS, SharedParts, answering, share
from mindrun.robot.i2c import I2C_BYTE_SECONDS, I2cDevice, WiredDevice, on_bus

MOTOR = Quantity("a motor of the board", {"": 1.0}, low=1, high=2, whole=True)
SPEED, FREQUENCY, DIRECTION = 0x82, 0x84, 0xAA
UNUSED_BYTE = 0x01  # the third byte of commands that need only two
KILOHERTZ_4 = 0x02  # 3921 Hz, the board's default
COMMAND_GAP_SECONDS = 0.004  # seconds that the board needs for a command; what comes sooner is lost
DIRECTION_REFRESH_SECONDS = 1.0  # seconds after which directions are sent again: a board that lost power forgets them
FULL_SPEED = 255


@dataclass(slots=True, eq=False)
class Board(WiredDevice):
    """Both motors of a board: their speeds travel in one command, their directions in another."""

    speeds: list[int] = field(default_factory=lambda: [0, 0])  # signed, −255..255
    sent: int = -1  # the directions
    sent_at: float = 0.0
    free_at: float = 0.0
    lock: Lock = field(default_factory=Lock)

    def start(self) -> None:
        """Stop both motors, before anything else."""
        self.send(SPEED, 0, 0)
        self.send(FREQUENCY, KILOHERTZ_4, UNUSED_BYTE)

    def drive(self, motor: int, speed: int) -> None:
        """Change the speed of one motor; where a command is lost the motor stands still or goes on as before."""
        with self.lock:
            wanted = [*self.speeds]
            wanted[motor] = speed
            directions = sum((0b10 if value >= 0 else 0b01) << 2 * index for index, value in enumerate(wanted))
            if directions != self.sent:  # never backwards at the speed that was meant forwards
                standing = [0 if index == motor else abs(value) for index, value in enumerate(self.speeds)]
                self.send(SPEED, *standing)
                self.speeds[motor] = 0
            if directions != self.sent or monotonic() - self.sent_at > DIRECTION_REFRESH_SECONDS:
                self.sent = -1  # until it is acknowledged nobody knows
                self.send(DIRECTION, directions, UNUSED_BYTE)
                self.sent, self.sent_at = directions, monotonic()
            self.send(SPEED, *(abs(value) for value in wanted))
            self.speeds = wanted

    def send(self, *command: int) -> None:
        """Send a command when the board is done with the one before."""
        sleep(max(0.0, self.free_at - monotonic()))
        try:
            self.wire.write(*command)
        finally:
            self.free_at = monotonic() + COMMAND_GAP_SECONDS


boards = SharedParts[tuple[int, int], Board]()  # by bus and address


@dataclass(slots=True)
class MotorDevice:
    """One motor of a board."""

    board: Board
    motor: int
    closed: bool = False

    def write(self, value: float) -> None:
        """Command a speed: 0 full reverse, 0.5 stopped, 1 full forward."""
        speed = round((2 * share(value) - 1) * FULL_SPEED)
        if self.closed:
            raise self.board.wire.error("is closed")
        self.board.drive(self.motor, speed)

    def close(self) -> None:
        """Stop the motor if the board still listens, and let go."""
        if self.closed:
            return
        self.closed = True
        with suppress(DeviceError):  # closing never raises; neutral was sent before by who commands the motors
            self.board.drive(self.motor, 0)
        boards.release((self.board.wire.number, self.board.wire.address))


@kind("actuator driver", "grove_motor")
class GroveMotor:
    """A wheel on a Grove I2C motor driver V1.3, `motor` 1 or 2; both wheels of a board have the same bus and address.

    SDA and SCL to GPIO 2 and 3 through a level shifter, for it works at 5 V; the motors' supply to its terminals. 0 is
    full reverse, 0.5 stopped, 1 full forward; a wheel that turns the wrong way is `reversed`. The board has no time-out
    of its own: wheels go on as commanded when the Raspberry Pi stops, so let a switch of theirs be in reach.
    """

    motor: Annotated[int, MOTOR]
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x0F

    seconds = COMMAND_GAP_SECONDS  # of the board
    bus_seconds = 4 * I2C_BYTE_SECONDS

    @property
    def device(self) -> str:
        return on_bus(self.bus, self.address)

    def open(self) -> MotorDevice:
        """The motor; the first that is opened stops both."""

        def opened() -> Board:
            board = Board(I2cDevice("the motor board", self.bus, self.address))
            return answering(board, board.start)

        return MotorDevice(boards.acquire((self.bus, self.address), opened), self.motor - 1)
