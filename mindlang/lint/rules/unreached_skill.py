"""A skill that no master reaches.

Influence flows from the master down. A skill that neither the mind's master nor the master of a lesson influences,
straight or through others, never acts and never learns; and whoever reads the file will think that it does.
"""

from mindlang.lint.examples import LEARNS, REWARDED, SCHOOL
from mindlang.lint.study import Finding, Found, Study, removal

ELSEWHERE = True
BAD = """
skill Go is rule
  drives left_wheel at 1
skill Rest is rule
  drives left_wheel at 0.5
"""
GOOD = (
    f"master Live\nskill Live is rule\n  influences Go at 1\n  influences Rest at 0.5{BAD}",
    f"master Rest\nskill Rest is rule\n  drives left_wheel at 0.5\n{LEARNS}{REWARDED}{SCHOOL}",
)


def check(study: Study) -> Found:
    for skill in study.mind.skills:
        if skill.name not in study.acting:
            fix = None if ("skill", skill.name) in study.used else removal(skill.declaration)
            hint = f"Write influences {skill.name} below a skill that acts, or take {skill.name} out."
            yield Finding(skill.span, f"No master reaches {skill.name}.", hint, fix=fix)
