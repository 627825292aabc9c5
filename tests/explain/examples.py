"""The examples of errors as whole minds: what they do not declare is added below them, in a folder with their files."""

import re
from pathlib import Path

from mindlang.explaining.article import Article

WHOLE = {
    "empty-file",
    "no-tick",
    "no-master",
    "no-body",
    "foreign-drive",
    "second-steering",
}  # whose examples are whole minds
ENVIRONMENTS = "Environments"  # a chapter whose examples are, too
SETTINGS = ("tick 1/60 s", "master {master}")
DECLARATIONS = (
    "body Robot is disc",
    "actuator left_wheel is wheel side left neutral 0.5",
    "actuator right_wheel is wheel side right neutral 0.5",
    "sensor eyes is range_finder at 0 90 deg",
    "sensor front is range_finder at 0 deg",
    "memory mood is cell decay 0.95",
    "skill Go is rule\n  influences Avoid at 1",
    "skill Avoid is mlp hidden 2\n  reads eyes\n  drives left_wheel\n  drives right_wheel",
)
# A mind in which the examples of kinds and words stand: what they do not say themselves is added.
AROUND = (
    "tick 1/60 s",
    "master Go",
    "body Robot is disc size 2",
    "actuator glow is lamp neutral 0",
    "sensor moving is inertial range 2",
    "sensor battery is battery",
    "sensor feelers is range_finder at -45 0 45 deg",
    "sensor left is reading 1 of feelers",
    "sensor right is reading 3 of feelers",
    "skill Go is rule\n  drives glow at 0",
    "task World in arena size 60\n  contains gem is item\n  contains dock is power size 5\n  contains mate is robot\n"
    "  lasts 60 s",
)
ALONE = ("tick", "master", "body")  # of which a mind has one, whatever its name
TASK = "task Roam in arena size 50\n  lasts 60 s"


def write_among(text: str, folder: Path) -> Path:
    """An example of a kind or a word in a mind around it, written into a folder with its other files."""
    main, *others = re.split(r"^-- (\S+) --\n", text, flags=re.M)
    for name, content in zip(others[::2], others[1::2], strict=True):
        (folder / name).write_text(content, encoding="utf-8")
    declared = {_declared(line) for line in main.splitlines() if not line.startswith(" ")}
    is_whole = "gymnasium" in main
    lines = [main, *(each for each in AROUND if not is_whole and _declared(each) not in declared)]
    path = folder / "mind.mind"
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")
    return path


def _declared(line: str) -> str:
    """What a line declares: a noun and a name, or what a mind has one of."""
    noun, name = line.split()[:2]
    return noun if noun in ALONE else f"{noun} {name}"


def write(explanation: Article, text: str, folder: Path) -> Path:
    """The main file of an example, written into a folder with the others."""
    main, *others = re.split(r"^-- (\S+) --\n", text, flags=re.M)
    for name, content in zip(others[::2], others[1::2], strict=True):
        (folder / name).write_text(content, encoding="utf-8")
    path = folder / "mind.mind"
    path.write_text(
        main if explanation.name in WHOLE or explanation.chapter == ENVIRONMENTS else completed(main), encoding="utf-8"
    )
    return path


def completed(text: str) -> str:
    """An example with what every mind needs and it does not say."""
    declared = re.findall(r"^(?!\s)(\w+ \S+)", text, flags=re.M)
    nouns = {words.split()[0] for words in declared}
    tasks = () if "task" in nouns or "curriculum" not in nouns else (TASK,)
    lines = [line.format(master="Go") for line in SETTINGS if line.split()[0] not in nouns]
    for line in (*DECLARATIONS, *tasks):
        noun, name = line.split()[:2]
        if f"{noun} {name}" not in declared and not (noun == "body" and "body" in nouns):
            lines.append(line)
    return "\n".join([text, *lines, ""])
