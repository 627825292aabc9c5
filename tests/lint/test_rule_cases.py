"""Cases that the rules of lint could get wrong."""

from collections.abc import Callable
from pathlib import Path

import pytest
from mindrun.numbers.intervals import UNBOUNDED

from mindlang.compiler.compile import load
from mindlang.compiler.source import Source, Span
from mindlang.compiler.syntax import Expression, Term
from mindlang.lint.intervals import interval
from mindlang.lint.lint import lint
from tests.lint.examples import whole

Lint = Callable[[str, str], list[str]]

EYE = "sensor eye is range_finder at 0 deg\n"
WHEELS = """
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
"""
COURSE = "task Course in arena\n  lasts 9 s\n  rewards forward per tick\n"


@pytest.fixture
def found(tmp_path: Path) -> Lint:
    """The messages of a rule about an example."""

    def messages(code: str, text: str) -> list[str]:
        compiled = load(whole(text, tmp_path))
        assert compiled.graph, [diagnostic.message for diagnostic in compiled.diagnostics]
        return [each.message for each in lint(compiled, [code])]

    return messages


def learner(name: str, *lines: str) -> str:
    return "\n  ".join([f"skill {name} is mlp", "reads eye", *lines]) + "\n"


def rule(name: str, *lines: str) -> str:
    return "\n  ".join([f"skill {name} is rule", *lines]) + "\n"


def test_an_influence_on_one_of_two_drivers_is_not_idle(found: Lint) -> None:
    text = f"master Live\n{EYE}" + learner("Live", "influences A", "influences B")
    assert (
        found("idle-influence", text + rule("A", "drives left_wheel at 1") + rule("B", "drives left_wheel at 0")) == []
    )


def test_a_driver_that_no_master_reaches_shares_nothing(found: Lint) -> None:
    text = f"master Live\n{EYE}" + learner("Live", "influences A", "drives right_wheel")
    shelved = rule("B", "drives left_wheel at 0")
    assert len(found("idle-influence", text + rule("A", "drives left_wheel at 1") + shelved)) == 1


def test_an_influence_is_not_idle_if_only_one_of_its_actuators_is_shared(found: Lint) -> None:
    below = rule("A", "drives left_wheel at 1", "drives claw at 1")
    text = f"master Live\n{EYE}{WHEELS}{below}"
    assert found("idle-influence", text + learner("Live", "influences A", "drives left_wheel")) == []


def test_sharing_deep_below_counts_and_so_do_memories(found: Lint) -> None:
    memory = "memory mood is cell decay 0.9\n"
    below = rule("A", "influences B at 1") + rule("B", "drives mood at 1") + rule("C", "drives mood at 0")
    text = f"master Live\n{EYE}{memory}{below}"
    assert found("idle-influence", text + learner("Live", "influences A", "influences C")) == []
    assert len(found("idle-influence", text + learner("Live", "influences A", "drives left_wheel"))) == 1


def test_the_only_learned_output_cannot_be_fixed_at_one(tmp_path: Path) -> None:
    text = f"master Live\n{EYE}" + rule("A", "drives left_wheel at 1") + learner("Live", "influences A")
    [diagnostic] = lint(load(whole(text, tmp_path)), ["idle-influence"])
    assert diagnostic.fix is None


HIERARCHY = f"master Top\n{EYE}{COURSE}" + "".join([
    learner("Top", "influences Middle", "drives left_wheel"),
    learner("Middle", "influences Low", "drives left_wheel"),
    learner("Low", "drives left_wheel"),
])  # fmt: skip


def lessons(*said: str, name: str = "School") -> str:
    return "\n".join([f"curriculum {name} is genetic", *(f"  teaches {lesson}" for lesson in said)]) + "\n"


TOP, MIDDLE, LOW = (f"{name} on Course for 9 generations" for name in ("Top", "Middle", "Low"))
LOW_AT_WORK = "Low on Course under Top for 9 generations"


def test_lessons_stand_in_any_order(found: Lint) -> None:
    assert found("early-lesson", HIERARCHY + lessons(LOW, MIDDLE, TOP)) == []
    assert found("early-lesson", HIERARCHY + lessons(MIDDLE, LOW, TOP)) == []


def test_lessons_that_wait_for_each_other_are_told_of(found: Lint) -> None:
    message = "Low waits for Top, which acts in this lesson, and Top waits for Low."
    assert found("early-lesson", HIERARCHY + lessons(LOW_AT_WORK, MIDDLE, TOP)) == [message]
    assert found("early-lesson", HIERARCHY + lessons(LOW, MIDDLE, TOP, LOW_AT_WORK)) == []


