"""A skill as a module of PyTorch, with exactly our function: taught by gradients elsewhere, acting here.

    skill = mindlang.torch.Skill(mindlang.load("collect.mind"), "GoToObject")
    commands = skill(readings)                          # [..., inputs] to [..., outputs], in 0..1
    skill.save("goto.safetensors")                      # mindc weights import collect.mind GoToObject goto.safetensors

PyTorch is imported when `Skill` is asked for: `pip install 'mindlang[torch]'`.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mindlang.weights.torch_skill import Skill as Skill

__all__ = ["Skill"]


def __getattr__(name: str) -> Any:
    if name != "Skill":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from mindrun.errors import MindError

    try:
        from mindlang.weights.torch_skill import Skill
    except ImportError as error:
        raise MindError("mindlang.torch needs PyTorch", "pip install 'mindlang[torch]'") from error
    return Skill
