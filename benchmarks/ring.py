"""What weights are worth that readings share: python benchmarks/ring.py [--angles 10 --task Seek --rates].

Teaches Avoid of examples/collect with range finders at equal angles, once with each seed and each function; or Seek:
an eye at the same angles, too, shows the object of GoToObject+Avoid, and one skill has to do it all. A `ring` is such a
function, a prototype that is no part of the language: a kernel that goes round the readings, then a dense layer. With
`half` a function drives one wheel, and its mirror image the other. With `--rates` it says how many ticks a CPU second
has where a skill reads rays, and where an image of 8 × 6 pixels is drawn of them.
"""

from __future__ import annotations

import argparse
import re
import time
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Annotated, Any, Self

import numpy as np
from mindrun.graph.policy import Policy
from mindrun.kinds.functions.function import NetworkFunction, Switch
from mindrun.kinds.functions.mlp import layer
from mindrun.kinds.registry import kind
from mindrun.numbers.quantity import Quantity
from mindrun.sim.rollout import Rollout

from benchmarks.neat import COLLECT, LINE, learn
from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source

if TYPE_CHECKING:  # a lane is given its terms when it is compiled
    from mindrun.numbers.arithmetic import HALF, LANES, ONE, ZERO, F, highest, load, lowest, splat, store
    from mindrun.numbers.arrays import Layers, Weights
    from mindrun.numbers.network import Terms

LEARNER = "founders 1000 octaves 2 mutated 20%"
FUNCTIONS = (
    "bench.ring readings {rays} senses {senses} kernel 3 channels 4",
    "bench.ring readings {rays} senses {senses} kernel 3 channels 2 bias 0",
    "neat most 8",
    "mlp hidden 0",
    "mlp hidden 1 width 7",
    "mlp hidden 2",
)
WHOLE = """skill {task} is {function}
{reads}
  drives left_wheel
  drives right_wheel
"""
HALVES = """skill Left is {function}
{reads}
  drives left_wheel

skill Right is like Left
{mirrored}
  drives right_wheel for left_wheel

skill {task} is rule
  influences Left at 1
  influences Right at 1
"""
TASKS = {  # the task of examples/collect, which wide sensors its skill reads, and what else
    "Avoid": ("Avoid", ["proximity"], ["moving", "pulse"]),
    "Seek": ("GoToObject+Avoid", ["proximity", "seen"], []),
}
SIGHT = """sensor rays is range_finder at {eight} deg range 30
sensor eyes is eye of object at {eight} deg range 30
sensor around is range_finder at {many} deg range 30
""".format(eight="-35 -25 -15 -5 5 15 25 35", many=" ".join(f"{7.5 * ray}" for ray in range(48)))
SEEN = {
    "a bearing": ("object_bearing", "mlp hidden 1 width 7"),
    "8 rays": ("rays", "mlp hidden 1 width 7"),
    "8 rays of an eye": ("eyes", "mlp hidden 1 width 7"),
    "8 rays and 8 of an eye": ("rays eyes", "mlp hidden 1 width 7"),
    "those, drawn as 8 × 6 pixels, a dense layer": ("rays eyes", "bench.camera convolves 0"),
    "those, drawn, four kernels of 3 × 3": ("rays eyes", "bench.camera convolves 1"),
    "48 rays": ("around", "mlp hidden 1 width 7"),
}
SPEED_ROUNDS = 7
CALM_NEURONS = 7  # as large as of so many neurons the sums of an output are at first
Size = Annotated[int, Quantity("a whole number", {"": 1.0}, low=1, high=63, whole=True)]


class Shared(NetworkFunction):
    """A network whose first matrix is used in many places."""

    opaque = "is a prototype"
    derived = ()
    width = 1

    def explicit(self, inputs: int, outputs: int) -> Self:
        return self


