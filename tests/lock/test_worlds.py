"""The world in which a skill was taught: whatever of it changes is noticed, and what changes nothing is not."""

import json
from collections.abc import Iterator
from dataclasses import is_dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.graph.graph import Graph
from mindrun.graph.weights import genes, learners, owners, reachable
from mindrun.kinds.registry import arguments, kinds, names
from mindrun.numbers.quantity import EXPRESSION, Quantity, Reference, Span

from mindlang.compiler.compile import compile_source, load
from mindlang.compiler.source import Source
from mindlang.lock import Entry, Lock, LockError, Taught, lock_path, lock_text, read_lock
from mindlang.lock.blobs import digest, record
from mindlang.lock.report import rows, survival
from mindlang.lock.signature import signature
from mindlang.lock.status import Stale, Trained, last_lesson, status
from mindlang.lock.training_world import TrainingWorld, world_of
from mindlang.lock.world_changes import changes
from mindlang.lock.world_facts import Worlds
from tests.draws import cases

# One of everything that a lesson can depend on, all of it below Top.
MIND = """\
tick 1/60 s
master Top
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
actuator claw is gripper neutral 0
actuator mast is servo neutral 0.5 range 45 deg
actuator light is lamp neutral 0
actuator call is signal neutral 0
sensor eye is range_finder at 0 30 330 deg range 12
sensor ball_bearing is bearing of ball
sensor ball_drift is derivative of ball_bearing
sensor near is contact of ball
sensor holding is held of ball
sensor home is inside of bin
sensor moving is inertial
sensor charge is battery
sensor pulse is sine period 2 s
sensor north is compass
sensor south is turned of north by 180 deg
sensor image is mirrored of north
sensor way is distance of ball
sensor glow is light of ball
sensor heard is signal of mate
sensor camera is eye of ball at -30 30 deg
sensor turning is turn_rate
sensor pace is speed
sensor rolled is odometer side left
sensor place is position along x
sensor hour is clock period 4 s
sensor line is floor of bin at 0.5 -0.5 ahead 1
sensor bumps is bumper at -45 45 deg
sensor tilt is computed at 1/2 + north - pulse
sensor hungry is latch of charge below 20% above 80%
sensor calm is average of moving over 30 ticks
sensor ahead is reading 1 of eye
sensor wish is order 0 to 2
sensor gaze is direction of mast
sensor fear is range_finder at 0 deg range 3
sensor unsafe is broken Grab
memory mood is cell decay 0.9
sensor spun is odometer side right
memory camp is place left rolled right spun compass north
memory laps is counter step 10%
memory seen is register

skill Go is mlp hidden 1
  reads eye
  reads ball_drift
  reads moving
  reads pulse
  reads charge
  drives left_wheel
  drives right_wheel
  drives mast at 2 * moving
  drives light at pulse

skill Grab is rule
  maintains near < 90%
  reads near
  reads holding
  reads heard
  reads home
  drives claw at near + holding - home
  drives call at heard / 2
  drives mood at 1/2

skill Watch is rule
  reads unsafe
  reads south
  reads image
  reads way
  reads glow
  reads camera
  reads turning
  reads pace
  reads rolled
  reads camp
  reads laps
  reads seen
  reads place
  reads hour
  reads line
  reads bumps
  reads tilt
  reads hungry
  reads calm
  reads ahead
  reads wish
  reads gaze
  drives mast at way * glow

skill Turn is procedure from turn.by
  reads eye
  drives left_wheel

skill Search is elman
  reads north
  drives right_wheel

skill Sway is gru
  reads north
  drives left_wheel

skill Grow is neat
  reads north
  drives left_wheel

skill Lag is ctrnn
  reads north
  drives left_wheel

skill Top is mlp
  reads ball_bearing
  reads mood
  influences Go
  influences Search when mood < 0.9
  influences Sway
  influences Grow
  influences Lag
  influences Turn when mood > 0.1 otherwise 0.2
  influences Watch cuts below 5%
  influences Grab at 1

task Fetch in arena size 80
  contains ball is item size 2
  contains bin is zone size 8
  contains rock is obstacle count 3 size 2
  contains dock is power size 4
  contains crate is box size 2
  contains marble is ball size 1
  contains cat is walker size 2
  contains mate is robot count 2
  contains hill is slope size 3
  contains fence is wall from 10 10 to -10 10
  varies noise of left_wheel 0 to 10%
  varies density of Robot 1 to 3
  fails right_wheel 1% per tick
  lasts 600 ticks
  ends on collision
  ends on exhaustion
  ends when charge < 5%
  succeeds on 5 delivery of ball to bin
  starts at 20 -20 facing 90 deg
  rewards 20 on success
  rewards 10 on reach of ball
  rewards 50 on delivery of ball
  rewards -20 on collision with mate
  rewards 2 on leave of bin by ball
  rewards 3 on reach of ball within 300 ticks of leave of bin
  rewards -0.01 * distance of ball to bin per tick
  rewards 1 on visit of patch size 5
  rewards (count of collision when time < 30) - (longest when moving > 0.5) * (sum of forward) at the end
  rewards 0.1 * progress toward ball per tick
  rewards 0.1 * advance toward bin per tick
  rewards -0.1 * retreat from bin per tick
  rewards -0.4 * change of thrust beyond 20% over 10 ticks per tick
  rewards 0.01 * forward per tick when moving > 0.5
  rewards -0.03 * (1 - p) per tick for each p in fear when p < 1/4
  counts delivery of ball

task Elsewhere in plain
  lasts 60 ticks
  rewards forward per tick

curriculum School is genetic population 8
  teaches Go on Fetch under Top for 3 generations using evolution_strategy
  teaches Search on Fetch for 3 generations
  teaches Sway on Fetch for 3 generations
  teaches Grow on Fetch for 3 generations
  teaches Lag on Fetch for 3 generations
  teaches Top on Fetch for 3 generations

curriculum Other is restarting population 8
  teaches Turnless on Elsewhere for 2 generations

sensor unread is battery start 0.9
memory unused is cell decay 0.5

skill Turnless is mlp
  reads pulse
  drives left_wheel
"""
PROCEDURE = "def by(a, b, c):\n    return a\n"

