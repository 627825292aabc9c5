"""Weights that were taught to something else."""

from pathlib import Path

from mindrun.terminal.command_line import command_line

from mindlang.lint.study import Finding, Found, Study, rule
from mindlang.lock.status import Trained, mismatches, status


@rule()
def stale_weights(study: Study) -> Found:
    """Skills that the lock knows with another signature; notes on subskills, as `mindc status` has them, are none."""
    for skill in study.graph.skills:
        entry = study.lock.get(skill.name)
        if entry and skill.function.learns and not skill.like and (found := mismatches(study.graph, skill, entry)):
            first = f"Unfreeze {skill.name} first: then " if skill.frozen else ""
            message = f"The weights of {skill.name} are stale: {'; '.join(found)}."
            yield Finding(study.skills[skill.name].span, message, f"{first}mindc train teaches it again.")


@rule()
def taught_elsewhere(study: Study) -> Found:
    for name, state in status(study.graph, study.lock, study.main.folder).items():
        if isinstance(state, Trained) and state.is_elsewhere and not study.skills[name].like:
            message = f"{name} was taught elsewhere: {'; '.join(state.changes)}."
            accept = command_line("mindc", "status", Path(study.main.path.name), "--accept", name)
            hint = f"mindc train teaches it again; {accept} leaves it as it is."
            if not state.outdated:
                hint = f"No lesson teaches {name} in this world: write one, or take back what has changed."
            yield Finding(study.skills[name].span, message, hint)
