"""A task as a Gymnasium environment: one robot, or many side by side. Needs the extra `gymnasium`.

from mindlang import environments
environments.register("collect.mind")
env = gymnasium.make("mind/Collect-v0")
many = gymnasium.make_vec("mind/Collect-v0", num_envs=1024)
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from mindrun.errors import MindError

if TYPE_CHECKING:
    from mindlang.environments.registration import register as register
    from mindlang.environments.stable_baselines import StableBaselinesEnv as StableBaselinesEnv
    from mindlang.environments.task_env import TaskEnv as TaskEnv
    from mindlang.environments.task_vector_env import TaskVectorEnv as TaskVectorEnv

__all__ = ["StableBaselinesEnv", "TaskEnv", "TaskVectorEnv", "register"]
MODULES = {
    "register": "registration",
    "TaskEnv": "task_env",
    "TaskVectorEnv": "task_vector_env",
    "StableBaselinesEnv": "stable_baselines",
}
EXTRAS = {"gymnasium": "pip install 'mindlang[gymnasium]'", "stable_baselines3": "pip install 'mindlang[sb3]'"}


def __getattr__(name: str) -> Any:
    if name not in MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    try:
        return getattr(import_module(f"{__name__}.{MODULES[name]}"), name)
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in EXTRAS:
            raise
        raise MindError(f"{name} needs {package}", EXTRAS[package]) from error