# Of these a lock need not know: they say nothing of the world, or what they say is told otherwise.
NEED_NOT_BE_NOTICED = {
    ("skill", "procedure", "from_"): "another function is told as another skill, by its text",
    ("sensor", "order", "timeout"): "nobody is silent where a skill is taught",
    **dict.fromkeys(
        [("curriculum", learner, "keeps") for learner in ("genetic", "restarting", "evolution_strategy")],
        "it decides whether what was learnt is taken, and changes none of it",
    ),
}


def compiled(text: str) -> Graph:
    graph = compile_source(Source("a.mind", text, Path())).graph
    assert graph, compile_source(Source("a.mind", text, Path())).diagnostics
    return graph


def taught(graph: Graph, folder: Path | None = None) -> Lock:
    """The lock after every lesson, without a file."""
    lock = {}
    for lesson in graph.lessons:
        for name in learners(graph, lesson):
            below = reachable(graph, name)
            assert genes(below[0])
            made = Taught(lesson.task, lesson.master, lesson.with_subskills, 3, 8, 1, 1.0)
            world = Worlds(graph, folder).of(lesson)
            own, *others = ((skill.name, digest(np.zeros(genes(skill), np.float32))) for skill in below if genes(skill))
            subskills = tuple(sorted((skill, weights) for skill, weights in others if skill in owners(below)))
            lock[name] = Entry(name, signature(graph, below[0]), own[1], made, subskills, (world,))
    return lock


# The robots of which a mind has one only.
WHEELS = """\
body Robot is disc
actuator left_wheel is wheel side left neutral 0.5
actuator right_wheel is wheel side right neutral 0.5
"""
OTHER_ROBOTS = (
    WHEELS.replace("is disc", "is box"),
    """\
body Robot is car
actuator left_wheel is steering neutral 0.5
actuator right_wheel is motor neutral 0.5
""",
    """\
body Robot is holonomic
actuator left_wheel is thruster neutral 0.5 at 1 0
actuator right_wheel is thruster neutral 0.5 facing 90 deg
""",
)
OUTSIDE = """\
tick 1/50 s
master Top
sensor height is observation image 3 range -0.5 to 2
sensor view is observations image 4 to 9 range 0 to 255
actuator engine is action left 0 neutral 0.5 range -1 to 1
actuator fire is choice 2 neutral 0
memory mood is cell decay 0.95
skill Top is mlp
  reads height
  reads view
  reads mood
  drives engine
  drives fire
task Land in gymnasium nowhere:Lander-v0
  lasts 100 ticks
  rewards its reward
  ends on its end
curriculum School is genetic population 8
  teaches Top on Land for 3 generations
"""
GRAPH = compiled(MIND)
LOCK = taught(GRAPH)


