"""A task as a Gymnasium environment: one robot, or many side by side. Needs the extra `gymnasium`.

Where several robots are in one world, `ParallelTask` is an environment of PettingZoo: the extra `pettingzoo`.

from mindlang import environments
environments.register("collect.mind")
env = gymnasium.make("mind/Collect-v0")
many = gymnasium.make_vec("mind/Collect-v0", num_envs=1024)
"""

from contextlib import suppress
from importlib import import_module
from typing import TYPE_CHECKING, Any

from mindrun.errors import MindError
from mindrun.lazy_import import lazy_names

if TYPE_CHECKING:
    from mindlang.environments.parallel_task import ParallelTask as ParallelTask
    from mindlang.environments.registration import register as register
    from mindlang.environments.stable_baselines import StableBaselinesEnv as StableBaselinesEnv
    from mindlang.environments.task_env import TaskEnv as TaskEnv
    from mindlang.environments.task_env import TaskVectorEnv as TaskVectorEnv

__all__ = ["ParallelTask", "StableBaselinesEnv", "TaskEnv", "TaskVectorEnv", "register"]
_found = lazy_names(
    __name__,
    {
        f"{__name__}.registration": ("register",),
        f"{__name__}.task_env": ("TaskEnv", "TaskVectorEnv"),
        f"{__name__}.stable_baselines": ("StableBaselinesEnv",),
        f"{__name__}.parallel_task": ("ParallelTask",),
    },
)
EXTRAS = {
    "gymnasium": "pip install 'mindlang[gymnasium]'",
    "pettingzoo": "pip install 'mindlang[pettingzoo]'",
    "stable_baselines3": "pip install 'mindlang[sb3]'",
}


with suppress(ModuleNotFoundError):  # whatever is asked for then says so
    import_module(f"{__name__}.registration").register_any()


def __getattr__(name: str) -> Any:
    try:
        return _found(name)
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in EXTRAS:
            raise
        raise MindError(f"{name} needs {package}", EXTRAS[package]) from error
