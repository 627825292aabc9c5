"""Goals are worth what the rows of a run say, looked through by hand; and more of them is never worth less."""

import math
from dataclasses import dataclass
from functools import reduce

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.graph.policy import Policy
from mindrun.graph.tasks import things_of
from mindrun.kinds.registry import phrase
from mindrun.numbers.expression import evaluate
from mindrun.sim.rollout import Rollout
from mindrun.sim.trace import trace

from mindlang.compiler.compile import compile_source
from mindlang.compiler.source import Source
from mindlang.editing.apply import apply_edit
from mindlang.editing.edits.rewards import rewards
from mindlang.editing.project import open_project
from tests.draws import cases
from tests.sim.minds import compile_text
from tests.sim.test_tasks import SEEKER

TICKS = 700
TASK = f"""
task Test in arena size 26
  contains object is item size 1 reached stays
  contains home is zone size 8 reached stays
  contains plug is power size 4 reached stays
  contains rock is obstacle count 2 size 2
  lasts {TICKS} ticks
"""
NEAR_TO = {"reach of object": ("", "object"), "reach of home": ("", "home"), "delivery of object": ("object", "home")}
EVENTS = [*NEAR_TO, "collision", "leave of home", "reach of home within 40 ticks of reach of object"]
CONDITIONS = {  # each as a function of what the sensors read
    "holding > 0.5": lambda of: of["holding"] > 0.5,
    "charge < 40%": lambda of: of["charge"] < 0.4,
    "home_bearing > 0.4 and home_bearing < 0.6 or in_home > 0.5": lambda of: (
        0.4 < of["home_bearing"] < 0.6 or of["in_home"] > 0.5
    ),
}
PREFERENCES = {
    "soon": None,
    "little charge": lambda of: of["charge"],
    "much home_bearing": lambda of: of["home_bearing"],
}
TIMES, SPANS = st.integers(1, 4), st.integers(0, 300)


@dataclass(frozen=True)
class Goal:
    """A goal as it is said: its verb, what it is about, how often, and the number of ticks that it says."""

    verb: str
    about: str
    times: int = 1
    ticks: int = 0
    stage: int = 0
    starts: bool = False

    def __str__(self) -> str:
        words = {"wants": "within", "keeps": "after", "holds": "for"}.get(self.verb, "")
        times = f"{self.times} " if self.times > 1 else ""
        time = f" {words} {self.ticks} ticks" if self.ticks else ""
        return f"{'then ' * self.starts}{self.verb.replace('holds', 'keeps')} {times}{self.about}{time}"


@st.composite
def goals(draw: st.DrawFn) -> list[Goal]:
    """Goals in up to three stages, of which the first alone avoids and keeps to the end."""
    some = st.sampled_from([*CONDITIONS])
    wants = st.builds(Goal, st.just("wants"), st.sampled_from(EVENTS), TIMES, SPANS)
    holds = st.builds(Goal, st.just("holds"), some, st.just(1), st.integers(2, 60))
    avoids = st.builds(Goal, st.just("avoids"), st.sampled_from(EVENTS), TIMES) | st.builds(
        Goal, st.just("avoids"), some
    )
    keeps = st.builds(Goal, st.just("keeps"), some, st.just(1), SPANS)
    found = draw(st.lists(wants | holds | avoids | keeps, min_size=1, max_size=4))
    for stage in range(1, draw(st.integers(1, 3))):
        later = draw(st.lists(wants | holds, min_size=1, max_size=2))
        found += [Goal(g.verb, g.about, g.times, g.ticks, stage, i == 0) for i, g in enumerate(later)]
    return found


