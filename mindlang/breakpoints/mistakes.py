"""Why a line of a .break file cannot be read: a common mistake, or else what the grammar expected."""

import re
from typing import TYPE_CHECKING

from mindrun.kinds.registry import kinds

from mindlang.breakpoints.robot_events import WORDS
from mindlang.compiler.diagnostic import Diagnostic
from mindlang.compiler.parse.explain import common_mistake, unexpected
from mindlang.compiler.parse.mistakes import MISTAKES, OPENINGS, Mistake
from mindlang.compiler.source import Span

if TYPE_CHECKING:
    from lark import UnexpectedInput

EXAMPLE = "stop when holding > 0.5, stop on collision or stop in tick 812"
_FIRST_WORD = re.compile(r"\s*(\S+)")
_EVENT_KINDS = "|".join((*kinds("event"), *WORDS))
_CODES_NOT_HERE = ("two-facts",)  # what a skill influences is part of a line here

# fmt: off
OWN_MISTAKES = (
    Mistake("unfinished", r"^\s*(?P<here>stop(?:\s+(?:when|on|in(?:\s+tick)?))?)\s*$",
        "After {here} the line ends too early.", f"Write for example {EXAMPLE}.", "stop when"),
    Mistake("missing-when", r"^\s*stop\s+(?P<here>if|while|until|once|unless)\b", "A condition stands after when.",
        "Write when instead of {here}.", "stop if holding > 0.5"),
    Mistake("missing-on", rf"^\s*stop\s+(?P<here>when|at|after|if)\s+(?P<rest>(?:\d+\s+)?(?:{_EVENT_KINDS})\b[^<>]*)$",
        "An event stands after on.", "Write stop on {rest}.", "stop when collision"),
    Mistake("missing-on", rf"^\s*stop\s+(?P<here>(?:\d+\s+)?(?:{_EVENT_KINDS})\b[^<>]*)$",
        "An event stands after on.", "Write stop on {here}.", "stop collision"),
    Mistake("missing-when", r"^\s*stop\s+(?P<here>on|at)\s+(?P<rest>.*[<>].*)$",
        "A condition stands after when.", "Write stop when {rest}.", "stop on holding > 0.5"),
    Mistake("which-tick",
        r"^\s*stop\s+(?P<here>(?:at|after|on|when|in)?\s*(?:tick\s*)?[<>=]*\s*(?P<rest>\d+)\s*(?:ticks)?)\s*$",
        "In which tick it stops, is said after in tick.", "Write stop in tick {rest}.", "stop at tick 812"),
    Mistake("no-level",
        r"\binfluences\s+[\w.+]+\s+(?P<here>>=?|over|exceeds|with|by|at\s+least|more\s+than|at)\s*[\d.]",
        "How much a skill influences, is compared with above or below.", "Write above instead of {here}.",
        "stop when Avoid influences left_wheel > 50%"),
    Mistake("no-level", r"\binfluences\s+[\w.+]+\s+(?P<here><=?|under|less\s+than|at\s+most)\s*[\d.]",
        "How much a skill influences, is compared with above or below.", "Write below instead of {here}.",
        "stop when Avoid influences left_wheel < 50%"),
    Mistake("no-level", r"\b(?P<here>influences\s+[\w.+]+)\s*(?:\d.*|$)",
        "How much a skill influences, is compared with above or below.", "Write {here} above 50%.",
        "stop when Avoid influences left_wheel"),
    Mistake("capital-name", r"\bwhen\s+(?P<here>[a-z]\w*)\s+influences\b",
        "The name of a skill begins with a capital letter.", "Did you mean {title}?",
        "stop when avoid influences left_wheel above 50%"),
)
# fmt: on
_MISTAKES_HERE = (*OWN_MISTAKES, *(mistake for mistake in MISTAKES if mistake.code not in _CODES_NOT_HERE))


def explain(error: "UnexpectedInput", code: str, line: Span) -> Diagnostic:
    """Why the grammar refuses the line `code`, in the user's words."""
    return _opening(code, line) or common_mistake(_MISTAKES_HERE, code, line) or unexpected(error, code, line, EXAMPLE)


def _opening(code: str, line: Span) -> Diagnostic | None:
    """A line that does not begin with stop."""
    found = _FIRST_WORD.match(code)
    if not found or re.match(r"stop\b", found[1]):
        return None
    if not found[1][0].isalpha() and (told := common_mistake(OPENINGS, code, line)):
        return told
    here = Span(line.source, line.start + found.start(1), line.start + found.end(1))
    return Diagnostic("no-stop", "A line of a .break file begins with stop.", here, f"Write for example {EXAMPLE}.")
