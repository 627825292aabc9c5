"""Fake pins: that can be made to fail, that pulse, encoders that turn, and an MCP3008 on the pins of SPI bus 0."""

import pytest
from gpiozero import Device
from gpiozero.pins.mock import MockFactory, MockPin, MockPWMPin, MockSPIDevice

QUADRATURE = ((0, 1), (0, 0), (1, 0), (1, 1))  # levels of A and B in one step forwards, from (1, 1)


def mock_pins(patch: pytest.MonkeyPatch, pin_class: type[MockPin] = MockPin) -> MockFactory:
    """Pins that are not there."""
    factory = MockFactory(pin_class=pin_class)
    patch.setattr(Device, "pin_factory", factory)
    return factory


def pulsing_pins(patch: pytest.MonkeyPatch) -> MockFactory:
    """Pins that are not there, with pulses."""
    return mock_pins(patch, MockPWMPin)


def break_pins(patch: pytest.MonkeyPatch) -> None:
    """Let every pin fail that is read."""
    patch.setattr(MockPin, "_get_state", lambda pin: 1 / 0)


def turn_encoder(factory: MockFactory, a: int, b: int, steps: int) -> None:
    """Move the two pins of an encoder as so many steps do, backwards below 0."""
    forwards = steps > 0
    for _ in range(abs(steps)):
        levels = QUADRATURE if forwards else ((1, 0), (0, 0), (0, 1), (1, 1))
        for level_a, level_b in levels:
            for number, level in ((a, level_a), (b, level_b)):
                pin = factory.pin(number)
                (pin.drive_high if level else pin.drive_low)()


class FakeMcp3008(MockSPIDevice):
    """It takes a start bit, `single` and three bits of the input; a null bit and ten of the value come back."""

    def __init__(self, volts: dict[int, float]) -> None:
        super().__init__(clock_pin=11, mosi_pin=10, miso_pin=9, select_pin=8)
        self.volts = volts
        self.begun: int | None = None

    def on_start(self) -> None:
        super().on_start()
        self.begun = None

    def on_bit(self) -> None:
        if self.begun is None:
            self.begun = self.rx_bit if self.rx_buf[-1] else None
        elif self.rx_bit == self.begun + 4:
            single, *number = self.rx_buf[-4:]
            assert single
            volts = self.volts.get(number[0] << 2 | number[1] << 1 | number[2], 0.0)
            self.tx_buf = [0, 0]
            self.tx_word(min(1023, round(volts / 3.3 * 1024)), 10)