@kind("skill", "bench.ring")
class Ring(Shared):
    """Sigmoids of a kernel that goes round the first readings; a dense layer reads them and all other readings.

    It goes round several wide sensors of so many readings at once, and sees of each what lies at the same angles.
    """

    readings: Size = 10
    senses: Size = 1
    kernel: Size = 3
    channels: Size = 4
    bias: Switch = 1

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        dense = self.readings * self.channels + inputs - self.readings * self.senses + self.bias
        shared = self.kernel * self.senses + self.bias, self.channels
        return (shared, (dense, outputs)) if inputs and outputs else ()

    def draw(self, inputs: int, outputs: int, count: int, rng: np.random.Generator) -> Weights:
        genomes = NetworkFunction.draw(self, inputs, outputs, count, rng)
        _, (before, _) = self.matrix_shapes(inputs, outputs)
        last = genomes[:, -before * outputs :]
        last[:] = (last - 1 / before) * (CALM_NEURONS / before) ** 0.5 + 1 / before
        return genomes

    def forward(self, of: Terms, matrices: Sequence[Any], inputs: Any, state: Any) -> tuple[Any, Any]:
        shared, last = matrices
        columns = [inputs[..., row : row + 1] for row in range(self.readings * self.senses)]
        said = inputs[..., :0]
        for ray in range(self.readings):
            window = inputs[..., :0]
            for place in range(ray - self.kernel // 2, ray - self.kernel // 2 + self.kernel):
                for column in columns[place % self.readings :: self.readings]:
                    window = of.joined(window, column)
            said = of.joined(said, of.sigmoid(of.product(self.read(of, window), shared)))
        rest = inputs[..., self.readings * self.senses :]
        return of.product(self.read(of, of.joined(said, rest)), last), state

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        sizes = self.readings + 64 * self.kernel + 64 * 64 * self.senses
        return {"hidden": sizes, "width": self.channels, "bias": self.bias}

    def gathered(self, inputs: int, outputs: int) -> int:
        return inputs + (self.readings + self.kernel) * self.senses

    def scratch(self, inputs: int, outputs: int) -> int:
        return self.readings * self.channels + inputs + outputs

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        """Copy the readings once round, so that each window stands in one piece; then layer after layer."""
        readings, kernel, senses = skill.hidden % 64, skill.hidden // 64 % 64, skill.hidden // 4096
        inputs, channels, around = skill.inputs, skill.width, s.gathered[skill.inputs :]
        for j in range(readings + kernel - 1):
            for sense in range(senses):
                row = sense * readings + (j + readings - kernel // 2) % readings
                for p in range(0, n, LANES):
                    store(around, j * senses + sense, p, load(s.gathered, row, p))
        dense = skill.weights
        for j in range(readings):
            said = s.hidden[j * channels :]
            dense = layer(t, s, skill, skill.weights, around[j * senses :], kernel * senses, said, channels, False, n)
        end = readings * channels
        for j in range(readings * senses, inputs):
            for p in range(0, n, LANES):
                store(s.hidden, end + j - readings * senses, p, load(s.gathered, j, p))
        end += inputs - readings * senses
        layer(t, s, skill, dense, s.hidden, end, s.hidden[end:], skill.outputs, True, n)
        return int(end)


@kind("skill", "bench.camera")
class Camera(Shared):
    """Draws 8 × 6 pixels of 8 distances to what is solid and 8 to a thing, in the lanes alone: for its speed.

    A column is lit from its middle on, the higher, the nearer what it shows. A dense layer reads all pixels, or what
    four kernels of 3 × 3 say.
    """

    convolves: Switch = 1

    def matrix_shapes(self, inputs: int, outputs: int) -> Layers:
        return ((9, 4), (96, outputs)) if self.convolves else ((48, outputs),)

    def row(self, inputs: int, outputs: int) -> Mapping[str, int]:
        return {"hidden": self.convolves, "width": 4}

    def gathered(self, inputs: int, outputs: int) -> int:
        return inputs + 48 + 9

    def scratch(self, inputs: int, outputs: int) -> int:
        return 96 + outputs

    @staticmethod
    def lane(t: Any, s: Any, skill: Any, n: int) -> int:
        image, window = s.gathered[16:], s.gathered[64:]
        for c in range(8):
            for p in range(0, n, LANES):
                wall, thing = splat(ONE) - load(s.gathered, c, p), splat(ONE) - load(s.gathered, 8 + c, p)
                for r in range(6):
                    aside = splat(F(abs(2 * r - 5)) * F(0.15))
                    lit = highest(lowest(thing * splat(F(4.0)) - aside, splat(ONE)), splat(ZERO))
                    dim = highest(lowest(wall * splat(F(4.0)) - aside, splat(ONE)), splat(ZERO))
                    store(image, c * 6 + r, p, lit + dim * splat(HALF) * (splat(ONE) - lit))
        if not skill.hidden:
            layer(t, s, skill, skill.weights, image, 48, s.hidden[96:], skill.outputs, True, n)
            return 96
        dense = skill.weights
        for place in range(24):
            for cell in range(9):
                pixel = (place // 4 + cell // 3) * 6 + place % 4 + cell % 3
                for p in range(0, n, LANES):
                    store(window, cell, p, load(image, pixel, p))
            dense = layer(t, s, skill, skill.weights, window, 9, s.hidden[4 * place :], 4, False, n)
        layer(t, s, skill, dense, s.hidden, 96, s.hidden[96:], skill.outputs, True, n)
        return 96


def taught(function: str, rays: int, learner: str, its_task: str) -> tuple[Any, Rollout]:
    """The lesson of a task with so many rays all round, and its rollout, compiled."""
    halves = function.startswith("half ")
    first = 180 / rays - 180 if halves or rays > 10 else 0  # a mirror needs pairs
    angles = " ".join(f"{first + 360 / rays * ray:g}" for ray in range(rays))
    task, wide, others = TASKS[its_task]
    said = (HALVES if halves else WHOLE).format(
        task=task,
        function=function.removeprefix("half "),
        reads="\n".join(f"  reads {each}" for each in (*wide, *others)),
        mirrored="\n".join(f"  reads mirrored_{each} for {each}" for each in wide),
    )
    eyes = f"sensor seen is eye of object at {angles} deg range 100\n" if "seen" in wide else ""
    eyes += "".join(f"sensor mirrored_{each} is mirrored of {each}\n" for each in wide if halves)
    text = re.sub(r"(sensor proximity is range_finder) at .* deg", rf"\1 at {angles} deg", COLLECT.read_text())
    text = re.sub(rf"skill {re.escape(task)} is mlp hidden 2\n(  .*\n)*", said, text)
    text = text.replace("sensor object_bearing", f"{eyes}sensor object_bearing", 1)
    name = "Left" if halves else task
    lesson = f"teaches {name} on {task} under {task} for 100000 generations"
    text = re.sub(rf"teaches {re.escape(task)} on {re.escape(task)} .*", lesson, text)
    return ready(text.replace("population 100", learner), task, task, name)


def ready(text: str, task: str, master: str, skill: str) -> tuple[Any, Rollout]:
    """The lesson of a skill, if it has one, and the rollout in which it learns, compiled."""
    compiled = compile_source(Source(COLLECT.name, text), COLLECT)
    assert compiled.graph is not None, compiled.diagnostics
    rollout = Rollout(Policy(compiled.graph, {}), task, master, [skill])
    rollout.compile()
    return next(each for each in compiled.graph.lessons if each.skill == skill), rollout


def rates() -> None:
    """Print the most ticks per CPU second of GoToObject+Avoid's robot with each of the ways to see, in turns."""
    rollouts, most = {}, dict.fromkeys(SEEN, 0.0)
    for name, (read, function) in SEEN.items():
        head = "skill GoToObject is mlp hidden 2\n  reads object_bearing\n"
        skill = [SIGHT, f"skill GoToObject is {function}", *(f"  reads {each}" for each in read.split()), ""]
        text = COLLECT.read_text().replace(head, "\n".join(skill))
        _, rollouts[name] = ready(text, "GoToObject+Avoid", "GoToObject", "GoToObject")
    for number in range(SPEED_ROUNDS):
        for name, rollout in rollouts.items():
            genomes = np.random.default_rng(number).normal(0, 0.3, (256, rollout.genome_length)).astype(np.float32)
            begun = time.process_time()
            ticks = float(rollout.score(genomes, [1, 2]).ticks.sum())
            most[name] = max(most[name], ticks / (time.process_time() - begun))
    for name, rate in most.items():
        print(f"{name:45}{rate / 1e6:6.2f} M ticks per CPU second")


def main() -> None:
    """Teach, try, print."""
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("--angles", type=int, default=10, help="how many rays go round")
    parser.add_argument("--task", default="Avoid", choices=TASKS)
    parser.add_argument("--functions", nargs="+", default=FUNCTIONS)
    parser.add_argument("--learner", default=LEARNER)
    parser.add_argument("--ticks", type=float, default=50e6)
    parser.add_argument("--seeds", type=int, nargs="+", default=[*range(1001, 1007)])
    parser.add_argument("--rates", action="store_true", help="how fast it is to see, alone")
    options = parser.parse_args()
    if options.rates:
        rates()
        return
    senses = len(TASKS[options.task][1])
    for function in (each.format(rays=options.angles, senses=senses) for each in options.functions):
        lesson, rollout = taught(function, options.angles, options.learner, options.task)
        runs = [learn(lesson, rollout, seed, options.ticks) for seed in options.seeds]
        print(function, *(LINE.format(**run) for run in runs), sep="\n", flush=True)
        counts = np.array([run["count"] for run in runs])
        error = counts.std(ddof=1) / len(counts) ** 0.5
        print(f"{counts.mean():.1f} ± {error:.1f} {options.task}", flush=True)


if __name__ == "__main__":
    main()
