"""Kinds as numbers, and the columns of the tables: what compiled code sees of a program."""

from typing import Any

import numpy as np

from mindrun.kinds.registry import kinds

PUSH, STEERING, GRIPPER, IDLE = range(4)
ITEM, ZONE, POWER, BOX, BALL, WALKER = range(6)
STAYS, MOVES, VANISHES = range(3)
PROGRESS, ADVANCE, RETREAT, FORWARD, CHANGE, ITS_REWARD = range(6)
REACH, DELIVERY, VISIT, COLLISION, EXHAUSTION, SUCCESS, ITS_END = range(7)
CONSTANT, DRAWN, DRAWN_WHOLE, FAILING, TIMES, OVER, INVERSE, DAMPING = range(8)  # how a number of a run comes about

GOING_ON, LOST, BROKEN_OFF = -1, -2, -4  # no event has ended a run: out of time, beyond FAR, its environment has
AWAY = 1e30  # units: where a box is that is none
FAR = 1e9  # units from the origin, and radians: nothing is there, and a little further Chipmunk never comes back

FORCE, TORQUE, FORCE_X, FORCE_Y, FORCE_ASIDE, PUSH_ROWS = range(6)  # rows of what pushes a body, and how many

ACTUATOR_CODES = {
    "wheel": PUSH, "motor": PUSH, "thruster": PUSH, "steering": STEERING, "gripper": GRIPPER,
    "servo": IDLE, "lamp": IDLE, "action": IDLE, "choice": IDLE,
}  # fmt: skip
THING_CODES = {"item": ITEM, "zone": ZONE, "power": POWER, "box": BOX, "ball": BALL, "walker": WALKER}
MEASURE_CODES = {
    "progress": PROGRESS, "advance": ADVANCE, "retreat": RETREAT, "forward": FORWARD, "change": CHANGE,
    "its reward": ITS_REWARD,
}  # fmt: skip
EVENT_CODES = {
    "reach": REACH, "delivery": DELIVERY, "visit": VISIT, "collision": COLLISION, "exhaustion": EXHAUSTION,
    "success": SUCCESS, "its end": ITS_END,
}  # fmt: skip


def sensor_codes() -> dict[str, int]:
    """The number of every kind of sensor, by its name."""
    return {name: code for code, name in enumerate(sorted(kinds("sensor")))}


def function_codes() -> dict[str, int]:
    """The number of every kind of function, by its name."""
    return {name: code for code, name in enumerate(sorted(kinds("skill")))}


# Where a column says what differs between runs, it is a row of `world.numbers`: that of every PARAMETER.
def _row(**columns: str) -> np.dtype[Any]:
    return np.dtype(list(columns.items()), align=True)


SENSOR = _row(
    kind="i8", start="i8", width="i8", thing="i8", things="i8", box="i8", boxes="i8", source="i8", ray="i8",
    number="i8", part="i8", before="i8", turns="i8", code="i8", length="i8", over="i8", low="f4", high="f4",
    range="f8", dead_zone="f4", gain="f4", period="f8",
    is_rough="i8", is_aside="i8", noise="i8", lost="i8", blank="f4", every="i8", delay="i8", wait="i8", held="i8",
    ring="i8",
)  # fmt: skip
SKILL = _row(
    kind="i8", index="i8", input="i8", inputs="i8", outputs="i8", hidden="i8", width="i8", weights="i8", own="i8",
    edge="i8", edges="i8", address="u8", state="i8",
)  # fmt: skip
EDGE = _row(
    to_skill="i8", target="i8", output="i8", code="i8", length="i8",
    when="i8", whens="i8", other="i8", others="i8", cuts="f4",
)  # fmt: skip
CODE = _row(op="i8", arg="i8", value="f8")
ACTUATOR = _row(
    kind="i8", ahead="f8", aside="f8", arm="f8", is_right="i8", neutral="f4", reach="f8", delay="i8", ring="i8",
    is_noisy="i8", is_slipping="i8", is_rough="i8", is_late="i8",
    thrust="i8", turn="i8", noise="i8", slip="i8", wait="i8", fails="i8",
)  # fmt: skip
PARAMETER = _row(form="i8", of="i8", low="f8", high="f8")
MEMORY = _row(row="i8", decay="f4", rest="f4", start="f4")
THING = _row(
    kind="i8", first="f8", last="f8", by="f8", low="f8", high="f8", hold="f8", drawn="i8", is_round="i8",
    is_fixed="i8", x="f8", y="f8", reached="i8", delivered="i8", is_reached="i8", is_delivered="i8", is_area="i8",
    loose="i8", settles="i8", walker="i8", is_goal="i8",
)  # fmt: skip
LOOSE = _row(thing="i8", is_round="i8", density="i8", friction="i8", slower="i8")
WALKING = _row(thing="i8", step="f8", turn="f8", first="i8", places="i8", begins="i8")
OBSTACLE = _row(
    first="f8", last="f8", grid="f8", jitter="f8", columns="i8", rows="i8", x="f8", y="f8",
    count="i8", low="f8", high="f8",
)  # fmt: skip
MEASURES = _row(kind="i8", thing="i8", things="i8", beyond="f8", over="i8", ring="i8")
EVENT = _row(
    kind="i8", thing="i8", things="i8", to="i8", tos="i8", arrival="i8",
    columns="i8", rows="i8", patch="f8", board="i8",
)  # fmt: skip
END = _row(event="i8", times="i8", when="i8", whens="i8", succeeds="i8")
REWARD = _row(code="i8", length="i8", on="i8", each="i8", eachs="i8", when="i8", whens="i8")
WORLD = _row(
    dt="f8", linear="i8", angular="i8", friction="i8", mass="i8", moment="i8", mass_inv="i8", moment_inv="i8",
    radius="f8", front="f8", side="f8", arm="f8", least="f8", slop="f8", is_round="i8", axles="f8",
    half_x="f8", half_y="f8",
    is_placed="i8", start_x="f8", start_y="f8", is_faced="i8", facing="f8",
    ticks="i8", start="f8", drain="f8", charge="f8", rays="i8",
    near="f8", master="i8", claw="f8", battery="i8", cell="f8",
)  # fmt: skip