def is_noticed(graph: Graph, skill: str = "Top", lock: Lock = LOCK) -> bool:
    state = status(graph, lock)[skill]
    return isinstance(state, Stale) or (isinstance(state, Trained) and bool(state.changes))


def _parts(graph: Graph) -> Iterator[tuple[str, Any]]:
    """Every kind that the lesson of Top depends on, with its noun."""
    task = graph.tasks[0]
    yield "body", graph.body
    yield from (("actuator", each.kind) for each in graph.actuators)
    yield from (("sensor", each.kind) for each in graph.sensors if each.name != "unread")
    yield from (("memory", each.kind) for each in graph.memories if each.name != "unused")
    yield from (("skill", each.function) for each in graph.skills if each.name != "Turnless")
    yield "task", task.scene
    yield from (("content", each.kind) for each in task.things)
    yield from (("event", each) for each in task.events)
    yield from (("measure", each) for each in task.measures)
    yield from (("curriculum", learner) for learner in dict.fromkeys(lesson.learner for lesson in graph.lessons))


def _exchanged(part: Any, old: Any, new: Any) -> Any:
    """The same plain data with one part exchanged wherever it stands."""
    if part is old:
        return new
    if isinstance(part, tuple):
        return tuple(_exchanged(each, old, new) for each in part)
    if is_dataclass(part) and not isinstance(part, type):
        fields = {name: _exchanged(getattr(part, name), old, new) for name in part.__dataclass_fields__}
        return type(part)(**fields)
    return part


def _another(value: Any, meaning: Quantity | Reference) -> Any:
    """Another value that an argument may have."""
    match value, meaning:
        case tuple(), _ if meaning == EXPRESSION:
            return (*value, ("negate", 0))
        case Span(first=first, last=last, by=by), _:
            return Span(first + 1.0, last + 1.0, by)
        case (), _:
            return ((1.0, 2.0),)
        case (((x, y), *others), _):
            return (x + 0.1, y), *others
        case tuple(), _:
            return tuple(each + 0.1 for each in value)
        case str(), Reference(words=words) if words:
            return next((word for word in words if word != value), f"another {value}")
        case str(), _:
            return f"another_{value}"
        case int(), Quantity(low=low, high=high):
            return value + 1 if value + 1 <= high else max(low, value - 1)
    assert isinstance(meaning, Quantity)
    moved = value + 0.01 if value + 0.01 <= meaning.high else value - 0.01
    assert meaning.low <= moved <= meaning.high
    return moved


def _parts_of_robots() -> Iterator[tuple[Graph, str, Any]]:
    """All of one mind, and of the others what it has not."""
    yield from ((GRAPH, noun, kind) for noun, kind in _parts(GRAPH))
    known = {type(kind) for _, kind in _parts(GRAPH)}
    for graph in (*(compiled(MIND.replace(WHEELS, robot)) for robot in OTHER_ROBOTS), compiled(OUTSIDE)):
        yield from ((graph, noun, kind) for noun, kind in _parts(graph) if type(kind) not in known)


def test_every_argument_of_every_kind_is_noticed() -> None:
    for graph, noun, kind in _parts_of_robots():
        taught_skill = next((lesson.skill for lesson in GRAPH.lessons if lesson.learner is kind), "Top")
        learner = next((skill.name for skill in GRAPH.skills if skill.function is kind and genes(skill)), taught_skill)
        lock = LOCK if graph is GRAPH else taught(graph)
        for argument in arguments(type(kind)):
            if (noun, names()[type(kind)], argument.field) not in NEED_NOT_BE_NOTICED:
                new = replace(kind, **{argument.field: _another(getattr(kind, argument.field), argument.type)})
                changed = _exchanged(graph, kind, new)
                assert changed != graph
                assert is_noticed(changed, learner, lock), f"{noun} {kind} with {argument.key} {new}"