class Rows:
    """A run: what its sensors read in each tick, and how often each event happened in it."""

    def __init__(self, rollout, seed):
        run = trace(rollout, seed)
        self.moments = list(run.moments)
        self.task, self.ended = rollout.task, int(run.jobs.ended[0])
        names = {s.name: s.start for s in rollout.graph.sensors if s.width == 1}
        self.read = [{name: float(m.readings[at]) for name, at in names.items()} for m in self.moments]
        written = [phrase(event) for event in rollout.task.events]
        self.happened = [dict(zip(written, m.events.tolist(), strict=True)) for m in self.moments]

    def share(self, goal, since):
        """How much of a goal is met, and the tick in which all of it is, of one that counts behind tick `since`."""
        if since is None:
            return 0.0, None
        if goal.about in CONDITIONS:
            now = [int(CONDITIONS[goal.about](read)) for read in self.read]
        else:
            now = [each[goal.about] for each in self.happened]
        sums = [sum(now[since:t]) for t in range(len(now) + 1)]  # as of tick t
        match goal.verb:
            case "wants":
                last = min(len(now), since + goal.ticks) if goal.ticks else len(now)
                met = next((t for t in range(last + 1) if sums[t] >= goal.times), None)
                return min(sums[last], goal.times) / goal.times, met
            case "holds":
                stretch = [
                    reduce(lambda many, one: many + 1 if one else 0, now[since:t], 0) for t in range(len(now) + 1)
                ]
                met = next((t for t, many in enumerate(stretch) if many >= goal.ticks), None)
                return min(max(stretch), goal.ticks) / goal.ticks, met
            case "keeps":
                return sum(now[goal.ticks :]) / (TICKS - goal.ticks), None
        failed = next((t for t, many in enumerate(sums) if many >= goal.times), len(now) + 1)
        return (failed - 1) / TICKS, None

    def judged(self, all_goals):
        """How much of each goal is met, the ticks behind which each stage counts, and that in which all is met."""
        since, shares, opened = 0, [], {}
        for stage in range(1 + max(goal.stage for goal in all_goals)):
            opened[stage] = since
            found = [self.share(goal, since) for goal in all_goals if goal.stage == stage]
            lasting = [goal.verb in ("avoids", "keeps") for goal in all_goals if goal.stage == stage]
            met = [tick for (_, tick), lasts in zip(found, lasting, strict=True) if not lasts]
            since = None if since is None or None in met else max([since, *met])
            shares += [share for share, _ in found]
        return shares, opened, since

    def near(self, goal, share, since):
        """How near the robot is in the last tick to what a goal wants; None where what was there has moved since."""
        if share == 1:
            return 1.0
        if since is None or self.happened[-1].get("delivery of object"):
            return 0.0 if since is None else None
        last, names = self.moments[-1], [thing.name for thing in things_of(self.task)]
        at = {"": last.body[:2]} | {name: last.things[i][:2] for i, name in enumerate(names)}
        of, to = NEAR_TO[goal.about]
        close = 25 / (25 + math.dist(at[of], at[to]))
        return close if not of else (close + 25 / (25 + math.dist(at[""], at[of]))) / 2


def simulated(text: str) -> Rollout:
    return Rollout(Policy(compile_text(text), {}), "Test", "Seek")


