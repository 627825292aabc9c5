"""A task that counts what it does not pay for, and pays for motion instead."""

from mindlang.compiler.model import Reward
from mindlang.compiler.syntax import Wants, of_form
from mindlang.lint.study import Finding, Found, Study, rule

HINT = "Pay for what is counted, too; mindc audit says what each line really pays."


@rule(once_a_line=True)
def paid_motion(study: Study) -> Found:
    for task in study.mind.tasks:
        paid = [reward.on for reward in task.rewards if reward.on]
        if not task.counts or of_form(task.facts, Wants) or any(on in task.counts or on.is_of_success for on in paid):
            continue
        value = study.worlds[task.name].range_in
        for reward in task.rewards:
            if _is_motion(reward) and value(reward)(reward.amount)[1] > 0:
                message = "This pays for motion alone, and nothing pays for what the task counts."
                yield Finding(reward.fact.span, message, HINT)


def _is_motion(reward: Reward) -> bool:
    """True if a line pays per tick, on no condition, for how the robot moves and not for where."""
    measures = [term.operand for term in reward.amount.found("measure")]
    about_nothing = all(not each.things and not each.over and not each.is_outside for each in measures)
    return reward.on is None and reward.when is None and bool(measures) and about_nothing