def test_the_mind_of_these_tests_has_every_kind() -> None:
    """A kind that is new to the language has to stand here, or its changes might go unnoticed."""
    nouns = ("body", "actuator", "sensor", "memory", "skill", "task", "content", "event", "measure", "curriculum")
    everywhere = {(noun, cls) for noun in nouns for cls in kinds(noun).values()}
    here = {(noun, type(kind)) for _, noun, kind in _parts_of_robots()}
    elsewhere = {"plain", "map"}  # of which Other has one, and tests/language/test_maps.py
    assert {names()[cls] for _, cls in everywhere - here} == elsewhere


TEXTS = [
    ("tick 1/60 s", "tick 1/20 s", "taught with tick 1/60 s, now 1/20 s"),
    ("range 45 deg\n", "range 45 deg speed 2 deg\n", "taught with mast speed 360 deg, now 2 deg"),
    ("  ends on exh", "  opens fence on collision\n  ends on exh", "its task has changed: opens fence on collision"),
    ("tick 1/60 s", "tick 0.3 s", "taught with tick 1/60 s, now 0.3 s"),
    ("range 12", "range 3", "taught with eye range 12, now 3"),
    ("0 30 330 deg", "0 30 331 deg", "taught with eye at 0 30 330 deg, now 0 30 331 deg"),
    ("is disc", "is disc size 3", "taught with body size 2, now 3"),
    ("of ball_bearing", "of near", "taught with ball_drift of ball_bearing, now near"),
    ("size 2\n  contains bin", "size 3 to 1 by 0.5\n  contains bin", "taught with ball size 2, now 3 to 1 by 0.5"),
    ("ball is item size 2", "ball is item size 2 reached moves", "taught with ball reached stays, now moves"),
    ("ball is item size 2", "ball is item size 2 delivered stays", "taught with ball delivered moves, now stays"),
    ("robot count 2", "robot count 3", "taught with mate count 2, now 3"),
    ("slope size 3", "slope size 3 pull 9", "taught with hill pull 0, now 9"),
    ("  contains fe", "  contains kin is robot at 30 0\n  contains fe", "its task has changed: contains kin"),
    (
        "-20 on collision with mate", "-20 on collision",
        "its task has changed: no longer rewards -20 on collision with mate; "
        "its task has changed: rewards -20 on collision is new",
    ),
    ("bin is zone size 8", "bin is zone size 8 reached vanishes", "taught with bin reached stays, now vanishes"),
    ("crate is box size 2", "crate is box size 2 friction 0.2", "taught with crate friction 0.5, now 0.2"),
    ("crate is box size 2", "crate is ball size 2", None),
    ("  contains dock is power size 4\n", "", "its task has changed: no longer contains dock"),
    ("within 300", "within 299", None),
    ("of leave of bin\n", "of collision\n", None),
    ("rewards 10 on", "rewards 5 on", "its task has changed: rewards 10 on reach of ball, now 5"),
    (
        "rewards 0.01 * forward per tick when moving > 0.5",
        "rewards 0.01 * forward per tick",
        "its task has changed: no longer rewards 0.01 * forward per tick when moving > 0.5; "
        "its task has changed: rewards 0.01 * forward per tick is new",
    ),
    ("when p < 1/4", "when p <= 1/4", None),
    ("each p in fear", "each p in eye", None),
    ("lasts 600", "lasts 601", "its task has changed: lasts 600 ticks, now 601"),
    ("  ends on exhaustion\n", "", "its task has changed: no longer ends on exhaustion"),
    (
        "succeeds on 5",
        "succeeds on 4",
        "its task has changed: no longer succeeds on 5 delivery of ball to bin; "
        "its task has changed: succeeds on 4 delivery of ball to bin",
    ),
    (
        "left_wheel 0 to 10%",
        "left_wheel 0 to 20%",
        "its task has changed: no longer varies noise of left_wheel 0 to 0.1; "
        "its task has changed: varies noise of left_wheel 0 to 0.2 is new",
    ),
    ("  varies density of Robot 1 to 3\n", "", "its task has changed: no longer varies density of body 1 to 3"),
    ("fails right_wheel 1% per tick", "fails right_wheel 2% per tick", None),
    ("fails right_wheel 1% per tick", "fails claw 1% per tick", None),
    ("at 1/2 + north", "at 1/4 + north", "taught with tilt at 0.5 + north - pulse, now 0.25 + north - pulse"),
    ("arena size 80", "arena size 81", "its task has changed: in arena size 80, now 81"),
    ("genetic population 8", "genetic population 9", "taught with the learner population 8, now 9"),
    ("School is genetic", "School is restarting", None),
    ("drives mood at 1/2", "drives mood at 1/3", None),
    ("  drives mood at 1/2\n", "", "Grab has changed: sends mood at 0.5 is gone"),
    ("drives mood at 1/2", "drives mood at 1/2\n  drives mast at 1", "Grab has changed: sends mast at 1 is new"),
    ("influences Grab at 1", "influences Grab at 0.5", "Top has changed: sends Grab at 1, now sends Grab at 0.5"),
    ("Top on Fetch for 3 generations", "Top on Fetch for 3 generations from scratch", None),
    ("mood < 0.9", "mood < 0.8", None),
    ("mood < 0.9", "mood <= 0.9", None),
    ("influences Search when mood < 0.9", "influences Search", None),
    ("otherwise 0.2", "otherwise 0.3", None),
    (" otherwise 0.2", "", None),
    ("cuts below 5%", "cuts below 6%", None),
    (" cuts below 5%", "", None),
    ("influences Grab at 1", "influences Grab at 1\n  chooses one", "Top has changed: chooses one is new"),
    (
        "influences Grab at 1",
        "influences Grab over claw and mood at 1",
        "Top has changed: sends Grab at 1, now sends Grab over claw and mood at 1",
    ),
    ("influences Sway", "influences Sway over left_wheel", "Top has changed: sends Sway over left_wheel is new"),
    ("walker size 2", "walker size 2 seeks robot", "taught with cat without seeks, now seeks robot"),
    ("walker size 2", "walker size 2 flees ball range 5", None),
    ("crate is box size 2", "crate is box size 2 seeks cat", "taught with crate without seeks, now seeks cat"),
    ("mast at 2 * moving", "mast at 2 * moving when moving > 0.1 otherwise 0.5", None),
    ("starts at 20 -20", "starts at 20 -21", None),
    ("facing 90 deg", "facing 91 deg", None),
    ("  starts at 20 -20 facing 90 deg\n", "", None),
    ("from turn.by", "from turn.to", None),
    ("claw is gripper", "claw is gripper reach 2", "taught with claw reach 1.5, now 2"),
]  # fmt: skip


