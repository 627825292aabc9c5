"""The guard against the table of docs/safety.md, said once more in plain words: whatever comes, and to the moment."""

from dataclasses import dataclass, field

from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.robot.drivers.mock import MockActuator
from mindrun.robot.guardian.guard import REST, Guard, Order
from mindrun.robot.guardian.messages import Frame
from mindrun.robot.guardian.plan import Channel, Plan

from tests.draws import cases

TICK = 1 / 16  # with times and shares in whole 128ths all sums are exact: bounds are met, not only neared
SOME = st.sampled_from([0, 1, 4, 7, 8, 9, 12, 15, 16, 17, 40]).map(lambda steps: steps / 128)
SHARES = st.integers(0, 128).map(lambda steps: steps / 128)
CHANNELS = st.builds(
    lambda neutral, trim, limits, slew, turned, least: Channel(
        "any", neutral, MockActuator(), trim, min(limits), max(limits), slew, turned, least
    ),
    SHARES,
    st.sampled_from([0.0, 0.0, 0.125, -0.25, 1.0]),
    st.tuples(SHARES, SHARES),
    st.sampled_from([0.0, 0.0, 0.5, 2.0, 8.0]),
    st.booleans(),
    st.sampled_from([0.0, 0.0, 0.25, 1.0]),
)


@dataclass
class Restated:
    """What is to happen. `until` is when silence becomes too long, `moved` when something was moved since the rest."""

    channels: tuple[Channel, ...]
    state: str = "neutral"
    why: str = "started"
    until: float = 0.0
    moved: float | None = None
    silences: int = 0
    failures: int = 0
    places: list[float] = field(default_factory=list)

    def rest(self, why: str, latched: bool = False) -> Order:
        self.state, self.why, self.moved = "latched" if latched else "neutral", why, None
        return REST

    def frame(self, frame: Frame, now: float, settled: bool) -> Order:
        if self.state == "latched" or now - frame.sent >= 2 * TICK:
            return None
        if frame.sent - now > TICK:
            return self.rest("a frame from the future", latched=True)
        if not frame.armed:
            if self.state == "following":
                return self.rest("not armed")
            if settled:
                self.why = "not armed"
            return None
        if self.state == "neutral" and not settled:
            if self.why in ("started", "not armed"):
                self.why = "not every actuator has come to neutral"
            return None
        self.state, self.why, self.until = "following", "", frame.sent + 2 * TICK
        return self.move(frame.commands, now)

    def move(self, commands: tuple[float, ...], now: float) -> Order:
        if self.moved is None:
            self.places = [min(1.0, max(0.0, each.neutral + each.trim)) for each in self.channels]
        seconds = TICK if self.moved is None else min(TICK, now - self.moved)
        self.moved = now
        for number, each in enumerate(self.channels):
            wanted = max(each.low, min(each.high, self.sent(each, commands[number])))
            change = wanted - self.places[number]
            if each.slew and abs(change) > each.slew * seconds:
                change = each.slew * seconds if change > 0 else -each.slew * seconds
            self.places[number] = min(1.0, max(0.0, self.places[number] + change))
        return tuple(1 - p if c.reversed else p for p, c in zip(self.places, self.channels, strict=True))

    @staticmethod
    def sent(each: Channel, command: float) -> float:
        """Neutral with the trim, or from there so far to an end as the command goes, by the least share at least."""
        rest, end = min(1.0, max(0.0, each.neutral + each.trim)), 1.0 if command > each.neutral else 0.0
        if not (each.trim or each.least):
            return command
        if command == each.neutral:
            return rest
        share = (command - each.neutral) / (end - each.neutral)
        return rest + (end - rest) * (each.least + (1 - each.least) * share)

    def passed(self, now: float) -> Order:
        if self.state != "following" or now < self.until:
            return None
        self.silences += 1
        return self.rest("no frame for two ticks")

    def failed(self, actuator: str, why: str) -> Order:
        if self.state == "neutral":
            self.why = f"{actuator} failed: {why}"
        if self.state != "following":
            return None
        self.failures += 1
        if self.failures == 3:
            return self.rest(f"{actuator} failed, as did 2 before: {why}", latched=True)
        return self.rest(f"{actuator} failed: {why}")

    def broken(self, why: str) -> Order:
        return None if self.state == "latched" else self.rest(why, latched=True)


AGES = st.sampled_from([0, 0, 0, 0, 1, 12, 15, 16, 17, -7, -8, -9]).map(lambda steps: steps / 128)
MOSTLY = st.sampled_from([True, True, True, True, True, True, False])
FRAMES = st.tuples(st.just("frame"), SOME, AGES, MOSTLY, st.tuples(SHARES, SHARES), MOSTLY)
SELDOM = st.one_of(
    st.tuples(st.just("passed"), SOME),
    st.tuples(st.just("failed"), st.sampled_from(["wheel", "claw"])),
    st.tuples(st.just("broken")),
)
EVENTS = st.integers(0, 5).flatmap(lambda some: FRAMES if some else SELDOM)


@given(st.tuples(CHANNELS, CHANNELS), st.lists(EVENTS, max_size=40))
@settings(max_examples=cases(150))
def test_whatever_comes_it_does_what_the_table_says(
    channels: tuple[Channel, Channel],
    events: list[tuple],  # type: ignore[type-arg]
) -> None:
    guard, restated, now = Guard(Plan(TICK, channels)), Restated(channels), 64.0
    for number, event in enumerate(events):
        order, expected = None, None
        match event:
            case "frame", after, age, armed, commands, settled:
                now += after
                frame = Frame(number, now - age, armed, commands)
                order, expected = guard.frame(frame, now, settled), restated.frame(frame, now, settled)
            case "passed", after:
                now += after
                order, expected = guard.passed(now), restated.passed(now)
            case "failed", name:
                order, expected = guard.failed(name, "no answer"), restated.failed(name, "no answer")
            case _:
                order, expected = guard.broken("a frame that is damaged"), restated.broken("a frame that is damaged")
        assert order == expected
        assert (guard.state, guard.why) == (restated.state, restated.why)
        assert (guard.silences, guard.failures) == (restated.silences, restated.failures)
        if guard.state == "following":
            assert guard.deadline == restated.until
