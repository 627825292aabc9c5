"""What is kept of a run: its curve, the champion of each attempt and its result, in `logs/FILE/LESSON/`."""

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from shutil import copyfile
from typing import Any

from mindrun.train.progress import read

COLUMNS = ("attempt", "generation", "best", "reevaluated", "verdict")
CURVE, CHAMPIONS, RESULT = "curve.csv", "champions.npy", "result.json"


@dataclass(frozen=True, slots=True)
class Log:
    """The log of a lesson."""

    folder: Path

    @property
    def lesson(self) -> str:
        """The lesson's name."""
        return self.folder.name

    @property
    def result(self) -> dict[str, Any]:
        """What came of it."""
        result: dict[str, Any] = json.loads((self.folder / RESULT).read_text(encoding="utf-8"))
        return result

    @property
    def curve(self) -> Path:
        """Its scores, a line per generation."""
        return self.folder / CURVE

    @property
    def champions(self) -> Path:
        """The best weights of each attempt."""
        return self.folder / CHAMPIONS


def logs_of(folder: Path, file: str) -> dict[str, Log]:
    """The logs of a file's lessons, by lesson, in the order in which they were taught."""
    kept = [Log(path.parent) for path in (folder / "logs" / Path(file).stem).glob(f"*/{RESULT}")]
    return {log.lesson: log for log in sorted(kept, key=lambda log: str(log.result["run"]).rpartition("/")[2])}


def keep(run: Path, folder: Path, file: str) -> Log:
    """Keep the log of a finished run beside the file in `folder`."""
    result = json.loads((run / "result.json").read_text(encoding="utf-8"))
    log = Log(folder / "logs" / Path(file).stem / result["lesson"])
    log.folder.mkdir(parents=True, exist_ok=True)
    with log.curve.open("w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows([_short(record[column]) for column in COLUMNS] for record in read(run))
    copyfile(run / "champions.npy", log.champions)
    (log.folder / RESULT).write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    return log


def _short(value: float | None) -> str:
    return "" if value is None else f"{value:.6g}"