@pytest.mark.parametrize(("old", "new", "told"), TEXTS)
def test_what_changed_is_a_sentence(old: str, new: str, told: str | None) -> None:
    assert MIND.count(old) >= 1
    state = status(compiled(MIND.replace(old, new)), LOCK)["Top"]
    assert isinstance(state, Trained)
    assert state.changes
    if told is not None:
        assert "; ".join(state.changes) == told


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("  counts delivery of ball\n", ""),
        ("for 3 generations", "for 300 generations"),
        ("curriculum School", "curriculum Academy"),
        ("start 0.9", "start 0.5"),
        ("decay 0.5", "decay 0.6"),
        ("neutral 0.5\nactuator claw", "neutral 50%  # said otherwise\nactuator claw"),
        ("  reads near\n  reads holding\n", "  reads holding\n  reads near\n"),
        ("  rewards 10 on reach of ball\n", "  rewards 10   on reach of ball\n"),
        ("within 300 ticks", "within 5 s"),
        ("  ends on collision\n  ends on exhaustion\n", "  ends on exhaustion\n  ends on collision\n"),
        ("near + holding - home", "(near + holding) - home"),
        ("left_wheel 0 to 10%", "left_wheel 0% to 0.1"),
        ("task Elsewhere in plain", "task Elsewhere in arena size 9"),
        ("skill Top is mlp", "actuator flag is servo neutral 0.1\nskill Top is mlp"),
        ("skill Top is mlp", "actuator third is wheel side left neutral 0.5\nskill Top is mlp"),
        ("teaches Turnless on Elsewhere for 2", "teaches Turnless on Fetch for 2"),
        ("influences Go\n", "influences Go\n  stays frozen\n"),
        ("0 30 330 deg", "0 390 -30 deg"),
        ("bumper at -45 45 deg", "bumper at 315 45 deg"),
        ("facing 90 deg", "facing -270 deg"),
    ],
)
def test_what_changes_nothing_is_not_noticed(old: str, new: str) -> None:
    assert old in MIND
    state = status(compiled(MIND.replace(old, new)), LOCK)["Top"]
    assert isinstance(state, Trained)
    assert state.changes == ()


