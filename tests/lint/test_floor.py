"""The floor of an arena in parts: those that a flood makes which spreads from place to place, as a robot could go."""

from collections import deque
from itertools import product

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mindrun.kinds.things.thing import Rectangle

from mindlang.lint.rules import walled_off as module
from mindlang.lint.rules.walled_off import floor
from tests.draws import cases

RADIUS, STEP = 0.9, 0.1
CORNERS = st.integers(-4, 3)
WALLS = st.tuples(CORNERS, CORNERS, st.integers(1, 4), st.integers(1, 2), st.booleans())
Place = tuple[float, float]
FENCE = Rectangle(0.0, 0.0, 0.5, 20.0)  # from below to above, in an arena of 40


def rectangle(left: int, low: int, long: int, thick: int, is_upright: bool) -> Rectangle:
    wide, high = (thick, long) if is_upright else (long, thick)
    return Rectangle(left + wide / 2, low + high / 2, wide / 2, high / 2)


def is_free(place: Place, sides: Place, walls: list[Rectangle]) -> bool:
    """Whether a robot can be there: a wall is in nobody who is as far from it as his radius, or 0.7 of it both ways."""
    if any(abs(at) > side / 2 - RADIUS for at, side in zip(place, sides, strict=True)):
        return False
    for wall in walls:
        x, y = abs(place[0] - wall.x) - wall.half_x, abs(place[1] - wall.y) - wall.half_y
        near = 0.7071 * RADIUS
        if (x < RADIUS and y < 0) or (x < 0 and y < RADIUS) or (x < near and y < near):
            return False
    return True


def flooded(sides: Place, walls: list[Rectangle]) -> dict[Place, int]:
    """The number of the part of each free place of a grid."""
    columns, rows = (round(side / STEP) for side in sides)
    grid = {
        (i, j): (round(-sides[0] / 2 + (i + 0.5) * STEP, 9), round(-sides[1] / 2 + (j + 0.5) * STEP, 9))
        for i, j in product(range(columns), range(rows))
    }
    free = {at for at, place in grid.items() if is_free(place, sides, walls)}
    parts: dict[tuple[int, int], int] = {}
    for start in sorted(free):
        waiting, number = deque([start]), len({*parts.values()})
        while waiting:
            i, j = waiting.popleft()
            if (i, j) in free and (i, j) not in parts:
                parts[i, j] = number
                waiting += [(i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)]
    return {grid[at]: number for at, number in parts.items()}


@settings(max_examples=cases(100))
@given(st.lists(WALLS, max_size=4), st.sampled_from([(8.0, 6.0), (5.0, 7.0)]))
def test_its_parts_are_those_of_a_flood(drawn: list[tuple[int, int, int, int, bool]], sides: Place) -> None:
    walls = [rectangle(*wall) for wall in drawn]
    found, expected = floor(sides, walls, RADIUS), flooded(sides, walls)
    assert found
    pairs = {(number, *found.parts_near(place, 0.0)) for place, number in expected.items()}
    assert len(pairs) == len(found.areas) == len({*expected.values()})
    assert all(len(pair) == 2 for pair in pairs)
    assert len({part for _, part in pairs}) == len(pairs)
    for number, part in pairs:
        area = STEP**2 * sum(each == number for each in expected.values())
        assert found.areas[part] == pytest.approx(area, rel=0.3, abs=0.3)
    part_of = dict(pairs)
    for i, j in product((-2, 0, 2), (-1, 2)):
        at = (i + 0.05, j + 0.05)
        near = {
            reach: {part_of[n] for p, n in expected.items() if max(abs(p[0] - at[0]), abs(p[1] - at[1])) <= reach}
            for reach in (0.35, 0.65)
        }
        assert near[0.35] <= found.parts_near(at, 0.5) <= near[0.65]
        assert (at in expected) == bool(found.parts_near(at, 0.0))


def test_a_passage_as_wide_as_the_robot_is_open() -> None:
    for gap, parts in ((2.0, 1), (1.999, 2)):
        halves = [Rectangle(0.0, sign * (10 + gap / 4), 0.5, 10 - gap / 4) for sign in (-1, 1)]
        found = floor((40.0, 40.0), halves, 1.0)
        assert found
        assert len(found.areas) == parts
    assert found.areas == pytest.approx([17.5 * 38 + 1, 17.5 * 38 + 1], rel=1e-4)  # and the corners of the gap
    assert found.parts_near((-10.0, 0.0), 0.0) == {0}
    assert found.parts_near((10.0, 0.0), 0.0) == {1}
    assert found.parts_near((0.0, 0.0), 0.0) == set()
    assert found.parts_near((0.0, 0.0), 0.5) == {0, 1}
    assert found.parts_near((0.0, 0.0), 0.49) == set()
    assert found.parts_near((-21.0, -21.0), 2.0) == {0}
    assert found.parts_near((21.0, 21.0), 2.0) == {1}
    assert found.parts_near((21.0, 21.0), 0.5) == set()


def test_an_arena_without_walls_is_one_part() -> None:
    found = floor((40.0, 20.0), [], 1.0)
    assert found
    assert found.areas == pytest.approx([38 * 18], rel=1e-5)
    assert found.parts == [[0]]


def test_of_a_robot_without_room_there_is_no_floor_nor_of_too_many_cells(monkeypatch: pytest.MonkeyPatch) -> None:
    assert floor((1.9, 40.0), [], 1.0) is None
    assert floor((40.0, 1.9), [], 1.0) is None
    assert floor((2.0, 2.0), [], 1.0)
    found = floor((40.0, 40.0), [FENCE], 1.0)
    assert found
    cells = len(found.xs) * len(found.ys)
    monkeypatch.setattr(module, "MAX_CELLS", cells)
    assert floor((40.0, 40.0), [FENCE], 1.0) == found
    monkeypatch.setattr(module, "MAX_CELLS", cells - 1)
    assert floor((40.0, 40.0), [FENCE], 1.0) is None
