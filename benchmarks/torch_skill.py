"""What exact sums cost in PyTorch: a step of a skill beside one of nn.Sequential with the same matrices, in turns.

python benchmarks/torch_skill.py
"""

from pathlib import Path
from statistics import median
from time import perf_counter
from typing import Any

import torch
from torch import nn

import mindlang
from mindlang.weights.torch_skill import Skill

COLLECT = Path(__file__).parents[1] / "examples" / "collect" / "collect.mind"
BATCH_READINGS, COMPARED_ROUNDS, ROUND_STEPS = 512, 15, 20


def seconds(module: Any, inputs: int) -> float:
    """The time of one step: forward, and backward."""
    rows, began = torch.rand(BATCH_READINGS, inputs), perf_counter()
    for _ in range(ROUND_STEPS):
        module(rows).square().sum().backward()
    return (perf_counter() - began) / ROUND_STEPS


def main() -> None:
    """Print the median of the ratios, and both times, for three skills."""
    torch.set_num_threads(1)
    mind = mindlang.load(COLLECT)
    for name in ("GoToObject", "Avoid", "GoToObject+Avoid"):
        skill, layers = Skill(mind, name), []
        for before, after in skill.network.shapes:
            layers += [nn.Linear(before, after, bias=False), nn.Sigmoid()]
        plain = nn.Sequential(*layers)
        inputs = skill.network.inputs
        found = [(seconds(skill, inputs), seconds(plain, inputs)) for _ in range(COMPARED_ROUNDS)]
        ours, theirs = (median(times) for times in zip(*found, strict=True))
        ratio = median(a / b for a, b in found)
        print(f"{name}: {ours * 1e3:.2f} ms, nn.Sequential {theirs * 1e3:.2f} ms, {ratio:.1f} times")


if __name__ == "__main__":
    main()
