"""Fake pins of range finders: a trigger pin that makes its echo pin answer, with edges at exact times."""

from threading import Timer
from time import monotonic

from gpiozero.pins.mock import MockFactory, MockPin
from gpiozero.pins.pi import PiPin

SOUND = 343.2


class EchoPin(MockPin):
    """The echo line: what it answers with, and the order in which such lines were fired."""

    metres: float | None = 1.0  # None where nothing echoes: the line stays high for 38 ms
    fault = ""  # "silent", "stuck" high, or "lost": the falling edge is not told

    def answer(self) -> None:
        if self.fault == "silent":
            return
        now = monotonic()
        self.edge(True, now + 0.0005)
        if self.fault == "lost":
            self._change_state(False)
        elif self.fault != "stuck":
            if self.metres is None:
                Timer(0.038, self.edge, (False, now + 0.0385)).start()
            else:
                self.edge(False, now + 0.0005 + 2 * self.metres / SOUND)

    def edge(self, level: bool, at: float) -> None:
        self._change_state(level)
        if self._when_changed is not None:
            PiPin._call_when_changed(self, at, level)


class TriggerPin(MockPin):
    """The trigger line."""

    def __init__(self, factory, info, echo: EchoPin, log: list[int]) -> None:
        super().__init__(factory, info)
        self.echo, self.log = echo, log

    def _set_state(self, value) -> None:
        super()._set_state(value)
        if value:
            self.log.append(self.echo.info.name)
            self.echo.answer()


def ring(factory: MockFactory, triggers: tuple[int, ...], echoes: tuple[int, ...], log: list) -> list[EchoPin]:
    """The echo pins of so many range finders."""
    made = [factory.pin(echo, pin_class=EchoPin) for echo in echoes]
    for trigger, echo in zip(triggers, made, strict=True):
        factory.pin(trigger, pin_class=TriggerPin, echo=echo, log=log)
    return made
