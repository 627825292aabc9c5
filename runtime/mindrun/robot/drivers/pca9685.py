"""Servos on a PCA9685 servo card (NXP, 16 channels of 12 bits; data sheet "PCA9685", revision 4, of 2015)."""

from dataclasses import dataclass
from time import sleep
from typing import Annotated

from mindrun.kinds.registry import kind
from mindrun.robot.driver_support import ADDRESS, BUS, CHANNEL, MICROSECONDS, answering, share
from mindrun.robot.i2c import I2C_BYTE_SECONDS, I2cDevice, WiredDevice, on_bus

MODE1, MODE2, LED0, ALL_OFF_HIGH, PRESCALE = 0x00, 0x01, 0x06, 0xFD, 0xFE  # table 4
RESTART, AUTO_INCREMENT, SLEEP = 0x80, 0x20, 0x10  # bits of MODE1, table 5
TOTEM_POLE = 0x04  # MODE2, table 6: outputs change when the transfer ends
FULL_OFF = 0x10  # bit 4 of a channel's last byte, 7.3.3
OSCILLATOR_MHZ = 25.0
PRESCALE_50_HZ = 121  # round(25 MHz / (4096 · 50 Hz)) − 1, equation 1: pulses 50 times a second
COUNT = (PRESCALE_50_HZ + 1) / OSCILLATOR_MHZ  # microseconds of one count
WAKE_SECONDS = 0.001  # the oscillator is stable after 500 µs


@dataclass(slots=True)
class ServoDevice(WiredDevice):
    """One channel of a servo card, which repeats its last pulse when it is closed: a claw keeps what it holds."""

    channel: int
    shortest: float
    longest: float
    ready: bool = False

    def write(self, value: float) -> None:
        """Command the pulse for a share of the travel."""
        width = self.shortest + share(value) * (self.longest - self.shortest)
        if not self.ready:
            self.prepare()
        off = round(width / COUNT)
        self.wire.write(LED0 + 4 * self.channel, 0, 0, off & 0xFF, off >> 8)
        if not self.is_prepared():  # after a brown-out it takes commands and sends no pulses
            self.ready = False
            raise self.wire.error("has lost its settings; does its supply sag?")

    def prepare(self) -> None:
        """Set the card up, unless it is: the other channels must not notice that one more is opened.

        A card that runs at another rate is turned off before: its outputs would move when they start again.
        """
        if not self.is_prepared():
            self.wire.write(ALL_OFF_HIGH, FULL_OFF)
            self.wire.write(MODE1, AUTO_INCREMENT | SLEEP)  # the rate can be set only while it sleeps, 7.3.5
            self.wire.write(PRESCALE, PRESCALE_50_HZ)
            self.wire.write(MODE2, TOTEM_POLE)
            self.wire.write(MODE1, AUTO_INCREMENT)
            sleep(WAKE_SECONDS)
            if not self.is_prepared():
                raise self.wire.error("does not keep its settings; is it a PCA9685?")
        self.ready = True

    def is_prepared(self) -> bool:
        """True if the chip is awake and at our rate."""
        mode = self.wire.byte(MODE1) & ~RESTART
        return mode == AUTO_INCREMENT and self.wire.byte(PRESCALE) == PRESCALE_50_HZ


@kind("actuator driver", "pca9685")
class Pca9685:
    """A servo, or a motor controller that takes servo pulses, on a PCA9685 servo card.

    SDA and SCL to GPIO 2 and 3; the servos need a supply of their own. Command 0 is the pulse `shortest`, 1 `longest`,
    50 times a second. The card repeats the last pulse for ever, even when the Raspberry Pi has stopped: where wheels
    hang on it, wire its OE pin so that it goes high when nothing holds it low.
    """

    channel: Annotated[int, CHANNEL]
    shortest: Annotated[float, MICROSECONDS] = 1000.0
    longest: Annotated[float, MICROSECONDS] = 2000.0
    bus: Annotated[int, BUS] = 1
    address: Annotated[int, ADDRESS] = 0x40

    bus_seconds = 14 * I2C_BYTE_SECONDS  # a pulse, and two questions whether the card has lost its settings

    @property
    def device(self) -> str:
        return on_bus(self.bus, self.address)

    def open(self) -> ServoDevice:
        """The servo, which does not move until it is commanded."""
        wire = I2cDevice("the servo card", self.bus, self.address)
        device = ServoDevice(wire, self.channel, self.shortest, self.longest)
        return answering(device, device.prepare)
