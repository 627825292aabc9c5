"""The paper's protocol: what is taught in which order, when an attempt has succeeded, and what the paper reports."""

from dataclasses import dataclass
from pathlib import Path

FOLDER = Path(__file__).resolve().parent.parent

# In the order in which one needs what another has learnt. The first is taught in all attempts, the others in `OTHERS`.
FILES = (
    "collect.mind",
    "on_the_job.mind",
    "avoid_longer.mind",
    "monolith.mind",
    "final_task.mind",
    "power.mind",
    "power_on_the_job.mind",
    "constant_skills.mind",
)

# What a champion must count in a run, on the mean over fresh layouts, for its attempt to have succeeded. Turning always
# the same way until the target is ahead reaches 18 to 22 targets, the paper's failed attempts.
SUCCESS = {
    "GoToObject": 25.0,
    "GoToDropZone": 25.0,
    "Avoid": 100.0,
    "GoToObject+Avoid": 5.0,
    "GoToDropZone+Avoid": 5.0,
    "Collect": 4.63,
}


@dataclass(frozen=True, slots=True)
class Reported:
    """What the paper reports of a structure: objects in a run, and where a collision ends it the share of its time."""

    objects: float
    runtime: float | None = None

    def __str__(self) -> str:
        """As in the paper's tables."""
        return f"{self.objects:.2f}" + (f" ({self.runtime:.0%})" if self.runtime is not None else "")


@dataclass(frozen=True, slots=True)
class Case:
    """A row of a table: a mind on a task under a master, and what the paper reports."""

    name: str
    file: str
    master: str
    task: str
    paper: Reported
    interrupt: bool = True


@dataclass(frozen=True, slots=True)
class Table:
    """A table of the paper."""

    number: int
    title: str
    cases: tuple[Case, ...]


def _structures(interrupt: bool, *paper: Reported) -> tuple[Case, ...]:
    named = (
        ("hierarchical, curriculum", "collect.mind", "Collect"),
        ("hierarchical, final task only", "final_task.mind", "Collect"),
        ("monolithic, curriculum", "monolith.mind", "Monolith"),
        ("monolithic, final task only", "final_task.mind", "Monolith"),
    )
    return tuple(
        Case(name, file, master, "Collect", reported, interrupt)
        for (name, file, master), reported in zip(named, paper, strict=True)
    )


TABLES = (
    Table(
        1,
        "ends on collision",
        _structures(True, Reported(4.63, 0.54), Reported(0.06, 0.51), Reported(5.19, 0.68), Reported(0.31, 0.80)),
    ),
    Table(1, "no interruption", _structures(False, Reported(9.55), Reported(0.18), Reported(7.70), Reported(0.39))),
    Table(
        2,
        "versions of Avoid, ends on collision",
        (
            Case("monolithic", "monolith.mind", "Monolith", "Collect", Reported(5.19, 0.68)),
            Case("Avoid 1000 generations", "collect.mind", "Collect", "Collect", Reported(4.63, 0.54)),
            Case("Avoid 2500 generations", "avoid_longer.mind", "Collect", "Collect", Reported(5.31, 0.56)),
            Case("Avoid 1500 generations, on the job", "on_the_job.mind", "Collect", "Collect", Reported(6.03, 0.90)),
        ),
    ),
    Table(
        3,
        "with power management, ends on collision and exhaustion",
        tuple(
            Case(f"{variant}, {avoid} Avoid", file, master, "CollectWithPower", reported)
            for variant, avoid, file, master, reported in (
                ("retrained", "original", "power.mind", "CollectAndPower", Reported(1.73, 0.28)),
                ("retrained", "on-the-job", "power_on_the_job.mind", "CollectAndPower", Reported(3.99, 0.69)),
                ("encapsulated", "original", "power.mind", "CollectWithPower", Reported(1.62, 0.36)),
                ("encapsulated", "on-the-job", "power_on_the_job.mind", "CollectWithPower", Reported(3.73, 0.90)),
            )
        ),
    ),
)
