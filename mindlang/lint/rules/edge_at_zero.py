"""An influence that is always zero.

A skill without influence does not act at all (Eq. 2), so the line says the same as none. `drives left_wheel at 0` is
another matter: 0 is a command as any other.
"""

from mindlang.lint.study import Finding, Found, Study, is_zero_influence, removal

HIERARCHY = """
master Live
sensor eye is range_finder at 0 deg
skill Back is rule
  drives left_wheel at 0
skill Go is rule
  drives left_wheel at 1
skill Live is rule
  reads eye
  influences Go at eye
"""
GOOD = f"{HIERARCHY}  influences Back at 1 - eye\n"
BAD = (
    f"{HIERARCHY}  influences Back at 0\n",
    f"{HIERARCHY}  influences Back at -eye\n",
)


def check(study: Study) -> Found:
    for skill, edge in study.edges:
        if edge.at and is_zero_influence(edge) and not skill.chooses:
            message = f"{skill.name} never has influence on {edge.target}: this is always 0."
            hint = "Give it a value above 0, or take the line out."
            yield Finding(edge.at.span, message, hint, fix=removal(edge.fact) if len(skill.edges) > 1 else None)
