"""The Python functions that a procedure can be, read from the text of the modules beside a file; nothing is run."""

import re
from pathlib import Path

_FUNCTION = re.compile(r"^def ([a-z]\w*)\(", re.MULTILINE)
MOST = 100  # modules that are read


def functions(folder: Path) -> list[str]:
    """`module.function` for each function of the modules in a folder that has a name of the language."""
    found = []
    for path in sorted(folder.glob("[a-z]*.py"))[:MOST]:
        try:
            text = path.read_text(encoding="utf-8", errors="replace")
        except OSError:
            continue
        found += [f"{path.stem}.{name}" for name in _FUNCTION.findall(text)]
    return found
