"""What is kept of a run: its curve, the champion of each attempt and its result, in `logs/FILE/LESSON/`."""

import csv
from dataclasses import dataclass
from pathlib import Path
from shutil import copyfile
from typing import Any

import numpy as np
from mindrun.graph.weights import Weights
from mindrun.train.progress import read_progress
from mindrun.train.run_folder import CHAMPIONS, RESULT, read_result

COLUMNS = ("attempt", "generation", "best", "reevaluated", "verdict")
CURVE = "curve.csv"


@dataclass(frozen=True, slots=True)
class Log:
    """The log of a lesson; `result` is what `mindc train --json` said of it."""

    folder: Path
    result: dict[str, Any]

    @property
    def lesson(self) -> str:
        """The lesson's name."""
        return self.folder.name

    @property
    def curve(self) -> Path:
        """The file of the scores of a run, a line per generation."""
        return self.folder / CURVE

    @property
    def champions(self) -> Weights:
        """The best weights of each attempt [attempts, weights]."""
        champions: Weights = np.load(self.folder / CHAMPIONS, allow_pickle=False)
        return champions


def logs_of(folder: Path, file: str) -> dict[str, Log]:
    """The logs of a file's lessons, by lesson, in the order in which they were taught."""
    paths = sorted(path.parent for path in (folder / "logs" / Path(file).stem).glob(f"*/{RESULT}"))
    logs = [Log(path, result) for path in paths if (result := read_result(path))]
    return {log.lesson: log for log in sorted(logs, key=lambda log: Path(log.result["run"]).name)}


def keep(run: Path, folder: Path, file: str) -> None:
    """Keep the log of a run beside the file in `folder`, if it has finished."""
    if (result := read_result(run)) is None:
        return
    kept = folder / "logs" / Path(file).stem / result["lesson"]
    kept.mkdir(parents=True, exist_ok=True)
    with (kept / CURVE).open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows([_short(record[column]) for column in COLUMNS] for record in read_progress(run))
    for name in (CHAMPIONS, RESULT):
        copyfile(run / name, kept / name)


def _short(value: float | None) -> str:
    return "" if value is None else f"{value:.6g}"
