"""The examples of the rules as whole minds: what they leave out is added, further files stand below `-- NAME --`."""

import re
from collections.abc import Callable
from pathlib import Path

Told = tuple[str, ...]  # the part of the text, the message, what to do, and other parts that it names
Tell = Callable[[str, str], list[Told]]

BASE = (
    "tick 1/60 s\n",
    "master Go\n",
    "body Robot is disc\n",
    "actuator left_wheel is wheel side left neutral 0.5\nactuator right_wheel is wheel side right neutral 0.5\n",
    "skill Go is rule\n  drives left_wheel at 1\n  drives right_wheel at 1\n",
)


def whole(text: str, folder: Path) -> Path:
    """The main file of an example, written into a folder with the others."""
    main, *others = re.split(r"^-- (\S+) --\n", text.lstrip("\n"), flags=re.M)
    for name, content in zip(others[::2], others[1::2], strict=True):
        (folder / name).write_text(content)
    path = folder / "mind.mind"
    said = {line.split()[0] for line in main.splitlines() if line.strip()}
    path.write_text("".join(part for part in BASE if part.split()[0] not in said) + main)
    return path
