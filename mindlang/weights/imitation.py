"""Imitation: a skill's function fitted to what a mind or a hand did in recordings (behavioural cloning).

What the skill sends is compared with the commands that reached its actuators, and with the influence that its subskills
had as a share of its own. Whole drives are held out, and say how well.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from hashlib import sha256
from typing import Any

import numpy as np
from mindrun.errors import MindError
from mindrun.graph.graph import Graph, Lesson, Skill
from mindrun.graph.named_readings import reading_names
from mindrun.graph.weights import Weights, genes
from mindrun.kinds.functions.function import Stateful
from mindrun.kinds.learners import Genetic
from mindrun.numbers.arrays import columns, evaluate_rows
from mindrun.terminal.tick_count import ticks as tick_count

from mindlang.compiler.diagnostic import listed
from mindlang.run.drives import Drive, Rows, in_words
from mindlang.training.lesson_choice import chosen_lessons
from mindlang.weights.importing import Imported
from mindlang.weights.least_squares import Examples, fitted
from mindlang.weights.network import SkillNetwork

HELD_OUT = 5  # of so many drives one; of a single one so large a part, its last
FEWEST_TICKS = 100  # that can be compared, of those that weights are fitted to
MOST_TICKS = 8000  # that weights are fitted to, evenly from all
FITTED_NUMBERS = 400_000  # ticks times weights, at most, of a function that remembers nothing
WINDOW_TICKS = 2000  # of a function that remembers: it begins each with nothing remembered, as a run


class ShowingError(MindError):
    """Drives from which a skill cannot learn."""


@dataclass(frozen=True, slots=True)
class Shown:
    """What a skill reads in a drive [ticks, inputs], and what it would send there [ticks, outputs].

    The ticks are those in which all that it reads is a number: in others a skill computes nothing. What it would send
    is NaN where nobody knows it.
    """

    inputs: Rows
    wanted: Rows


@dataclass(frozen=True, slots=True)
class OutputError:
    """How far an output is off what was shown on drives that were held out, in 0..1.

    `error` is the mean absolute difference, `of_mean` that of always saying the mean, `explained` the share of the
    squared differences from the mean that is gone; None where what was shown is always the same.
    """

    to: str
    error: float
    of_mean: float
    explained: float | None


@dataclass(frozen=True, slots=True)
class Imitation:
    """Weights fitted to `ticks` of drives, and how far each output is off on those `held_out`, of `held_out_ticks`."""

    genome: Weights
    seed: int
    drives: Sequence[Drive]
    held_out: Sequence[Drive]
    ticks: int
    held_out_ticks: int
    outputs: Sequence[OutputError]

    @property
    def error(self) -> float:
        return float(np.mean([each.error for each in self.outputs]))

    @property
    def lineage(self) -> tuple[str, str]:
        """What the weights come from, as a lock says it, and the SHA-256 of the recording, or of all theirs."""
        digests = {drive.digest: drive.name for drive in (*self.drives, *self.held_out)}
        names = [*digests.values()]
        shown = ",".join([*names[:3], *([f"and {len(names) - 3} others"] if len(names) > 3 else [])])
        every = sha256("\n".join(digests).encode()).hexdigest() if len(digests) > 1 else next(iter(digests))
        return f"{shown};seed={self.seed};error={self.error:.4f}", every

    def data(self, found: Imported) -> dict[str, Any]:
        own = {"ticks": self.ticks, "held_out": in_words(self.held_out), "held_out_ticks": self.held_out_ticks}
        recordings = {drive.name: drive.digest for drive in (*self.drives, *self.held_out)}
        outputs = [asdict(each) for each in self.outputs]
        return found.data() | {"seed": self.seed, "recordings": recordings, **own, "outputs": outputs}


def imitation(
    graph: Graph, network: SkillNetwork, drives: Sequence[Drive], seed: int, told: Callable[[int], object]
) -> Imitation:
    """A skill's weights fitted to drives; ShowingError where these do not show what it reads or sends."""
    _refuse_unshown(graph, network.skill, drives)
    fitting, held_out = _parted(drives, seed)
    shown, hidden = ([_shown(graph, network.skill, drive) for drive in each] for each in (fitting, held_out))
    ticks, held_out_ticks = (_comparable(each) for each in (shown, hidden))
    if ticks < FEWEST_TICKS or held_out_ticks < FEWEST_TICKS // HELD_OUT:
        raise ShowingError(
            f"{in_words(drives)} shows {network.skill.name} too little: {tick_count(ticks + held_out_ticks)} that can "
            f"be compared, {tick_count(held_out_ticks)} of these held out",
            f"drive for longer: {FEWEST_TICKS} ticks beside those held out are the least",
        )
    examples = _windows(shown) if network.state else _rows(shown, FITTED_NUMBERS // genes(network.skill))
    genome = fitted(network.skill.function, examples, seed, told)
    outputs = [*_errors(graph, network, genome, shown, hidden)]
    return Imitation(genome, seed, fitting, held_out, ticks, held_out_ticks, outputs)


def lesson_of(graph: Graph, skill: str, drives: Sequence[Drive]) -> Lesson:
    """The lesson in which a skill is tried: its last, or one on the task of the drives with the skill in charge.

    MindError where there is neither.
    """
    if any(lesson.skill == skill for lesson in graph.lessons):
        return chosen_lessons(graph, None, [skill])[-1]
    known = {task.name for task in graph.tasks}
    shown = [drive.task for drive in drives if drive.task in known]
    if not shown:
        why = f"no lesson teaches {skill}, and no recording is of a task of the mind, on which it could be tried"
        raise ShowingError(why, f"add a curriculum that says: teaches {skill} on TASK for N generations")
    return Lesson("", skill, shown[0], skill, 1, False, False, Genetic())


def _parted(drives: Sequence[Drive], seed: int) -> tuple[list[Drive], list[Drive]]:
    """The drives to learn from, and those held out; the end of the only one."""
    if len(drives) == 1:
        end = len(drives[0]) - len(drives[0]) // HELD_OUT
        return [drives[0].part(slice(0, end))], [drives[0].part(slice(end, None))]
    order = np.random.default_rng(seed).permutation(len(drives)).tolist()
    out = {*order[: max(1, len(drives) // HELD_OUT)]}
    return [d for i, d in enumerate(drives) if i not in out], [d for i, d in enumerate(drives) if i in out]


def _shown(graph: Graph, skill: Skill, drive: Drive) -> Shown:
    wanted = np.full((len(drive), skill.outputs), np.nan, np.float32)
    own = drive.influence[:, graph.skill_numbers[skill.name]]
    for edge in skill.edges:
        if edge.output is not None:
            sent = (drive.influence if edge.to == "skill" else drive.commands)[:, edge.target]
            if edge.to == "skill":
                sent = np.asarray(sent / np.where(own > 0, own, np.float32(1.0)), np.float32)
            if edge.gate:
                is_open = evaluate_rows(edge.gate.when, columns(drive.readings), len(drive)) > 0
                sent = np.where(is_open, sent, np.float32(np.nan))
            wanted[:, edge.output] = np.clip(sent, 0, 1)
    inputs = drive.readings[:, list(skill.inputs)]
    is_read = np.isfinite(inputs).all(axis=1)
    return Shown(inputs[is_read], wanted[is_read])


def _refuse_unshown(graph: Graph, skill: Skill, drives: Sequence[Drive]) -> None:
    """ShowingError where no tick of the drives has a number for something that a skill reads, or learns to send."""
    names = in_words(drives) if drives else ""
    if not drives:
        raise ShowingError("there is no tick in these recordings", "record a drive: mindc view FILE --drive")
    for edge in skill.edges:
        if edge.output is not None and edge.to == "memory":
            memory = graph.memories[edge.target].name
            why = f"{skill.name} sends to the memory {memory}, and no drive shows what it should remember"
            raise ShowingError(why, "teach it by a lesson")
    readings = reading_names(graph)
    for place in skill.inputs:
        if all(not np.isfinite(drive.readings[:, place]).any() for drive in drives):
            why = f"{names} has no reading of {readings[place]}, which {skill.name} reads"
            raise ShowingError(
                why, f"record a drive in a task that has it, under a master that reads {readings[place]}"
            )
    for edge in skill.edges:
        place, to = edge.target, graph.named(edge.to, edge.target)
        of = [drive.influence if edge.to == "skill" else drive.commands for drive in drives]
        if edge.output is not None and all(not np.isfinite(each[:, place]).any() for each in of):
            what = f"influence of {to}" if edge.to == "skill" else f"command to {to}"
            who = f"a master above {to}" if edge.to == "skill" else "a robot that is not stopped"
            raise ShowingError(f"{names} has no {what}, which {skill.name} sends", f"record a drive of {who}")


def _comparable(shown: Sequence[Shown]) -> int:
    return sum(int(np.isfinite(each.wanted).any(axis=1).sum()) for each in shown)


def _rows(shown: Sequence[Shown], most: int) -> Examples:
    """At most so many rows, evenly from all that can be compared."""
    inputs, wanted = (np.concatenate([getattr(each, name) for each in shown]) for name in ("inputs", "wanted"))
    known = np.flatnonzero(np.isfinite(wanted).any(axis=1))
    taken = known[np.linspace(0, len(known) - 1, min(len(known), MOST_TICKS, max(most, FEWEST_TICKS))).astype(int)]
    return Examples(inputs[taken, None].astype(float), wanted[taken, None].astype(float))


def _windows(shown: Sequence[Shown]) -> Examples:
    """Windows of all drives side by side, for a function that remembers: as many as are fitted to, evenly."""
    parts = [
        Shown(each.inputs[first : first + WINDOW_TICKS], each.wanted[first : first + WINDOW_TICKS])
        for each in shown
        for first in range(0, len(each.inputs), WINDOW_TICKS)
    ]
    many = min(len(parts), MOST_TICKS // WINDOW_TICKS)
    parts = [parts[place] for place in np.linspace(0, len(parts) - 1, many).astype(int)]
    longest = max(len(each.inputs) for each in parts)
    inputs = np.zeros((longest, len(parts), parts[0].inputs.shape[1]))
    wanted = np.full((longest, len(parts), parts[0].wanted.shape[1]), np.nan)
    for place, each in enumerate(parts):
        inputs[: len(each.inputs), place], wanted[: len(each.inputs), place] = each.inputs, each.wanted
    return Examples(inputs, wanted)


def sent_by(network: SkillNetwork, genome: Weights, inputs: Rows) -> Rows:
    """What the engine sends for the inputs of a drive [ticks, inputs], to the bit, but for lines with `at`."""
    skill, found = network.skill, np.zeros((len(inputs), network.outputs), np.float32)
    compute = skill.function.ready(network.inputs, network.outputs, genome, {})
    if len(inputs):
        found = np.array([compute(row) for row in inputs]) if isinstance(compute, Stateful) else compute(inputs)
    if skill.chooses:
        among = [edge.output for edge in skill.edges if edge.to == "skill" and edge.output is not None]
        best = found[:, among].argmax(axis=1)
        found[:, among] = np.arange(len(among)) == best[:, None]
    return np.clip(found, 0, 1)


def _errors(
    graph: Graph, network: SkillNetwork, genome: Weights, shown: Sequence[Shown], hidden: Sequence[Shown]
) -> Iterator[OutputError]:
    """The error of each output on what was held out, beside that of the mean of what was shown."""
    wanted = np.concatenate([each.wanted for each in shown]).astype(float)
    right = np.concatenate([each.wanted for each in hidden]).astype(float)
    sent = np.concatenate([sent_by(network, genome, each.inputs) for each in hidden])
    for edge in network.skill.edges:
        if (place := edge.output) is not None:
            known = np.isfinite(right[:, place])
            to, mean = graph.named(edge.to, edge.target), float(np.nanmean(wanted[:, place]))
            if not known.any():
                raise ShowingError(f"what was held out shows nothing of {to}", "say more drives, or another --seed")
            off, spread = right[known, place] - sent[known, place], right[known, place] - mean
            before = float(np.square(spread).sum())
            explained = 1 - float(np.square(off).sum()) / before if before > 0 else None
            yield OutputError(to, float(np.abs(off).mean()), float(np.abs(spread).mean()), explained)


def held_out_words(of: Imitation) -> str:
    """What was held out, in words: goto2.rec, or the last fifth of goto1.rec."""
    names, fitted_to = in_words(of.held_out), {drive.digest for drive in of.drives}
    is_part = len(of.drives) == 1 and of.held_out[0].digest in fitted_to and of.held_out[0].first > of.drives[0].first
    return f"the last fifth of {names}" if is_part else listed([names])
