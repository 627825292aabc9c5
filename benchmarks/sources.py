"""Sources that nobody meant well: `source(case)` is the text of a case, the same on every machine.

They are made of the minds of the examples and tests: mutated by token, line, number and character, mixed, or written
by the grammar out of the registered kinds. Most are small, so that a million take a night and not a week.
"""

import re
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from random import Random

from benchmarks.grammar_lines import NUMBERS, line
from mindlang.compiler.parse.explain import common_mistakes
from mindlang.compiler.syntax import NOUNS, SETTINGS, VERBS
from mindlang.explaining.collection import RULE, codes

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
ODD = (
    *("\0", "\r", "\r\n", "\t", "\v", "\f", "\x1c", "\x85", "\u2028", "\u202e", "\u200b", "\ufeff", "\u00a0", "\ud800"),
    *[
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
    ],
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


def mutant_of(texts: Sequence[str], case: int) -> str:
    """The text of a case of whole minds: one of the `texts` with one to four mutations."""
    random = Random(case)
    text = random.choice(texts)
    for _ in range(random.choice((1, 1, 1, 1, 2, 4))):
        text = random.choice(MUTATIONS)(text, random) or " "
    return text


@cache
def minds() -> tuple[str, ...]:
    """The small minds that are mutated most: the examples of the rules, most of which compile."""
    rules = (text for rule in codes().values() if rule.noun == RULE for text in (*rule.right, *rule.wrong))
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
    text = "\n".join(line(random) for _ in range(random.choice((1, 1, 2, 3, 6))))
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
            of.insert(at, line(random))
    return "\n".join(of)


def _word(text: str, random: Random) -> str:
    """What people write instead of a word of the language."""
    known = random.choice(list(common_mistakes().foreign_words))
    return text.replace(known, random.choice(common_mistakes().foreign_words[known].split()), random.choice((-1, 1)))


def _ends(text: str, random: Random) -> str:
    return text.replace("\n", random.choice(("\r\n", "\r", "\n\n", "\n\t", " # \n", "\u2028")))


MUTATIONS: tuple[Mutation, ...] = (_character, _flipped, _cut, _token, _token, _token, _number, _number, _line, _line,
                                   _word, _ends)  # fmt: skip
