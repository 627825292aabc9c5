"""Change the files of a folder from one state to another and back in a process of its own, until it is killed."""

import sys
from pathlib import Path

from mindlang.editing.transaction import change

ONE = {"a.mind": b"one\n" * 999, "a.lock": b"1\n", "weights/b.npy": b"one"}
OTHER = {"a.mind": b"other\n", "a.lock": b"2\n" * 999, "weights/b.npy": b"other", "new.mind": b"new\n"}


def files(folder: Path, state: dict[str, bytes]) -> dict[Path, bytes]:
    """A state as the files of a folder."""
    return {folder / name: data for name, data in state.items()}


def main(folder: Path) -> None:
    """Change them for ever."""
    print("ready", flush=True)
    while True:
        for state in (OTHER, ONE):
            change(folder, files(folder, state), keeps=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
