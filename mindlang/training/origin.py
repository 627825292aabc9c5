"""The weights of another skill with a copy of which a lesson begins."""

from collections.abc import Mapping
from pathlib import Path

from mindrun.graph.graph import Graph, Lesson, Skill
from mindrun.graph.weights import Weights, learners, owner_of
from mindrun.terminal.command_line import command_line
from mindrun.train import RunError

from mindlang.compiler.resolve.curricula import counterparts
from mindlang.lock import Lock
from mindlang.lock.blobs import Origin
from mindlang.lock.signature import places, signature, width
from mindlang.lock.status import trained_weights


def origin_weights(graph: Graph, lock: Lock, lesson: Lesson, shown: Path) -> dict[str, Weights]:
    """The weights with which its skill begins; none where the lesson starts from no other. The graph is `arrange`d.

    RunError where the other skill, or one that learns with the learner, has none that fit, and how to teach it in the
    file that is `shown`.
    """
    skills = {skill.name: skill for skill in graph.skills}
    together = learners(graph, lesson)
    if not lesson.starts_from or lesson.skill not in together:
        return {}
    origin = skills[lesson.starts_from]
    known: dict[str, Weights] = {}
    for needed in (origin.name, *(name for name in together if name != lesson.skill)):
        weights, refusals = trained_weights(graph, lock, [needed])
        if refusals:
            message = f"{lesson.skill} cannot begin with the weights of {origin.name}: {refusals[0]}"
            raise RunError(message, f"first: {command_line('mindc', 'train', shown, skills[needed].owner)}")
        known |= weights
    return {lesson.skill: _brought(graph, lesson, origin, known[origin.owner])}


def origin_of(graph: Graph, lock: Lock, lesson: Lesson) -> Origin | None:
    """The skill that a lesson starts from, and the SHA-256 of its weights."""
    owner = owner_of(graph, lesson.starts_from)
    return (lesson.starts_from, lock[owner].weights) if owner in lock else None


def _brought(graph: Graph, lesson: Lesson, origin: Skill, weights: Weights) -> Weights:
    """Weights of one skill in the order in which another reads and sends what stands for the same; 0 for the new."""
    learner = next(skill for skill in graph.skills if skill.name == lesson.skill)
    own, its = signature(graph, learner), signature(graph, origin)
    begun = (each for each in graph.lessons if each.curriculum == lesson.curriculum and each.starts_from)
    heirs = {each.skill: each.starts_from for each in begun}
    inputs, outputs = (_places(*names, heirs) for names in ((own.reads, its.reads), (own.sends, its.sends)))
    before = sum(map(width, its.reads)), len(its.sends)
    wide = origin.function.widened(weights, before, learner.function, (len(inputs), len(outputs)))
    return learner.function.reordered(weights if wide is None else wide, inputs, outputs)


def _places(of: tuple[str, ...], among: tuple[str, ...], heirs: Mapping[str, str]) -> list[int]:
    """For each value of these names its place among those of the other names, behind which new ones are."""
    found = counterparts(of, among, heirs)
    if found is None:
        raise RunError("these weights do not fit", "run mindc check")
    return places(of, (*among, *(name for name in of if name not in found)), found)
