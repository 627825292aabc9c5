"""What moves by itself, step by step; which way it turns is taken from the lanes, if it may."""

import math

from mindrun.kinds.things.walker import Walker
from mindrun.numbers.trigonometry import cosine, sine


class PlainWalkers:
    """The walkers of a world, by their place among its things."""

    def __init__(self, of, directions, corners):
        self.of, self.directions = of, directions.copy()
        self.kinds = {i: thing.kind for i, thing in enumerate(of.things) if isinstance(thing.kind, Walker)}
        names = [thing.name for thing in of.things]
        self.ways, self.goals, first = {}, {}, {}
        for i, kind in self.kinds.items():
            before = sum(len(way) for name, ways in first.items() if name != names[i] for way in ways)
            first.setdefault(names[i], kind.ways)
            self.begin(i, kind, i - names.index(names[i]), corners[[*self.kinds].index(i)] - before)
        self.turned = {}

    def begin(self, i, kind, copy, corner):
        """Which way it is on, and to which place; what of it is drawn is taken from the lanes."""
        for way in kind.ways:
            if 0 <= corner < len(way):
                self.ways[i], self.goals[i] = way, corner
                if kind.from_ == "start":
                    assert corner == (copy + 1) % len(way)
                    assert tuple(self.of.places[i][:2]) == way[corner - 1] or math.isnan(self.of.places[i][0])
                elif not math.isnan(self.of.places[i][0]):
                    there = math.dist(way[corner - 1], self.of.places[i][:2])
                    assert (
                        there + math.dist(self.of.places[i][:2], way[corner])
                        < math.dist(way[corner - 1], way[corner]) + 1e-9
                    )
            corner -= len(way)

    def walk(self):
        """A step of each; `turned` is how far those that wander may turn now, None for anywhere."""
        self.turned = {}
        for i, kind in self.kinds.items():
            place, step = self.of.places[i], kind.speed * self.of.graph.tick
            if math.isnan(place[0]):
                continue
            if kind.along:
                self.go(i, self.ways[i][self.goals[i] % len(self.ways[i])], step)
                continue
            if (kind.seeks or kind.flees) and self.chases(i, kind, step):
                continue
            x, y = place[0] + cosine(self.directions[i]) * step, place[1] + sine(self.directions[i]) * step
            half = place[2] / 2
            if self.may_step(place[:2], (x, y), half, step):
                place[:2] = x, y
                self.turned[i] = kind.turning * math.sqrt(3 * self.of.graph.tick)
            else:
                self.turned[i] = None

    def chases(self, i, kind, step):
        """Whether it went straight towards the nearest that it seeks, or away from what it flees."""
        place = self.of.places[i]
        way = way_to(self.of, i, place[:2])
        if not way or way == (0.0, 0.0):
            return bool(way)
        to = place[0] + way[0], place[1] + way[1]
        if not self.may_step(place[:2], to, place[2] / 2, step):
            return False
        place[:2] = to
        return True

    def go(self, i, goal, step):
        """Towards a place, and not beyond it."""
        place = self.of.places[i]
        dx, dy = goal[0] - place[0], goal[1] - place[1]
        far = math.sqrt(dx * dx + dy * dy)
        if far <= step:
            place[:2] = goal
            self.goals[i] += 1
        else:
            place[:2] = place[0] + dx * (step / far), place[1] + dy * (step / far)

    def may_step(self, begin, end, half, step):
        """Whether a square may go there; of one that stands where it has no room the middle alone counts."""
        solids = self.of.body.solids
        if not self.is_free(*begin, half):
            return not solids.bar(begin, end)
        return self.is_free(*end, half) and (step <= half / 2 or not solids.bar(begin, end, half))

    def is_free(self, x, y, half):
        """Whether there is room for a square, as there is none beyond 1e9 units."""
        beside = (abs(x - bx) < wide + half and abs(y - by) < high + half for bx, by, wide, high in self.of.boxes)
        inside = all(side - abs(v) >= half and abs(v) <= 1e9 for side, v in zip(self.of.half, (x, y), strict=True))
        return inside and not any(beside)

    def turn(self, directions):
        """Which way each has turned, as the lanes have drawn it."""
        for i, far in self.turned.items():
            if i in self.of.changed or far is None:
                assert 0 <= directions[i] <= 2 * math.pi
            else:
                assert abs(directions[i] - self.directions[i]) <= far * (1 + 1e-9)
        self.directions = directions.copy()


def way_to(of, i, place):
    """The way that thing i would go in a tick from a place: to what it seeks or away from what it flees, if it can."""
    kind, name, step = of.things[i].kind, of.things[i].kind.thing, of.things[i].kind.speed * of.graph.tick
    others = [of.places[j][:2] for j, thing in enumerate(of.things) if thing.name == name and j != i]
    others = [(of.x, of.y)] if name == "robot" else [each for each in others if not math.isnan(each[0])]
    ways = [(x - place[0], y - place[1]) for x, y in others]
    ways = [(math.sqrt(dx * dx + dy * dy), dx, dy) for dx, dy in ways]
    far, dx, dy = min(ways, key=lambda way: way[0], default=(math.inf, 0.0, 0.0))
    if far > kind.range or (far == 0 and kind.flees):
        return None
    share = 0.0 if far == 0 else min(step / far, 1.0) if kind.seeks else -step / far
    return dx * share, dy * share
