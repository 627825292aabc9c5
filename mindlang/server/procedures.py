"""The Python functions that a procedure can be, read from the text of the modules beside a file; nothing is run."""

import re
from pathlib import Path

from mindlang.file_search import beside, text_of

_FUNCTION = re.compile(r"^def ([a-z]\w*)\(", re.MULTILINE)
MAX_MODULES = 100  # modules that are read


def functions(folder: Path) -> list[str]:
    """`module.function` for each function of the modules in a folder that has a name of the language."""
    modules = [path for path in beside(folder, ".py") if "a" <= path.name[0] <= "z"][:MAX_MODULES]
    return [f"{path.stem}.{name}" for path in modules for name in _FUNCTION.findall(text_of(path))]
