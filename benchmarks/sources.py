"""Sources that nobody meant well: `source(case)` is the text of a case, the same on every machine.

They are made of the minds of the examples and tests: mutated by token, line, number and character, mixed, or written
by the grammar out of the registered kinds. Most are small, so that a million take a night and not a week.
"""

import re
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from random import Random

from mindrun.registry import arguments, kinds

from mindlang.compiler.parse.explain import FOREIGN_WORDS
from mindlang.compiler.syntax import NOUNS, SETTINGS, VERBS
from mindlang.rules import all_rules

ROOT = Path(__file__).parents[1]
PIECE = re.compile(r"\w+|\s+|.", re.DOTALL)
NUMBER = re.compile(r"[0-9]+(?:\.[0-9]+)?(?:/[0-9]+)?")
BASE = (
    "tick 1/60 s\n",
    "master Go\n",
    "body Robot is disc\n",
    "actuator left_wheel is wheel side left neutral 0.5\nactuator right_wheel is wheel side right neutral 0.5\n",
    "skill Go is rule\n  drives left_wheel at 1\n  drives right_wheel at 1\n",
)
NUMBERS = (
    *("0", "1", "2", "-1", "0.5", "1/60", "1/0", "0/0", "1e3", "7.", ".5", "0.0000001", "1/3", "-0", "+1", "999999999"),
    *("1_000", "٣", "²", "9" * 40, "9" * 400, "0." + "9" * 40, "1/" + "9" * 330, "60%", "90 deg", "3 s", "10 ticks"),
)
ODD = (
    *("\0", "\r", "\r\n", "\t", "\v", "\f", "\x1c", "\x85", "\u2028", "\u202e", "\u200b", "\ufeff", "\u00a0", "\ud800"),
    *(
        "é",
        "ß",
        "ﬁ",
        "Ⅻ",
        "😀",
        "ǅ",
        "е",
        "ı",
        "#",
        '"',
        "'",
        "`",
        "(",
        ")",
        "{",
        "}",
        "[",
        "]",
        ",",
        ";",
        ":",
        ".",
        "\\",
    ),
    *(
        "=",
        "==",
        "<",
        "<=",
        "!",
        "?",
        "%",
        "%s",
        "{0}",
        "{here}",
        "+",
        "-",
        "--",
        "*",
        "**",
        "/",
        "//",
        "<!--",
        "\x1b[2J",
    ),
)
WORDS = (
    *("is", "in", "at", "on", "per", "tick", "for", "each", "when", "under", "from", "scratch", "with", "subskills"),
    *("to", "by", "of", "toward", "over", "frozen", "s", "deg", "ticks", "generations", "true", "None", "self", "not"),
    *("Go", "Go+Stop", "ball", "left_wheel", "eye", "mood", "sensor.x", "A", "a", "_a", "a_", "A_b", "module.function"),
    *NOUNS, *VERBS, *SETTINGS,
)  # fmt: skip


def source(case: int) -> str:
    """The text of a case."""
    random = Random(case)
    make = random.choices((mutated, mixed, written, garbage), (50, 20, 25, 5))[0]
    return make(random)


@cache
def minds() -> tuple[str, ...]:
    """The small minds that are mutated most: the examples of the rules, most of which compile."""
    rules = (text for rule in all_rules().values() for text in (*rule.good, *rule.bad))
    return tuple(whole(text.partition("\n-- ")[0]) for text in rules)


@cache
def long_minds() -> tuple[str, ...]:
    """The examples, the minds that edits are tried on, and those that are wrong in one line."""
    folders = (ROOT / "examples", ROOT / "tests" / "edits" / "minds", ROOT / "tests" / "language")
    files = sorted(path for folder in folders for path in folder.rglob("*.mind"))
    return tuple(path.read_text(encoding="utf-8", errors="replace") for path in files)


@cache
def lines() -> tuple[str, ...]:
    """Every line of all minds, each once."""
    return tuple(dict.fromkeys(line for mind in (*minds(), *long_minds()) for line in mind.split("\n") if line.strip()))


def whole(text: str) -> str:
    """A text with what every mind needs and it leaves out."""
    said = {line.split()[0] for line in text.splitlines() if line.strip()}
    return "".join(part for part in BASE if part.split()[0] not in said) + text.lstrip("\n")


