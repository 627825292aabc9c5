"""The skill with a copy of whose weights a lesson begins: whether they fit the skill that is taught."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from mindrun.kinds.functions.function import Function

from mindlang.compiler import model
from mindlang.compiler.counterparts import counterparts
from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.syntax import Name

if TYPE_CHECKING:
    from mindrun.numbers.arrays import Layers


def check_origin(
    origin: Name,
    learner: model.Skill,
    skills: Mapping[str, model.Skill],
    widths: Mapping[str, int],
    heirs: Mapping[str, str],
    findings: Findings,
) -> None:
    """Report weights with which a lesson cannot begin.

    `heirs` are the skills that begin with another's weights in the same curriculum, which they stand for.
    """
    other = skills[origin.text]
    if not learner.function or not other.function:
        return
    if other.owner == learner.name:
        message = f"{learner.name} has these weights already."
        findings.error("own-origin", origin.span, message, f"Leave from {origin.text} out: it begins with its weights.")
        return
    for difference in _differences(learner, other, widths, heirs):
        hint = (
            "Weights fit the same function. Of its readings and outputs one each may be another, and what is read or "
            "influenced beside them is new."
        )
        message = f"{learner.name} cannot begin with the weights of {other.name}: {difference}."
        findings.error("other-shape", origin.span, message, hint)
        return


def _differences(
    learner: model.Skill, other: model.Skill, widths: Mapping[str, int], heirs: Mapping[str, str]
) -> Iterator[str]:
    """Why weights of one skill do not fit another."""
    if not other.function.learns:
        yield f"{other.name} learns nothing"
        return
    found: dict[str, str] = {}
    for verb, mine, others in (
        ("reads", *([f"{name}:{widths.get(name, 1)}" for name in skill.reads] for skill in (learner, other))),
        ("sends to", *(_sends(skill) for skill in (learner, other))),
    ):
        stands = counterparts(mine, others, heirs)
        if stands is None:
            yield (
                f"{learner.name} {verb} {_words(mine, others)} where {other.name} {verb} {_words(others, mine)}, and "
                "which stands for which cannot be told"
            )
            return
        found |= stands
    if driven := [edge.target for edge in _outputs(learner) if edge.to == "actuator" and edge.target not in found]:
        yield f"{learner.name} drives {listed(driven, 'and')}, too, and a command of 0 is one"
    if not _holds(learner, other, widths):
        yield "their functions differ"


def _holds(learner: model.Skill, other: model.Skill, widths: Mapping[str, int]) -> bool:
    """Whether the learner computes what the other does once some of its weights are 0: no layer of it is smaller."""
    (own, its), (large, small) = zip(*(_sized(skill, widths) for skill in (learner, other)), strict=True)
    if own == its:
        return True
    holds = all(a >= b for more, less in zip(large, small, strict=False) for a, b in zip(more, less, strict=True))
    return type(own) is type(its) and 0 < len(large) == len(small) and holds


def _sized(skill: model.Skill, widths: Mapping[str, int]) -> tuple[Function, Layers]:
    """Its function with every argument said, and the shapes of the matrices in which its weights lie."""
    size = sum(widths.get(name, 1) for name in skill.reads), len(_sends(skill))
    return skill.function.explicit(*size), skill.function.matrix_shapes(*size)


def _outputs(skill: model.Skill) -> list[model.Edge]:
    return [edge for edge in skill.edges if edge.at is None]


def _sends(skill: model.Skill) -> list[str]:
    return [edge.target for edge in _outputs(skill)]


def _words(names: Sequence[str], but: Sequence[str]) -> str:
    """The names that are not among the others."""
    found = [name.partition(":")[0] for name in names if name not in but]
    return listed(found, "and") if found else "nothing more"