def test_what_is_taught_jointly_is_taught(found: Lint) -> None:
    assert found("early-lesson", HIERARCHY + lessons(f"{TOP} with subskills", LOW, MIDDLE)) == []


def test_what_another_curriculum_has_taught_may_learn_again_later(found: Lint) -> None:
    again = lessons(TOP, LOW_AT_WORK, name="Again")
    assert found("early-lesson", HIERARCHY + lessons(LOW, MIDDLE, TOP) + again) == []


def test_what_is_frozen_is_not_waited_for(found: Lint) -> None:
    frozen = HIERARCHY.replace("skill Low is mlp", "skill Low is mlp\n  stays frozen")
    assert found("early-lesson", frozen + lessons(MIDDLE, LOW, TOP)) == []


BALL = f"""
{EYE}
sensor ball_bearing is bearing of ball
sensor ball_drift is derivative of ball_bearing
task Seek in arena
  contains ball is item
  lasts 9 s
  rewards 1 on reach of ball
{COURSE}"""


def test_a_derivative_is_about_the_thing_that_its_source_is_about(found: Lint) -> None:
    skill = "skill Go is mlp\n  reads ball_drift\n  drives left_wheel\n"
    message = "Go reads ball_drift, but Course contains no ball."
    assert found("absent-thing", BALL + skill + lessons("Go on Course for 9 generations")) == [message]


def test_all_who_act_below_the_master_count(found: Lint) -> None:
    low = "skill Low is rule\n  reads ball_bearing\n  drives left_wheel at ball_bearing\n"
    text = f"master Top\n{BALL}{low}" + learner("Top", "influences Low", "drives left_wheel")
    message = "Low reads ball_bearing, but Course contains no ball."
    assert found("absent-thing", text + lessons("Top on Course for 9 generations")) == [message]
    assert found("absent-thing", text + lessons("Top on Seek for 9 generations")) == []
    both = lessons("Top on Course for 9 generations", "Top on Seek for 9 generations")
    assert found("absent-thing", text + both) == []


def rewards(scene: str, *lines: str) -> str:
    return "\n  ".join([f"task Course in {scene}", "lasts 9 s", *lines]) + "\n"


@pytest.mark.parametrize(
    ("line", "is_dead"),
    [
        ("rewards 1 per tick when eye > 1", True),
        ("rewards 1 per tick when eye >= 1", False),
        ("rewards 1 per tick when eye + eye < 0", True),
        ("rewards 1 per tick when 1 / eye < 0", False),  # it could be anything: eye may be 0
        ("rewards 1 per tick when forward > 0.5", False),
        ("rewards 1 per tick when change of thrust beyond 20% over 9 ticks < 0", True),
        ("rewards 1 per tick when change of thrust beyond 20% over 9 ticks > 40", False),
        ("rewards -0.03 * (1 - 4 * p) per tick for each p in eye when p < 1/4", False),
        ("rewards 1 per tick for each p in eye when p < 0", True),
        ("rewards 1 per tick when eye > 0.5 and eye < 0.4", True),
        ("rewards 1 per tick when eye > 0.5 and eye < 0.4 or eye > 0.9", False),
        ("rewards 1 per tick when eye >= 0.5 and eye <= 0.5", False),
        ("rewards 1 per tick when eye > 0.5 and eye <= 0.5", True),
        ("rewards 1 per tick when 0.2 > eye and eye > 0.3", True),
        ("rewards 1 per tick when 0.3 > eye and eye > 0.2", False),
        ("rewards 1 per tick when 1  - eye > 0.5 and 1 - eye < 0.4", True),
        ("rewards 1 per tick when eye > 0.5 and forward < 0.4", False),
        ("rewards 1 per tick when eye < 0.4 and eye < 0.3 and eye > 0.3", True),
        ("rewards eye - eye per tick", False),  # 0, but intervals do not know that both are one reading
    ],
)
def test_dead_conditions(found: Lint, line: str, is_dead: bool) -> None:
    assert bool(found("dead-reward", EYE + rewards("arena", line))) == is_dead


def test_a_condition_knows_what_the_world_lacks(found: Lint) -> None:
    plain = rewards("plain", "rewards 1 per tick when eye < 0.9")
    assert found("dead-reward", EYE + plain) == [
        "This reward is never paid: eye is always 1, never below 0.9."
    ]  # fmt: skip
    rock = "contains rock is obstacle count 3"
    assert found("dead-reward", EYE + rewards("plain", rock, "rewards 1 per tick when eye < 0.9")) == []