def mutated(random: Random) -> str:
    """A mind, or a few lines of one, with one to four mutations; of a hundred one is long."""
    text = random.choice(long_minds() if random.random() < 0.01 else minds())
    if random.random() < 0.5:
        of = text.split("\n")
        start = random.randrange(len(of))
        text = "\n".join(of[start : start + random.choice((1, 2, 3, 5))])
    for _ in range(random.choice((1, 1, 1, 1, 2, 4))):
        text = random.choice(MUTATIONS)(text, random) or " "
    return text


def mixed(random: Random) -> str:
    """Lines of all minds, alone or below a small mind."""
    text = "\n".join(random.choices(lines(), k=random.choice((1, 1, 2, 3, 9))))
    return text if random.random() < 0.6 else whole(f"{random.choice(minds())}{text}")


def written(random: Random) -> str:
    """Lines that the grammar allows, about names that most often are declared, above or below those of a small mind."""
    text = "\n".join(random.choice(FORMS)(random) for _ in range(random.choice((1, 1, 2, 3, 6))))
    if random.random() < 0.1:
        text = random.choice(MUTATIONS)(text, random)
    if random.random() < 0.5:
        return text
    return random.choice((f"{random.choice(minds())}{text}", f"{text}\n{random.choice(minds())}", whole(text)))


def garbage(random: Random) -> str:
    """Words, signs and characters in any order."""
    count = random.choice((1, 3, 10, 40))
    pieces = (random.choice((WORDS, ODD, NUMBERS, (" ", "\n", "  "))) for _ in range(count))
    return "".join(random.choice(each) + random.choice(("", " ")) for each in pieces)


Mutation = Callable[[str, Random], str]


def _at(text: str, random: Random) -> int:
    return random.randrange(len(text) + 1)


def _character(text: str, random: Random) -> str:
    at = _at(text, random)
    return text[:at] + random.choice(ODD) + text[at + random.randrange(2) :]


def _flipped(text: str, random: Random) -> str:
    at = random.randrange(max(len(text), 1))
    return text[:at] + "".join(chr(ord(c) ^ 1 << random.randrange(8)) for c in text[at : at + 1]) + text[at + 1 :]


def _cut(text: str, random: Random) -> str:
    at = _at(text, random)
    return text[:at] + text[at + random.choice((1, 2, 5, 20, 100)) :]


def _token(text: str, random: Random) -> str:
    words = PIECE.findall(text) or [" "]
    at = random.randrange(len(words))
    match random.randrange(5):
        case 0:
            words[at] = ""
        case 1:
            words[at] *= 2
        case 2:
            words[at] = random.choice(words)
        case 3:
            words[at] = random.choice(WORDS)
        case _:
            words.insert(at, f" {random.choice(WORDS)} ")
    return "".join(words)


def _number(text: str, random: Random) -> str:
    found = list(NUMBER.finditer(text))
    if not found:
        return _token(text, random)
    start, end = random.choice(found).span()
    return text[:start] + random.choice(NUMBERS) + text[end:]


def _line(text: str, random: Random) -> str:
    of = text.split("\n")
    at, other = random.randrange(len(of)), random.randrange(len(of))
    match random.randrange(6):
        case 0:
            del of[at]
        case 1:
            of.insert(other, of[at])
        case 2:
            of[at], of[other] = of[other], of[at]
        case 3:
            of.insert(at, random.choice(lines()))
        case 4:
            of[at] += of[other]
        case _:
            of.insert(at, random.choice(FORMS)(random))
    return "\n".join(of)


def _word(text: str, random: Random) -> str:
    """What people write instead of a word of the language."""
    known = random.choice(list(FOREIGN_WORDS))
    return text.replace(known, random.choice(FOREIGN_WORDS[known].split()), random.choice((-1, 1)))


def _ends(text: str, random: Random) -> str:
    return text.replace("\n", random.choice(("\r\n", "\r", "\n\n", "\n\t", " # \n", "\u2028")))


MUTATIONS: tuple[Mutation, ...] = (_character, _flipped, _cut, _token, _token, _token, _number, _number, _line, _line,
                                   _word, _ends)  # fmt: skip


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
            return random.choice([*getattr(type_, "words", ()), _name(random), "module.function"])
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
