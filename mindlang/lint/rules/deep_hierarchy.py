"""A hierarchy that is deeper than what can be proved of it.

A skill that chooses what acts can leak: it should send 0 to one of two skills, and sends a little. Leaks add up on the
way down. Where seven such choices stand one below the other, a leak of 1 % on each line can take more than half of a
command, so `mindc prove` can no longer say who commands (0.56; 0.24 for five). Ask it whether that holds here, and let
fewer choices stand one below the other: `cuts below` keeps small influence from arriving at all, and a skill that
`chooses one` does not leak.
"""

from networkx import DiGraph, dag_longest_path

from mindlang.lint.study import Finding, Found, Study

MAX_CHOICES = 6  # the worst leak of 1 % is 0.39 of a command with six, 0.56 with seven
HEAD = "\nsensor eye is range_finder at 0 deg\nmaster A\nskill Go is rule\n  drives left_wheel at 1\n"
CHOICE = "skill {} is mlp\n  reads eye\n  influences {}\n  influences Go\n"
LAST = "skill Stop is rule\n  drives left_wheel at 0.5\n"


def _choices(names: str) -> str:
    return HEAD + "".join(CHOICE.format(*pair) for pair in zip(names, [*names[1:], "Stop"], strict=True)) + LAST


GOOD = (_choices("AB"), _choices("ABCDEF"))
BAD = _choices("ABCDEFG")


def check(study: Study) -> Found:
    choices = DiGraph()
    for skill in (each for each in study.mind.skills if not each.chooses):
        learnt = [edge.target for edge in skill.edges if edge.to == "skill" and edge.at is None and not edge.cuts]
        if len(learnt) > 1:
            choices.add_edges_from((skill.name, target) for target in learnt)
    way = dag_longest_path(choices)
    if len(way) - 1 > MAX_CHOICES:
        message = f"{len(way) - 1} choices that are learnt stand one below the other: {' → '.join(way)}."
        hint = "mindc prove says how much of a command their leaks can take."
        yield Finding(study.skills[way[0]].span, message, hint)
