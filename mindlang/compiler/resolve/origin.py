"""The skill with a copy of whose weights a lesson begins: whether they fit the skill that is taught."""

from collections.abc import Iterator, Mapping, Sequence

from mindrun.functions import Function

from mindlang.compiler import model
from mindlang.compiler.counterparts import counterparts
from mindlang.compiler.diagnostic import Findings, listed
from mindlang.compiler.syntax import Name


def check_origin(
    origin: Name,
    learner: model.Skill,
    skills: Mapping[str, model.Skill],
    widths: Mapping[str, int],
    findings: Findings,
) -> None:
    """Report weights with which a lesson cannot begin."""
    other = skills[origin.text]
    if not learner.function or not other.function:
        return
    if other.owner == learner.name:
        message = f"{learner.name} has these weights already."
        findings.error("own-origin", origin.span, message, f"Leave from {origin.text} out: it begins with its weights.")
        return
    for difference in _differences(learner, other, widths):
        hint = "Weights fit the same function of as many readings and outputs, of each of which one may be another."
        message = f"{learner.name} cannot begin with the weights of {other.name}: {difference}."
        findings.error("other-shape", origin.span, message, hint)
        return


def _differences(learner: model.Skill, other: model.Skill, widths: Mapping[str, int]) -> Iterator[str]:
    """Why weights of one skill do not fit another."""
    if not other.function.learns:
        yield f"{other.name} learns nothing"
        return
    own, its = (_sized(skill, widths) for skill in (learner, other))
    pairs = (
        ("reads", *([f"{name}:{widths.get(name, 1)}" for name in skill.reads] for skill in (learner, other))),
        ("sends to", *(_sends(skill) for skill in (learner, other))),
    )
    for verb, mine, others in pairs:
        if counterparts(mine, others) is None:
            yield (
                f"{learner.name} {verb} {_words(mine, others)} where {other.name} {verb} {_words(others, mine)}, and "
                "which stands for which cannot be told"
            )
    if own != its:
        yield "their functions differ"


def _sized(skill: model.Skill, widths: Mapping[str, int]) -> Function:
    inputs = sum(widths.get(name, 1) for name in skill.reads)
    return skill.function.explicit(inputs, len(_sends(skill)))


def _sends(skill: model.Skill) -> list[str]:
    return [edge.target for edge in skill.edges if edge.at is None]


def _words(names: Sequence[str], but: Sequence[str]) -> str:
    """The names that are not among the others."""
    found = [name.partition(":")[0] for name in names if name not in but]
    return listed(found, "and") if found else "nothing more"
