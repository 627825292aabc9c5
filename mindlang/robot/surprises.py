"""What looks like one thing and is another to YAML: `no` is false, 12:30 is 750, 1e3 is a word. None of it is taken."""

import re
from collections.abc import Callable

Answer = tuple[str, str, str]  # code, message, hint
QUOTES = 'Where a word is meant, write it in quotes: "{}".'


def surprise(text: str) -> Answer | None:
    """What is surprising about a text without quotes, if something is."""
    for pattern, answer in WHOLE:
        if pattern.fullmatch(text):
            return answer(text)
    if text[:1] in "+-.0123456789":
        for word in text.split():
            for pattern, answer in NUMBERS:
                if pattern.fullmatch(word):
                    return answer(word)
    return None


def _boolean(text: str) -> Answer:
    meant = "true" if text.lower() in ("yes", "on", "true") else "false"
    hint = f"Write {meant}. {QUOTES.format(text)}"
    return "yaml-boolean", f"To YAML {text} is {meant}, and not a word.", hint


def _nothing(text: str) -> Answer:
    return "yaml-null", f"To YAML {text} is nothing.", f"Leave the line out. {QUOTES.format(text)}"


def _clock(text: str) -> Answer:
    total = 0.0
    for part in text.split(":"):
        total = 60 * total + float(part)
    message = f"To YAML {text} is the number {total:.15g}, as minutes and seconds are."
    return "yaml-clock", message, f"Write a time in seconds: {total:.15g} s. {QUOTES.format(text)}"


def _date(text: str) -> Answer:
    return "yaml-date", f"To YAML {text} is a date.", f'Write it in quotes: "{text}".'


def _exponent(text: str) -> Answer:
    hint = "Write all digits" + (f": {_decimal(text)}." if len(_decimal(text)) <= 20 else ".")
    return "yaml-exponent", f"To YAML {text} is a number or a word: its versions differ.", hint


def _decimal(text: str) -> str:
    number = float(text.replace("_", ""))
    if abs(number) > 1e15 or 0 < abs(number) < 1e-9:
        return "9" * 21
    return f"{number:.12f}".rstrip("0").rstrip(".")


def _octal(text: str) -> Answer:
    digits = re.sub("^[-+]?0[ob]?", "", text).replace("_", "")
    base = 2 if "b" in text else 8
    message = f"To YAML {text} is a number of base {base} or 10: its versions differ."
    try:
        value = int(digits, base) if len(digits) < 30 else None
    except ValueError:
        value = None
    decimal = digits.lstrip("0") or "0"
    meant = decimal if value is None or text.lstrip("+-")[1:2] not in "ob" else str(value)
    other = f", or {value} where base {base} is meant" if value is not None and meant == decimal != str(value) else ""
    return "yaml-base", message, f"Write {meant}{other}."


def _underscore(text: str) -> Answer:
    return (
        "yaml-underscore",
        f"To YAML {text} is a number or a word: its versions differ.",
        (f"Write {text.replace('_', '')}."),
    )


def _infinite(text: str) -> Answer:
    return "yaml-infinite", f"To YAML {text} is no number that can be measured or sent.", "Write a number with digits."


def _dotted(text: str) -> Answer:
    sign = "-" if text[0] == "-" else ""
    whole, _, part = text.lstrip("+-").partition(".")
    hint = f"Write {sign}{whole or '0'}{'.' * bool(part)}{part}."
    return "yaml-number", f"{text} is not how a number is written here.", hint


def _patterns(*pairs: tuple[str, Callable[[str], Answer]]) -> list[tuple[re.Pattern[str], Callable[[str], Answer]]]:
    return [(re.compile(pattern), answer) for pattern, answer in pairs]


WHOLE = _patterns(
    (r"(?i:yes|no|on|off)|True|TRUE|False|FALSE", _boolean),
    (r"~|null|Null|NULL", _nothing),
    (r"[-+]?[0-9]{1,9}(:[0-5]?[0-9]){1,9}(\.[0-9]{0,9})?", _clock),
    (r"[0-9]{4}-[0-9]{1,2}-[0-9]{1,2}([Tt \t].*)?", _date),
)
NUMBERS = _patterns(
    (r"[-+]?[0-9][0-9_]*(\.[0-9_]*)?[eE][-+]?[0-9]{1,9}|[-+]?\.[0-9_]+[eE][-+]?[0-9]{1,9}", _exponent),
    (r"[-+]?0[ob][0-9_]+|[-+]?0[0-9_]+", _octal),
    (r"[-+]?(0x[0-9a-fA-F_]*_[0-9a-fA-F_]*|[0-9][0-9_]*_[0-9_]*(\.[0-9_]*)?)", _underscore),
    (r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)", _infinite),
    (r"[-+]?\.[0-9]+|[-+]?[0-9]+\.|\+[0-9]+(\.[0-9]+)?", _dotted),
)