@pytest.mark.parametrize("actuator", ["wheel side left neutral 0.6", "gripper neutral 0.9"])
def test_what_moves_by_itself_is_noticed(actuator: str) -> None:
    """An actuator that no skill drives, and that does something at its neutral."""
    state = status(compiled(f"{MIND}\nactuator third is {actuator}\n"), LOCK)["Top"]
    assert isinstance(state, Trained)
    assert state.changes == ("taught without third",)


def test_a_claw_of_another_reach_is_noticed_by_a_skill_that_has_none() -> None:
    text = MIND.replace("  influences Grab at 1\n", "")
    lock = taught(compiled(text))
    state = status(compiled(text.replace("claw is gripper", "claw is gripper reach 3")), lock)["Top"]
    assert isinstance(state, Trained)
    assert state.changes == ("taught with a claw's reach of 1.5, now 3",)


@pytest.mark.parametrize("of", ["unread", "slope"])
def test_what_a_derivative_is_of_is_known_through_any_number_of_them(of: str) -> None:
    text = MIND.replace("derivative of ball_bearing", f"derivative of {of}")
    text += "\nsensor slope is derivative of bend\nsensor bend is derivative of unread\n"
    state = status(compiled(text.replace("start 0.9", "start 0.5")), taught(compiled(text)))["Top"]
    assert isinstance(state, Trained)
    assert state.changes == ("taught with unread start 0.9, now 0.5",)


def test_readings_in_another_order_are_other_readings() -> None:
    """The weights of an angle would get what another angle sees."""
    states = status(compiled(MIND.replace("0 30 330 deg", "30 0 330 deg")), LOCK)
    assert states["Go"] == Stale(("the readings of eye stand in another order",))


def test_the_text_of_a_procedure_is_noticed(tmp_path: Path) -> None:
    (tmp_path / "turn.py").write_text(PROCEDURE)
    lock = taught(GRAPH, tmp_path)
    state = status(GRAPH, lock, tmp_path)["Top"]
    assert isinstance(state, Trained)
    assert state.changes == ()
    (tmp_path / "turn.py").write_text(PROCEDURE.replace("return a", "return b"))
    state = status(GRAPH, lock, tmp_path)["Top"]
    assert isinstance(state, Trained)
    assert state.changes == ("the text of Turn's procedure has changed",)


def test_a_task_that_is_gone_is_told() -> None:
    text = MIND.replace("task Fetch", "task Bring").replace("  teaches Top on Fetch for 3 generations\n", "")
    state = status(compiled(text.replace("on Fetch", "on Bring")), LOCK)["Top"]
    assert isinstance(state, Trained)
    assert state.changes == ("its task Fetch is gone",)


def test_an_earlier_lesson_is_known_too(tmp_path: Path) -> None:
    """Taught on one task and then on another: both are kept, and of the same one the last."""
    text = MIND.replace(
        "for 3 generations\n\n", "for 3 generations\n  teaches Top on Elsewhere for 2 generations\n\n", 1
    )
    graph = compiled(text)
    first, second = (lesson for lesson in graph.lessons if lesson.skill == "Top")
    weights = {skill.name: np.zeros(genes(skill), np.float32) for skill in graph.skills if genes(skill)}
    path, worlds = tmp_path / "a.lock", Worlds(graph, None)
    below = {name: weights[name] for name in ("Go", "Search", "Sway", "Grow", "Lag")}
    record(path, graph, below, Taught("Fetch", "Go", False, 3, 8, 1, 1.0), {}, worlds.of(first))
    for lesson in (first, second, first, second):
        made = Taught(lesson.task, lesson.master, False, 3, 8, 1, 1.0)
        record(path, graph, {"Top": weights["Top"]}, made, below, worlds.of(lesson), read_lock(path))
    lock = read_lock(path)
    assert [world.lesson.task for world in lock["Top"].worlds] == ["Fetch", "Elsewhere"]
    state = status(compiled(text.replace("rewards 10 on", "rewards 9 on")), lock)["Top"]
    assert isinstance(state, Trained)
    assert {lesson.task for lesson in state.outdated} == {"Fetch"}


