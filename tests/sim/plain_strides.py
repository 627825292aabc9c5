"""How far a tick may take what moves at once, and what nothing may pass: for the loop of plain pymunk."""

import math

SWIFT, SHARE, MOST = 0.75, 0.5, 100
CLOSED, DEEPEST = 1e-6, 0.5


class Solids:
    """What never moves in a world: rectangles (x, y, half x, half y), and the border of an arena around them."""

    def __init__(self, boxes, half):
        self.boxes, self.half = boxes, half

    def bar(self, begin, end, half=CLOSED):
        """Whether they are in the way of something of that half size from one place to another."""
        for before, after, side in zip(begin, end, self.half, strict=True):
            if abs(after) > side - half and abs(before) <= side - half:
                return True
        dx, dy = end[0] - begin[0], end[1] - begin[1]
        return any(meets(x - begin[0], y - begin[1], dx, dy, a + half, b + half) for x, y, a, b in self.boxes)

    def wall(self, begin, end):
        """Whether one of them is wholly within the way from one place to another."""
        dx, dy = end[0] - begin[0], end[1] - begin[1]
        beyond = (box for box in self.boxes if abs(box[0] - end[0]) >= box[2] or abs(box[1] - end[1]) >= box[3])
        return any(meets(x - begin[0], y - begin[1], dx, dy, a, b) for x, y, a, b in beyond)

    def room(self, x, y):
        """How far a point is from all of them, along the axes; less than nothing inside."""
        inside = min(self.half[0] - abs(x), self.half[1] - abs(y))
        return min([inside, *(max(abs(bx - x) - wide, abs(by - y) - high) for bx, by, wide, high in self.boxes)])


def meets(x, y, dx, dy, wide, high):
    """Whether a way by (dx, dy) from outside a rectangle around (x, y) leads into it."""
    if abs(x) < wide and abs(y) < high:
        return False
    beside = abs(x - dx / 2) < wide + abs(dx) / 2 and abs(y - dy / 2) < high + abs(dy) / 2
    return beside and abs(x * dy - y * dx) < wide * abs(dy) + high * abs(dx)


def comes_nearer(x, y, dx, dy, near):
    """Whether a way by (dx, dy) comes nearer to (x, y) than that, and than where it begins."""
    along, length = x * dx + y * dy, dx * dx + dy * dy
    if along <= 0 or length == 0:
        return False
    share = min(1.0, along / length)
    aside = x - share * dx, y - share * dy
    return aside[0] * aside[0] + aside[1] * aside[1] < near * near


class Mover:
    """A body of pymunk: half its least side, how far it reaches around its middle, and which length its turns swing.

    What it holds, if anything, has its middle so far ahead, and is of that half size.
    """

    def __init__(self, body, half, reach, arm, held=None):
        self.body, self.half, self.reach, self.arm, self.held = body, half, reach, arm, held

    def stride(self, others, solids, dt):
        """For how many seconds it may move at once."""
        half, reach, arm = self.half, self.reach, self.arm
        if self.held:
            ahead, own = self.held
            half, reach, arm = min(half, own), max(reach, ahead + own), max(arm, ahead)
        (vx, vy), (x, y) = self.body.velocity, self.body.position
        speed = abs(vx) + abs(vy) + abs(self.body.angular_velocity) * arm
        if not speed * dt > SWIFT * half:
            return math.inf
        room = solids.room(x, y) - reach
        for other in others:
            far = max(abs(other.body.position.x - x), abs(other.body.position.y - y))
            its = max(other.reach, sum(other.held)) if other.held else other.reach
            room = min(room, (far - its - reach) / 2)
        return max(SHARE * half, room) / speed

    def places(self, turned):
        """The middles of the body and of what it holds, and the half sides of both; `turned`: cosine and sine."""
        x, y = self.body.position
        ahead, half = self.held or (0.0, 0.0)
        both = [((x, y), self.half), ((x + turned[0] * ahead, y + turned[1] * ahead), half)]
        return both if self.held else both[:1]


def stride(movers, solids, dt):
    """For how many seconds all of them may move at once."""
    return min(mover.stride([m for m in movers if m is not mover], solids, dt) for mover in movers)


class Watch:
    """Where everything is when a tick begins, and before each step: what passes something is put back."""

    def __init__(self, movers, solids, turned):
        self.movers, self.solids, self.turned = movers, solids, turned
        self.begin = self.all_places()

    def all_places(self):
        """Of each that moves."""
        return [mover.places(self.turned(mover.body.angle)) for mover in self.movers]

    def look(self):
        """A step begins."""
        self.angles = [mover.body.angle for mover in self.movers]
        self.before = self.all_places()

    def hold_back(self):
        """Put back what passes, one by one."""
        while (found := self.passing()) is not None:
            body = self.movers[found].body
            body.position, body.angle = self.before[found][0][0], self.angles[found]
            body.velocity, body.angular_velocity = (0.0, 0.0), 0.0

    def passing(self):
        """The first that has passed anything; None where none has."""
        now = self.all_places()
        each = enumerate(zip(self.begin, self.before, now, strict=True))
        parts = [(i, *part) for i, places in each for part in zip(*places, strict=True)]
        for i, (begin, half), (before, _), (end, _) in parts:
            if before == end:
                continue
            if self.solids.bar(begin, end):
                return i
            for j, (its, its_half), _, (its_end, _) in parts:
                near = half + its_half - DEEPEST * min(half, its_half)
                by = (e - b - (its_e - its_b) for b, e, its_b, its_e in zip(begin, end, its, its_end, strict=True))
                if i != j and comes_nearer(its[0] - begin[0], its[1] - begin[1], *by, near):
                    return i
        return None
