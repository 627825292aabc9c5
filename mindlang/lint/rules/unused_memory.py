"""A memory that is never read, never driven, or that no command changes.

What nobody reads is remembered in vain, and what nobody drives stays what it was at the start: 0, or what `start` says.
One that starts above 0 and decays is a clock, and needs no driver. With `decay 1` all of it is kept, and nothing added.
"""

from mindlang.lint.study import Finding, Found, Study, readings, removal

ELSEWHERE = True
MOOD = """
memory mood is cell decay 0.9
skill Go is rule
  reads mood
  drives left_wheel at mood
  drives mood at 1
"""
UNDRIVEN = MOOD.replace("  drives mood at 1\n", "")
GOOD = (
    MOOD,
    UNDRIVEN.replace("0.9", "0.9 start 1"),
)
BAD = (MOOD.replace("  reads mood\n", "").replace("at mood", "at 1"), UNDRIVEN, MOOD.replace("decay 0.9", "decay 1"))


def check(study: Study) -> Found:
    rewards = [reward for task in study.mind.tasks for reward in task.rewards]
    ends = [end.when for task in study.mind.tasks for end in task.ends]
    read = {
        *(name for skill in study.mind.skills for name in skill.reads),
        *(name for kind in study.sensors.values() for name in kind.sources),
        *(reward.each for reward in rewards if reward.each),
        *readings(*((reward.amount, reward.when) for reward in rewards), *ends),
    }
    driven = {edge.target for skill in study.mind.skills for edge in skill.edges if edge.to == "memory"}
    for part in study.mind.memories:
        name, cell = part.name, part.kind
        if name not in read:
            fix = None if name in driven else removal(study.mind.names.table["memory"][name], is_safe=True)
            hint = f"Add reads {name} to a skill, or take the memory out."
            yield Finding(part.span, f"Nobody reads {name}.", hint, fix=fix)
        elif name not in driven and (cell.start == 0 or cell.decay == 1):
            hint = f"Add drives {name} to a skill, or take the memory out."
            yield Finding(part.span, f"Nobody drives {name}, so it is always {cell.start:g}.", hint)
        elif cell.decay == 1:
            hint = "Write decay 0 to take each command as it comes; drives … when … otherwise its own value holds it."
            yield Finding(part.span, f"With decay 1 no command changes {name}, so it is always {cell.start:g}.", hint)
