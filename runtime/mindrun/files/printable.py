"""Text from outside, shown on a terminal."""

from unicodedata import category


def visible(text: str) -> str:
    """The text with control and direction characters spelt out, so that a terminal shows what is there."""
    return text if text.isascii() and text.isprintable() else "".join(map(_visible, text))


def _visible(character: str) -> str:
    if character == "\t":
        return "    "
    if category(character) in {"Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"}:
        return f"\\u{ord(character):04x}"
    return character
