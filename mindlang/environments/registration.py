"""Tasks under names that `gymnasium.make` and `gymnasium.make_vec` know."""

from pathlib import Path
from typing import Any

import gymnasium

PACKAGE = "mindlang.environments"
ANY_TASK = "Mind-v0"  # of any mind: its file is an argument, and so is the task


def register(file: str | Path) -> list[str]:
    """Register every task of a mind, and say as which: the task Collect is "mind/Collect-v0".

    What TaskEnv and TaskVectorEnv take, `make` and `make_vec` take too. A name may have no "+": "." stands for it.
    """
    from mindlang.api import load  # not for `register_any`, which whoever imports this room waits for

    path = Path(file).absolute()
    tasks = {f"mind/{task.name.replace('+', '.')}-v0": task.name for task in load(path).graph.tasks}
    for name, task in tasks.items():
        _register(name, {"file": str(path), "task": task})
    return [*tasks]


def register_any() -> None:
    """Register ANY_TASK: `gymnasium.make("mindlang.environments:Mind-v0", file="collect.mind", task="Collect")`."""
    _register(ANY_TASK, {})


def _register(name: str, words: dict[str, Any]) -> None:
    """Register it, unless it is: the same mind may be registered twice, in a notebook for one."""
    known = gymnasium.registry.get(name)
    if known is None or known.kwargs != words:
        gymnasium.register(
            id=name,
            entry_point=f"{PACKAGE}.task_env:TaskEnv",
            vector_entry_point=f"{PACKAGE}.task_env:TaskVectorEnv",
            kwargs=words,
        )
