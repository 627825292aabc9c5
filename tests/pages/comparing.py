"""Whether a command has printed what its page shows: exactly, but for what another machine measures otherwise."""

import re

# How long and how fast it was here, when, and on how many cores.
MEASURED = re.compile(
    r"\d[\d,.]*(?: [kM])? ticks(?:/s| per CPU second)|\d[\d,.]* (?:ms|s|min)\b|\d{8}T\d{6}Z|on \d+ cores?"
)
# What is said while something takes long: a line every few seconds, on a page none.
MEANWHILE = re.compile(
    r"(?:\S+: (?:attempt \d+ of \d+, )?generation \d+ of \d+.*|compiling (?:the simulator|the stages of a tick).*)\n"
)


def fits(shown: str, printed: str) -> bool:
    """… stands for anything within a line, and on a line of its own for any lines."""
    pattern = re.escape(f"\n{_comparable(shown)}").replace("\\\n…\\\n", "\n(?:.*\n)*").replace("…", ".*")
    return re.fullmatch(pattern, f"\n{_comparable(printed)}") is not None


def _comparable(text: str) -> str:
    """A text without what is measured, and without blanks at the ends of its lines and blank lines at its end."""
    text = MEASURED.sub("‹measured›", MEANWHILE.sub("", text))
    return re.sub(r" +$", "", text, flags=re.MULTILINE).rstrip("\n") + "\n"
