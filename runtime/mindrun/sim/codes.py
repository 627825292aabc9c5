"""A graph, a task and a master as plain tables, a row per sensor, skill, reward: a new mind needs no compiling.

Kinds are numbers there, and records have columns: what compiled code sees of a program and of a world.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mindrun.numbers.arrays import Array
from mindrun.sim.arrays import Block, table

PUSH, STEERING, GRIPPER, IDLE, SERVO, SIGNAL = range(6)
ITEM, ZONE, POWER, BOX, BALL, WALKER, OTHER_ROBOT, SLOPE = range(8)
STAYS, MOVES, VANISHES = range(3)
PROGRESS, ADVANCE, RETREAT, FORWARD, CHANGE, ITS_REWARD, APART, DRAWN_NUMBER, TALLIED, TIME = range(10)
REACH, DELIVERY, VISIT, COLLISION, EXHAUSTION, SUCCESS, ITS_END, LEAVE = range(8)
# How a number of a run comes about; before the world: CHOSEN and what comes after it.
CONSTANT, DRAWN, DRAWN_WHOLE, FAILING, TIMES, OVER, INVERSE, DAMPING, CHOSEN, BETWEEN, MADE = range(11)

GOING_ON, LOST, BROKEN_OFF = -1, -2, -4  # no event has ended a run: out of time, beyond FAR, its environment has
AWAY = 1e30  # units: where a box is that is none
HALF_DIAGONAL = 0.7072  # of a square with side 1, and a little more
WALL_COUNT = 4  # of an arena
PERSISTENCE_TICKS = 3  # for which Chipmunk remembers a contact that is no more
FAR = 1e9  # units from the origin, and radians: nothing is there, and a little further Chipmunk never comes back

FORCE, TORQUE, FORCE_X, FORCE_Y, FORCE_ASIDE, PUSH_ROWS = range(6)  # rows of what pushes a body, and how many

ACTUATOR_CODES = {
    "wheel": PUSH, "motor": PUSH, "thruster": PUSH, "steering": STEERING, "gripper": GRIPPER,
    "servo": SERVO, "signal": SIGNAL, "lamp": IDLE, "action": IDLE, "choice": IDLE,
}  # fmt: skip
THING_CODES = {
    "item": ITEM, "zone": ZONE, "power": POWER, "box": BOX, "ball": BALL, "walker": WALKER, "robot": OTHER_ROBOT,
    "slope": SLOPE,
}  # fmt: skip
MEASURE_CODES = {
    "progress": PROGRESS, "advance": ADVANCE, "retreat": RETREAT, "forward": FORWARD, "change": CHANGE,
    "its reward": ITS_REWARD, "distance": APART, "time": TIME,
}  # fmt: skip
EVENT_CODES = {
    "reach": REACH, "delivery": DELIVERY, "visit": VISIT, "collision": COLLISION, "exhaustion": EXHAUSTION,
    "success": SUCCESS, "its end": ITS_END, "leave": LEAVE,
}  # fmt: skip


Row = Mapping[str, float]  # of a table, by the names of its columns


def records(rows: Sequence[Row], columns: Any) -> Array:
    """A table with these columns; what a row does not say is 0."""
    table = np.zeros(len(rows), columns)
    for column in dict.fromkeys(column for row in rows for column in row):
        table[column] = np.fromiter((row.get(column, 0) for row in rows), table.dtype[column], len(rows))
    return table


def span(name: str, rows: range) -> Row:
    """The columns of some rows of a table that stand side by side: the first of them, and how many there are."""
    return {name: rows.start, f"{name}s": len(rows)}


def _columns(*inner: tuple[Any, ...], **names: str) -> np.dtype[Any]:
    """The kind of a record: names by their kinds, then what is made of several.

    Python, too, has them as attributes, so none may be called like one of `numpy.record`.
    """
    flat = [(name, kind) for kind, these in names.items() for name in these.split()]
    return np.dtype((np.record, np.dtype([*flat, *inner], align=True)))


# Where a column says what differs between runs, it is a row of `world.numbers`: that of every PARAMETER.
SENSOR = _columns(
    i8="start width thing things box boxes source ray number part before turns code length over "
    "is_rough is_aside noise lost every delay wait held ring servo",
    u8="lane",
    f8="range period",
    f4="low high dead_zone gain blank",
)
SKILL = _columns(
    i8="index input inputs outputs hidden width bias centred weights own edge edges state chooses", u8="lane address"
)
# Scopes are rows of `mind.scoped`: that of what weighs a command, or −1, and those in which an influence counts, too.
EDGE = _columns(i8="to_skill target output code length when whens other others scope scoped scopes", f4="cuts")
CODE = _columns(i8="op arg", f8="value")
ACTUATOR = _columns(
    i8="kind is_right delay ring is_noisy is_slipping is_sticky is_rough thrust turn speed noise slip starts wait "
    "fails",
    f8="ahead aside arm reach",
    f4="neutral",
)
PARAMETER = _columns(i8="form of", f8="low high")
MEMORY = _columns(i8="row kept left right compass", u8="lane", f8="left_way right_way", f4="decay rest start")
THING = _columns(
    i8="kind drawn is_round is_fixed reached delivered is_reached is_delivered is_area loose settles walker is_goal "
    "number copy copies option options is_within inside insides x_row y_row",
    f8="first last by low high hold x y left right below above slide_x slide_y pull_x pull_y",
)
LOOSE = _columns(i8="thing is_round density friction slower number step thrust after afters aim", f8="range")
TEAM = _columns(i8="thing master paid")
WALKING = _columns(i8="thing way ways copy is_anywhere is_drawn step turn after afters aim", f8="range")
WAY = _columns(i8="first places")
CORNER = _columns(i8="next x_row y_row", f8="x y")
OBSTACLE = _columns(i8="columns rows count option options x_row y_row", f8="first last grid jitter x y low high")
MEASURES = _columns(i8="kind thing things of ofs over ring row", f8="beyond")
MAKING = _columns(i8="row code length")
PRESENCE = _columns(i8="thing box boxes when whens")
EVENT = _columns(i8="kind thing things to tos arrival columns rows board after window left is_common", f8="patch")
END = _columns(i8="event times when whens succeeds is_end box boxes")
TALLY = _columns(i8="event when whens code length longest row")
REWARD = _columns(i8="code length on each eachs when whens last")
WORLD = _columns(
    i8="linear angular friction mass moment mass_inv moment_inv is_round is_placed is_faced ticks rays battery "
    "number paid items hash_size slopes",
    f8="dt radius front side arm least slop cell axles half_x half_y start_x start_y facing start drain charge near "
    "claw",
)

# What is solid: its sides, where it is, how it is turned, for which size it has been made, how much it weighs, half of
# its least side. Of a circle the first corner is its middle. `bias` is the velocity that parts what overlaps. It moves
# with the solid `body`, and is of a `robot`, by its number, or of none, −1; `turn` is its place in the hash.
POINT, MOTION = _columns(f8="x y"), _columns(f8="x y spin")
SOLID = _columns(
    ("velocity", MOTION),
    ("bias", MOTION),
    ("corners", POINT, 4),
    ("own_corners", POINT, 4),  # where it is not turned
    ("begin", POINT),  # where it was as the tick began, before this step and after it (lanes/solid)
    ("before", POINT),
    ("after", POINT),
    i8="is_round is_asleep number body robot turn",
    f8="left right low high middle_x middle_y turned cosine sine radius made friction mass_inv moment_inv half "
    "before_angle",
)
# Where a pair touches, from the middles of both: the impulses along the normal and across it, how heavy both are there,
# how fast to part them, and the impulse that does.
CONTACT = _columns(u8="hash", f8="x y its_x its_y along across mass_along mass_across bias parting")
# What touches, or did a few steps ago: what it is of, the step that it touched in last, the solids whose motion counts,
# what the hash has found and where, the things in claws that both are, or −1, and the radius of what is.
PAIR = _columns(
    ("contacts", CONTACT, 2),
    i8="key used is_first own other found rank thing its_thing count",
    f8="normal_x normal_y friction reach",
)
# The steps of a world: how long the last one was, or 0, which share of an overlap one so long takes back, and how many
# there were; the pairs, and those that touch; how many solids are awake. And of each robot, in its own lane: the pairs
# of it with what never moves, the robots that it touches, a bit for each, and the thing in its claw, or −1.
SPACE = _columns(i8="steps pairs touching awake run_into met in_claw", f8="seconds take_back")


F4, F8, I8, U8 = np.float32, np.float64, np.int64, np.uint64


@dataclass(frozen=True)
class Tables(Block):
    """Everything about the program and its task that is the same in every lane."""

    world: Array = table(WORLD)
    sensors: Array = table(SENSOR)
    rays: Array = table(F4, 2)  # [2, rays]: cosine and sine of each ray's angle
    rims: Array = table(F4)  # [rays]: how far from the robot's middle each ray leaves it
    ray_row: Array = table(I8)  # the row of readings that each ray writes
    passes: Array = table(I8, 2)  # [2, rays]: the first thing that each goes on through, and the last + 1
    numbers: Array = table(F8)  # of the sensors whose kinds say `numbers`
    measured: Array = table(bool)  # [graph.width]: which readings anybody writes
    skills: Array = table(SKILL)
    inputs: Array = table(I8)  # rows of readings, skill after skill, and scopes, edge after edge
    edges: Array = table(EDGE)
    codes: Array = table(CODE)
    weights: Array = table(F4)  # of the skills that do not learn
    actuators: Array = table(ACTUATOR)
    memories: Array = table(MEMORY)
    parameters: Array = table(PARAMETER)
    things: Array = table(THING)
    loose: Array = table(LOOSE)
    robots: Array = table(TEAM)  # of a world, each with the row of `things` that it is to the others, or −1
    walkers: Array = table(WALKING)
    ways: Array = table(WAY)  # that walkers go along
    corners: Array = table(CORNER)  # the places of ways
    options: Array = table(F8, 2)  # [places, 2]: those of which one is drawn
    makings: Array = table(MAKING)  # of numbers that are made of those that the task draws
    presences: Array = table(PRESENCE)  # of things and boxes that are not there in every run
    choices: Array = table(F8)  # the values of numbers that the task draws
    obstacles: Array = table(OBSTACLE)
    walls: Array = table(F8, 2)  # [walls, BOX_COLUMNS]: the boxes that stand in the same places in every run
    measures: Array = table(MEASURES)
    events: Array = table(EVENT)
    ends: Array = table(END)
    tallies: Array = table(TALLY)
    rewards: Array = table(REWARD)
    library: Array = table(U8)  # addresses of Chipmunk's functions
