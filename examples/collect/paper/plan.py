"""How much of the paper's protocol was taught: asked for once, and kept with the logs."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from mindrun.files.atomic_write import write
from mindrun.graph.graph import Lesson
from mindrun.train.lesson_state import heights
from protocol import FILES

from mindlang.training.lesson_choice import TrainOptions

PLAN = Path("logs") / "plan.json"


@dataclass(frozen=True, slots=True)
class Plan:
    """Attempts of the lessons of collect.mind and of the others, times the paper's generations, genomes, the seed.

    With `rungs` attempts are compared early, and the worse half of them ends there.
    """

    attempts: int
    others: int
    scale: float
    population: int | None
    seed: int
    rungs: int = 0

    def options(self, file: str) -> TrainOptions:
        """What is asked of a file's lessons."""
        attempts = self.attempts if file == FILES[0] else self.others
        return TrainOptions(scale=self.scale, population=self.population, attempts=attempts, rungs=self.rungs)

    def applied(self, file: str, lesson: Lesson) -> Lesson:
        """A lesson of a file as it is taught."""
        return self.options(file).applied(lesson)

    def __str__(self) -> str:
        """The words for `make paper-train`, which leaves the population as the files say."""
        return f"ATTEMPTS={self.attempts} OTHERS={self.others} SCALE={self.scale:g} SEED={self.seed} RUNGS={self.rungs}"

    @property
    def text(self) -> str:
        """In a report: what is scaled down, and how to read the paper's names of the rows."""
        scaled = "At the paper's scale" if self.scale >= 1 else "Scaled down"
        times = "all" if self.scale == 1 else f"{self.scale:g} times"
        genomes = "" if self.population is None else f" Every generation has {self.population} genomes."
        avoid = f'"Avoid 1000 generations" is {1000 * self.scale:g} here, "2500" is {2500 * self.scale:g}'
        shares = ", ".join(f"{height:.3g}" for height in heights(self.rungs))
        ended = f" Those in the worse half after {shares} of their generations ended there." if self.rungs else ""
        return (
            f"**{scaled}.** Every lesson has {times} the paper's generations, in {self.attempts} attempts for the "
            f"lessons of {FILES[0]} and {self.others} for all others, from seed {self.seed}.{ended}{genomes} The rows "
            f"keep the paper's names: {avoid}."
        )


def read_plan(folder: Path) -> Plan | None:
    """The plan by which a folder was taught; None where there is none."""
    try:
        return Plan(**json.loads((folder / PLAN).read_text(encoding="utf-8")))
    except FileNotFoundError:
        return None


def keep_plan(folder: Path, plan: Plan) -> None:
    """Write the plan by which a folder is taught."""
    (folder / PLAN).parent.mkdir(parents=True, exist_ok=True)
    write(folder / PLAN, json.dumps(asdict(plan)).encode() + b"\n")
