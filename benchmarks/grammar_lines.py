"""Lines that the grammar allows, out of the registered kinds, about names that most often are declared."""

from collections.abc import Callable, Sequence
from random import Random

from mindrun.kinds.registry import arguments, kinds

NUMBERS = (
    *("0", "1", "2", "-1", "0.5", "1/60", "1/0", "0/0", "1e3", "7.", ".5", "0.0000001", "1/3", "-0", "+1", "999999999"),
    *("1_000", "٣", "²", "9" * 40, "9" * 400, "0." + "9" * 40, "1/" + "9" * 330, "60%", "90 deg", "3 s", "10 ticks"),
)


def line(random: Random) -> str:
    """A header, a fact or a setting."""
    return random.choice(FORMS)(random)


def _name(random: Random) -> str:
    return random.choice(("eye", "ball_bearing", "charge", "mood", "left_wheel", "right_wheel", "eye2", "ball", "home"))


def _title(random: Random) -> str:
    return random.choice(("Go", "Seek", "Run", "Live", "School", "Go+Seek", "Other"))


def _amount(random: Random) -> str:
    number = random.choice(NUMBERS if random.random() < 0.1 else ("0", "1", "0.5", "2", "10", "100"))
    return number + random.choice(("", "", "", "", "", " s", " deg", " ticks", "%"))


def _phrase(random: Random, noun: str) -> str:
    """A kind with some of its arguments; of ten phrases one says an argument of another."""
    name, cls = random.choice(sorted(kinds(noun).items()))
    said = [each for each in arguments(cls) if each.required or random.random() < 0.2]
    return " ".join([name, *(f"{each.key} {_value(random, each.shape, each.type)}" for each in said)])


def _value(random: Random, shape: str, type_: object) -> str:
    match shape:
        case "name":
            words: tuple[str, ...] = getattr(type_, "words", ())
            return random.choice([*words, _name(random), "module.function"])
        case "list":
            unit = random.choice(list(getattr(type_, "units", {"": 1})))
            return " ".join([*(_amount(random) for _ in range(random.choice((0, 1, 3)))), f"90 {unit}"])
        case "span" if random.random() < 0.3:
            return f"{_amount(random)} to {_amount(random)}{f' by {_amount(random)}' * random.randrange(2)}"
    unit = random.choice(list(getattr(type_, "units", {"": 1})))
    usual = random.choice(("0", "1", "2", "0.5", "10", "50"))
    return _amount(random) if random.random() < 0.1 else f"{usual} {unit}"


def _expression(random: Random, depth: int = 3) -> str:
    match random.randrange(8 if depth else 3):
        case 0:
            return random.choice(NUMBERS)
        case 1:
            return _name(random)
        case 2:
            return _phrase(random, "measure")
        case 3:
            return f"({_expression(random, depth - 1)})"
        case 4:
            return f"-{_expression(random, depth - 1)}"
    sign = random.choice("+-*/")
    return f"{_expression(random, depth - 1)} {sign} {_expression(random, depth - 1)}"


def _declared(random: Random) -> str:
    noun = random.choice(("sensor", "actuator", "memory", "body", "skill", "curriculum", "task"))
    name = _name(random) if noun in ("sensor", "actuator", "memory") else _title(random)
    return f"{noun} {name} {'in' if noun == 'task' else 'is'} {_phrase(random, noun)}"


def _rewarded(random: Random) -> str:
    when = f" when {_expression(random, 1)} {random.choice(('<', '<=', '>', '>='))} {_expression(random, 1)}"
    on = random.choice((" per tick", f" per tick for each {_name(random)} in {_name(random)}", f" on {_event(random)}"))
    return f"  rewards {_expression(random)}{on}{when * (random.random() < 0.3)}"


def _event(random: Random) -> str:
    return _phrase(random, "event")


def _edge(random: Random) -> str:
    verb, to = random.choice((("drives", _name(random)), ("influences", _title(random))))
    return f"  {verb} {to}{f' at {_expression(random)}' * random.randrange(2)}"


def _taught(random: Random) -> str:
    more = "".join(each for each in (" from scratch", " with subskills", " population 10") if random.random() < 0.2)
    under = f" under {_title(random)}" * (random.random() < 0.3)
    return f"  teaches {_title(random)} on {_title(random)}{under} for {random.randrange(99)} generations{more}"


FORMS: Sequence[Callable[[Random], str]] = (
    _declared,
    _declared,
    _declared,
    _rewarded,
    _edge,
    _edge,
    _taught,
    lambda random: f"  reads {_name(random)}",
    lambda random: f"  contains {_name(random)} is {_phrase(random, 'content')}",
    lambda random: f"  lasts {_amount(random)}",
    lambda random: f"  ends on {_event(random)}",
    lambda random: f"  counts {_event(random)}",
    lambda random: "  stays frozen",
    lambda random: f"master {_title(random)}",
    lambda random: f"tick {_amount(random)}",
    lambda random: f'use "{random.choice(("parts.mind", "loop.mind", "", "..", "missing.mind", "/dev/zero", "a/b"))}"',
)