@pytest.mark.parametrize("place", [0, 1])
def test_the_lesson_that_a_line_tells_of_is_known_by_curriculum_and_number(place: int) -> None:
    again = "  teaches Top on Fetch for 3 generations\n"
    lessons = [each for each in compiled(MIND.replace(again, again * 2)).lessons if each.skill == "Top"]
    told = lessons[place]
    of = Taught("Fetch", told.master, False, 3, 8, 1, 1.0, told.number, told.curriculum)
    assert last_lesson(lessons, of) == told
    for other in ({"number": 9}, {"curriculum": "Other"}, {"task": "Elsewhere"}, {"number": 0, "curriculum": ""}):
        assert last_lesson(lessons, replace(of, **other)) is None


def test_worlds_are_written_once_and_read_back(tmp_path: Path) -> None:
    text = lock_text(LOCK)
    (tmp_path / "a.lock").write_text(text)
    assert read_lock(tmp_path / "a.lock") == LOCK
    (tmp_path / "a.lock").write_bytes(text.replace("\n", "\r\n").encode())
    assert read_lock(tmp_path / "a.lock") == LOCK, "as git writes it on Windows"
    assert text.count("\nworld ") == len({world.name for entry in LOCK.values() for world in entry.worlds})


JSON = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=5,
)


def _places(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    yield path
    if isinstance(value, dict | list):
        for key, part in value.items() if isinstance(value, dict) else enumerate(value):
            yield from _places(part, (*path, key))


def _with(value: Any, path: tuple[Any, ...], new: Any) -> Any:
    if not path:
        return new
    copy = value.copy()
    copy[path[0]] = _with(value[path[0]], path[1:], new)
    return copy


PLAIN = json.loads(json.dumps(dict(LOCK["Top"].worlds[0].facts)))
PLACES = [path for path in _places(PLAIN) if path]


@given(st.sampled_from(PLACES), JSON)
@settings(max_examples=cases(300))
def test_a_world_with_a_right_hash_and_odd_facts_is_refused_or_told(path: tuple[Any, ...], new: Any) -> None:
    world = TrainingWorld(_with(PLAIN, path, new))
    heading, *lines = world.text().split("\n")
    try:
        read = world_of(heading.split()[1], lines)
    except ValueError:
        return
    assert all(isinstance(each, str) for each in changes(read, LOCK["Top"].worlds[0]))
    assert all(isinstance(each, str) for each in changes(LOCK["Top"].worlds[0], read))


def test_a_world_says_everything_once() -> None:
    world = LOCK["Top"].worlds[0]
    heading, *lines = world.text().split("\n")
    assert world_of(heading.split()[1], lines) == world
    with pytest.raises(ValueError):  # noqa: PT011 - any: what reads it says that the lock is damaged
        world_of(heading.split()[1], [*lines, lines[-1]])


@pytest.mark.parametrize(
    "damage",
    [
        lambda text: text.replace("  tick = 0.01", "  tick = 0.02"),
        lambda text: text.replace("\nworld ", "\nwordl "),
        lambda text: text.replace("  tick", " tick"),
        lambda text: text[: text.index("\nworld ")] + "\n",
        lambda text: text.replace("taught in ", "taught in 0123456789abcdef "),
        lambda text: text.replace("seed 1 ", f"seed {'1' * 5000} "),
        lambda text: text.replace("score 1.0", "score 1e999"),
        lambda text: text.replace("  tick = ", f"  tick = {'[' * 100_000}"),
        lambda text: text + "\x00",
    ],
)
def test_a_damaged_world_damages_the_lock(tmp_path: Path, damage: Any) -> None:
    text = lock_text(LOCK)
    assert damage(text) != text
    (tmp_path / "a.lock").write_text(damage(text))
    with pytest.raises(LockError, match="damaged"):
        read_lock(tmp_path / "a.lock")


def test_status_tells_weights_that_are_gone_or_anothers(tmp_path: Path) -> None:
    from tests.edits.taught import teach, write_mind

    path = write_mind(tmp_path)
    teach(path)
    lock = read_lock(lock_path(path))
    blob = tmp_path / "weights" / f"{lock['Go'].weights}.npy"
    other = (tmp_path / "weights" / f"{lock['Avoid'].weights}.npy").read_bytes()
    blob.write_bytes(other)
    graph = load(path).graph
    assert graph
    row = next(row for row in rows(graph, [path]) if row.skill == "Go")
    assert (row.word, row.is_fine) == ("damaged", False)
    blob.unlink()
    row = next(row for row in rows(graph, [path]) if row.skill == "Go")
    assert "cannot be read" in row.remarks[0]
    assert not any("Go" in line and "fit" in line for line in survival(rows(graph, [path])))
