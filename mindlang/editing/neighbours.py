"""Files beside those of an edit that use one of them, and would no longer compile."""

from collections.abc import Iterator

from mindlang.compile import load
from mindlang.editing.carry_out import Edited


def broken(edited: Edited) -> Iterator[str]:
    """A sentence for each file that compiles now and would not after the edit."""
    main = edited.project.main.source.path
    folders = {path.parent for path in edited.texts}
    for path in sorted(file for folder in folders for file in folder.glob("*.mind") if file != main):
        if (now := load(path)).graph is None or not ({source.path for source in now.sources} & edited.texts.keys()):
            continue
        after = load(path, edited.texts)
        if after.graph is None:
            yield f"{path.name} would no longer compile by itself: {after.diagnostics[0].message}"
