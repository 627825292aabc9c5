"""The examples of errors as whole minds: what they do not declare is added below them, in a folder with their files."""

import re
from pathlib import Path

from mindlang.explaining.explanation import Explanation

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
TASK = "task Roam in arena size 50\n  lasts 60 s"


def write(explanation: Explanation, text: str, folder: Path) -> Path:
    """The main file of an example, written into a folder with the others."""
    main, *others = re.split(r"^-- (\S+) --\n", text, flags=re.M)
    for name, content in zip(others[::2], others[1::2], strict=True):
        (folder / name).write_text(content, encoding="utf-8")
    path = folder / "mind.mind"
    path.write_text(
        main if explanation.code in WHOLE or explanation.chapter == ENVIRONMENTS else completed(main), encoding="utf-8"
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
