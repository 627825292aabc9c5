"""Tasks under names that `gymnasium.make` and `gymnasium.make_vec` know."""

from pathlib import Path

import gymnasium

from mindlang.api import load

PACKAGE = "mindlang.environments"


def register(file: str | Path) -> list[str]:
    """Register every task of a mind, and say as which: the task Collect is "mind/Collect-v0".

    What TaskEnv and TaskVectorEnv take, `make` and `make_vec` take too. A name may have no "+": "." stands for it.
    """
    path = Path(file).absolute()
    names = []
    for task in load(path).graph.tasks:
        names.append(f"mind/{task.name.replace('+', '.')}-v0")
        gymnasium.register(
            id=names[-1],
            entry_point=f"{PACKAGE}.task_env:TaskEnv",
            vector_entry_point=f"{PACKAGE}.task_vector_env:TaskVectorEnv",
            kwargs={"file": str(path), "task": task.name},
        )
    return names