@settings(max_examples=cases(300), deadline=None)
@given(goals(), st.lists(st.sampled_from([*PREFERENCES]), unique=True), st.integers(0, 999))
def test_goals_are_worth_what_the_rows_say(all_goals: list[Goal], preferred: list[str], seed: int) -> None:
    lines = [*map(str, all_goals), *(f"prefers {each}" for each in preferred)]
    rollout = simulated(SEEKER + TASK + "".join(f"  {line}\n" for line in lines))
    run = Rows(rollout, seed)
    shares, opened, done = run.judged(all_goals)
    paid = run.moments[-1].lines
    assert np.allclose(paid[: len(all_goals)], np.asarray(shares) * 100 / len(all_goals), rtol=0, atol=1e-9)
    soft = []
    for each in preferred:
        many = sum(PREFERENCES[each](read) for read in run.read) / TICKS if PREFERENCES[each] else 0.0
        soon = 0.0 if done is None or not done else (len(run.moments) - done + 1) / TICKS
        if not any(goal.verb in ("wants", "holds") for goal in all_goals):
            soon = (len(run.moments) == TICKS) / TICKS
        soft.append({"s": soon, "l": 1 / (1 + many), "m": many / (1 + many)}[each[0]])
    behind = len(all_goals) + len(preferred)
    assert np.allclose(paid[len(all_goals) : behind], [10 * x / len(soft) for x in soft], rtol=0, atol=1e-6)
    wanted = [(g, q) for g, q in zip(all_goals, shares, strict=True) if g.verb == "wants" and g.about in NEAR_TO]
    near = [run.near(goal, share, opened[goal.stage]) for goal, share in wanted]
    within = paid[behind:]
    assert sum(within) <= 1 + 1e-9
    if len(within) == len(near) and None not in near:
        assert np.allclose(within, np.asarray(near) / max(1, len(near)), rtol=0, atol=1e-6)
    ended = rollout.task.ends[run.ended] if run.ended >= 0 else None
    assert bool(ended and ended.succeeds) == all(share == 1 for share in shares)


@settings(max_examples=cases(100), deadline=None)
@given(goals(), st.booleans(), st.data())
def test_one_event_more_is_worth_more_whatever_else_is_so(
    all_goals: list[Goal], soon: bool, data: st.DataObject
) -> None:
    """As long as so few are wanted that no line of lint tells of it."""
    wanted = [
        Goal("wants", goal.about, min(goal.times, 9 // len(all_goals))) for goal in all_goals if goal.verb == "wants"
    ]
    if not wanted:
        return
    lines = [*map(str, wanted), "prefers soon", "prefers much charge"][: len(wanted) + 2 * soon]
    task = simulated(SEEKER + TASK + "".join(f"  {line}\n" for line in dict.fromkeys(lines))).task
    events = [phrase(event) for event in task.events]
    wants = {tally.event: tally for tally in task.tallies if tally.event is not None}
    counted = {event: data.draw(st.integers(0, 6)) for event in wants}
    more = data.draw(st.sampled_from([*wants]))

    def worth(counts: dict[int, int]) -> float:
        anything = st.integers(0, TICKS)
        tallies = [
            counts.get(each.event, 0) if each.event is not None else data.draw(anything) for each in task.tallies
        ]
        measures = [float(data.draw(anything)) for _ in task.measures]
        known = {"tally": tallies, "measure": measures}
        programs = (
            tuple(("number", float(known[word][x])) if word in known else (word, x) for word, x in reward.amount)
            for reward in task.rewards
        )
        return sum(evaluate(program) for program in programs)

    needed = max(goal.times for goal in wanted if goal.about == events[more])
    before, after = worth(counted), worth(counted | {more: counted[more] + 1})
    assert after > before - 1e-9 if counted[more] < needed else after >= before - 11


@settings(max_examples=cases(50), deadline=None)
@given(goals(), st.lists(st.sampled_from([*PREFERENCES]), unique=True))
def test_goals_written_out_are_the_same_task(all_goals: list[Goal], preferred: list[str]) -> None:
    lines = [*map(str, all_goals), *(f"prefers {each}" for each in preferred)]
    text = SEEKER + TASK + "".join(f"  {line}\n" for line in lines)
    project = open_project(compile_source(Source("m.mind", text)))
    edited = apply_edit(project, rewards(project, "Test"), keep_weights=False)
    one, other = (graph.tasks[-1] for graph in (project.graph, edited.graph))
    assert [(each.amount, each.when, each.last) for each in one.rewards] == [
        (each.amount, each.when, each.last) for each in other.rewards
    ]
    assert [(each.event, each.times, each.when) for each in one.ends] == [
        (each.event, each.times, each.when) for each in other.ends
    ]
    assert (one.tallies, one.events, one.counts) == (other.tallies, other.events, other.counts)
