"""Maps in the forms of others, recognised: what they are, and how one becomes a text of # and . and letters."""

import re

from mindrun.kinds.things.map import FLOOR, WALL

PICTURES = re.compile(rb"P[1-6]\s|\x89PNG|\xff\xd8\xff|GIF8|BM")
ROS = re.compile(r"^\s*(image|resolution|occupied_thresh)\s*:", re.M)
DRAWING = re.compile(r"[+o]-{2,}[+o]")  # two posts and the wall between them
SQUARES = f"A map is a text: a line for each row of squares, {WALL} where one is wall and {FLOOR} where it is floor"

Recognised = tuple[str, str]  # what it is, to go on after its name, and what to do


def recognise_bytes(data: bytes) -> Recognised | None:
    """A picture."""
    if not PICTURES.match(data):
        return None
    return (
        "is a picture",
        f"{SQUARES}. Make one of its pixels, darker ones {WALL}, and write how wide a pixel is as cell.",
    )


def recognise_text(text: str) -> Recognised | None:
    """The YAML file of a map of ROS, or a maze drawn with posts and lines, as those of micromouse contests are."""
    if len({found.group(1) for found in ROS.finditer(text)}) > 1:
        hint = f"{SQUARES}. Make one of the pixels of its image, darker ones {WALL}, and write its resolution as cell."
        return "is the YAML file of a map of ROS, and no drawing", hint
    if DRAWING.search(text):
        hint = f"Leave out every second column, then let + - | become {WALL} and blanks {FLOOR}:"
        return "is a maze drawn with + - |", rf"{hint} sed 's/\(.\)./\1/g; s/[-+o|]/{WALL}/g; s/ /{FLOOR}/g'."
    return None
