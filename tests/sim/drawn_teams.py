"""Hypothesis strategies for the other robots of a world."""

from collections.abc import Sequence

from hypothesis import strategies as st
from mindrun.graph.graph import Thing
from mindrun.kinds.things.robot import Robot
from mindrun.numbers.quantity import UNSAID, Span

TEAMS = [(), ("mate",), ("mate", "scout")]
PAID = st.sampled_from([1, 1, 0])
AWAY = st.sampled_from([UNSAID, Span(0.0, 6.0), Span(2.0, 12.0)])
AT = {"at": st.sampled_from([((-6.0, 3.0),), ((4.5, 0.5),)]), "or_": st.sampled_from([(), (((9.0, -6.0),),)])}
ROBOTS = st.builds(Robot, count=st.sampled_from([1, 1, 3, 0]), away=AWAY, paid=PAID) | st.builds(Robot, **AT, paid=PAID)


@st.composite
def teams(draw: st.DrawFn, masters: Sequence[str]) -> list[Thing]:
    """Other robots of up to two names, most often none, some of them under one of these skills."""
    master = st.sampled_from(["", "", *masters])
    return [Thing(name, draw(ROBOTS), master=draw(master)) for name in draw(st.sampled_from(TEAMS))]