CARRY = """
sensor holding is held of ball
task Carry in arena
  contains ball is item
  contains home is zone size 5
  lasts 9 s
  rewards 9 on delivery of ball
  counts delivery of ball
"""


def test_a_claw_must_close_to_deliver(found: Lint) -> None:
    shelved = rule("Go", "drives left_wheel at 1") + rule("Grab", "drives claw at 1")
    for code in ("dead-reward", "dead-event", "constant-sensor"):
        assert len(found(code, WHEELS + CARRY + shelved)) == 1
        assert found(code, WHEELS + CARRY + rule("Go", "drives claw at 1")) == []
        closed = WHEELS.replace("gripper neutral 0", "gripper neutral 1")
        assert found(code, closed + CARRY) == []


def test_a_range_finder_is_not_constant_because_tasks_are_empty(found: Lint) -> None:
    assert found("constant-sensor", EYE + rewards("plain", "rewards forward per tick")) == []


def test_a_used_file_with_a_lock_is_of_use(found: Lint, tmp_path: Path) -> None:
    text = 'use "parts.mind"\n-- parts.mind --\n' + EYE
    assert found("unused-use", text) == ["Nothing of parts.mind is used."]
    (tmp_path / "parts.lock").write_text("# mind lock 5:\n")
    assert found("unused-use", text) == []


def test_the_names_of_others_are_told_from_their_own(found: Lint) -> None:
    assert found("misleading-name", "sensor battery_again is battery\nsensor bearing_of_old is inertial\n") == []
    assert found("similar-names", "".join(f"sensor eye_{n} is inertial\n" for n in ("1_1", "11", "2"))) == []
    both = "sensor Eye is inertial\n".replace("Eye", "eYe") + EYE
    assert found("similar-names", both) == ["eye looks almost like eYe."]


def span() -> Span:
    return Span(Source("x", ""), 0, 0)


@pytest.mark.parametrize(
    ("symbol", "right", "expected"),
    [("+", 2, (2, 3)), ("-", 2, (-2, -1)), ("*", -2, (-2, 0)), ("/", -2, (-0.5, 0)), ("/", 0, UNBOUNDED)],
)
def test_intervals(symbol: str, right: float, expected: tuple[float, float]) -> None:
    terms = (Term("reading", "eye", span()), Term("number", right, span()), Term(symbol, 0, span()))
    assert interval(Expression(terms, span())) == expected


@pytest.mark.parametrize(
    ("gate", "said"),
    [
        ("eye > 0.5", []),
        ("eye > 20", ["This condition never holds: eye is 0 to 1, never above 20."]),
        ("eye > -0.5", ["This condition always holds: eye is 0 to 1, always above -0.5."]),
        ("eye >= 0", ["This condition always holds: eye is 0 to 1, always at or above 0."]),
        ("eye > 0", []),
        ("eye <= 1 and eye > 0.2", []),
        ("eye > 0.2 or eye <= 1", ["This condition always holds: eye is 0 to 1, always at or below 1."]),
        ("eye > 0.2 and eye < 0.1", ["This condition never holds: eye is never below 0.1 and above 0.2 at once."]),
        ("1 / eye > -1", []),  # it may be no number, of which nobody knows
        ("least of eye 0.5 < 0.6", ["This condition always holds: least of eye 0.5 is 0 to 0.5, always below 0.6."]),
    ],
)
@pytest.mark.parametrize("line", ["drives left_wheel at 1 when {}", "drives left_wheel at 1 when {} otherwise eye"])
def test_conditions_of_edges(found: Lint, line: str, gate: str, said: list[str]) -> None:
    assert found("constant-condition", EYE + rule("Go", "reads eye", line.format(gate))) == said


@pytest.mark.parametrize(
    ("line", "is_constant"),
    [
        ("ends when eye < 20", True),
        ("ends when eye < 0.2", False),
        ("ends when eye > 20", False),  # which is for dead-event
        ("succeeds when eye >= 0 and eye <= 1", True),
        ("rewards 1 per tick when eye > 20", False),  # which is for dead-reward
        ("rewards 1 per tick for each p in eye when p < 1.5", True),
    ],
)
def test_conditions_of_tasks(found: Lint, line: str, is_constant: bool) -> None:
    assert bool(found("constant-condition", EYE + rewards("arena", line))) == is_constant
