"""A world computed the slow and obvious way, with pymunk's own classes: what the lanes are held against."""

import math
from collections import deque

import numpy as np
import pymunk
from mindrun.kinds.actuators.actuator import Gripper, Motor, Servo, Steering, Thruster, Wheel
from mindrun.kinds.bodies.body import Car, Disc, Holonomic
from mindrun.kinds.events.event import Collision, Delivery, Exhaustion, Leave, Reach, Success, Visit
from mindrun.kinds.measures.measure import Advance, Apart, CommandChange, Forward, Progress, Retreat, Time
from mindrun.kinds.scenes.scene import Arena
from mindrun.kinds.sensors.battery import Battery
from mindrun.kinds.sensors.compass import Compass, Direction
from mindrun.kinds.sensors.contact import Contact, Held, Inside
from mindrun.kinds.sensors.motion import Inertial
from mindrun.kinds.sensors.nearest import Bearing
from mindrun.kinds.sensors.rays import RangeFinder
from mindrun.kinds.things.loose import Ball, LooseBox
from mindrun.kinds.things.obstacle import Obstacle
from mindrun.kinds.things.slope import Slope
from mindrun.kinds.things.thing import Item, Power, Zone
from mindrun.numbers.trigonometry import cosine, sine

from mindlang.physics_check import ROBOT_FRICTION
from tests.plain import f, postfix
from tests.sim.plain_bodies import front_of, radius_of, rim_of, side_of, sides_of
from tests.sim.plain_loose import PlainLoose
from tests.sim.plain_sensors import sensed
from tests.sim.plain_strides import MOST, Mover, Solids, Watch, meets, stride
from tests.sim.plain_walkers import PlainWalkers

TRAIL, OPENED = 20, 1e30  # ticks; and where a box is that is none
MOVABLE = Item | LooseBox | Ball


class PlainWorld:
    """One run of a task, followed moment by moment. What has just been placed anew is taken from the lanes."""

    def __init__(self, graph, task, run, battery):
        self.graph, self.task, self.runs_down = graph, task, battery
        apart = [thing for thing in task.things if not thing.kind.is_obstacle]
        self.things = [thing for thing in apart for _ in range(thing.kind.copies)]
        self.places, self.boxes = run.things.copy(), run.boxes.copy()
        size = task.scene.size if isinstance(task.scene, Arena) else math.inf
        self.half = tuple(side / 2 for side in (size if isinstance(size, tuple) else (size, size)))
        self.radius = radius_of(graph.body)
        self.x, self.y, self.angle = (float(v) for v in run.begin)
        self.held, self.t, self.touched = -1, 0, False
        self.reached, self.delivered, self.changed = set(), set(), set()
        self.arrivals, self.latest = {}, {}
        self.cell = next((s.kind for s in graph.sensors if isinstance(s.kind, Battery)), Battery())
        self.charge = self.cell.start
        self.trail = deque([(self.x, self.y)] * TRAIL, TRAIL)
        self.commands = [a.kind.neutral for a in graph.actuators]
        self.swivel = {a.name: self.sent(a.kind, f(a.kind.neutral)) for a in graph.actuators if a.kind.carries}
        self.late = [deque([f(a.kind.neutral)] * a.kind.delay) for a in graph.actuators]
        self.turns = {i: deque() for i, m in enumerate(task.measures) if isinstance(m, CommandChange)}
        self.counts = [0] * len(task.events)
        self.visited = [{self.patch(event)} for event in task.events]
        self.lines = [np.float64(0)] * len(task.rewards)
        self.tallies, self.stretches = [0.0] * len(task.tallies), [0.0] * len(task.tallies)
        self.history = {}
        self.body = PlainBody(self)
        self.drawn = run.drawn[len(run.drawn) - len(task.draws) :].tolist()
        self.walkers = PlainWalkers(self, run.turned, run.state.world.goal[:, 0].tolist())
        self.there = [self.present(event) if isinstance(event, Leave) else set() for event in task.events]

    @staticmethod
    def sent(kind, command):
        """The angle to the left to which a command sends a servo."""
        return (1 - 2 * float(command)) * kind.range

    def looks(self, kind):
        """The angle in the world that is straight ahead for a sensor."""
        return self.angle + self.swivel.get(kind.servo, 0.0)

    def patch(self, event):
        """Where the robot is on an event's board, if it has one."""
        if not isinstance(event, Visit):
            return None
        patches = [math.ceil(2 * half / event.size) for half in self.half]
        places = zip((self.x, self.y), self.half, patches, strict=True)
        return tuple(min(last - 1, max(0, int((v + half) / event.size))) for v, half, last in places)

    def true(self, sensor):
        """A physical sensor's readings as they are: a list of (least, most), and what is read where one is lost."""
        kind = sensor.kind
        all_of = [i for i, thing in enumerate(self.things) if thing.name in kind.things]
        boxes = [box for name in kind.things for box in self.boxes_of(name)]
        match kind:
            case RangeFinder():
                return [self.ray(self.looks(kind) + at, kind) for at in kind.at], 1.0
            case Battery():
                return [(float(f(self.charge)),) * 2], None
            case Bearing():
                return [self.bearing(self.nearest(all_of, boxes), kind)], 0.5
            case Compass():
                return [pointed(math.sin(self.angle), math.cos(self.angle), kind.dead_zone)], 0.5
            case Direction():
                return [(0.5 - self.swivel[kind.of] / (2 * math.pi),) * 2], 0.5
            case Contact():
                value = any(self.in_claw(i, self.reach()) for i in all_of)
            case Held():
                value = self.held in all_of
            case Inside():
                value = any(self.inside(i, self.x, self.y) for i in all_of)
            case Inertial():
                moved = math.dist((self.x, self.y), self.trail[0]) / (TRAIL * self.graph.tick * kind.range)
                return [zoned(min(1.0, moved), kind.dead_zone, 0.0)], 0.0
            case _:
                return sensed(self, kind, all_of, boxes)
        return [(float(value),) * 2], 0.0

    def boxes_of(self, name):
        """The boxes of obstacles of a name that have not been opened."""
        return [self.boxes[i] for i in self.rows_of(name) if self.boxes[i][0] != OPENED]

    def open(self, name):
        """Take the obstacles of a name out of the world."""
        for i in self.rows_of(name):
            self.boxes[i] = OPENED, OPENED, 0.0, 0.0
            self.body.open(i)

    def rows_of(self, name):
        """Which boxes are of a name: what always stands there comes first, what is anywhere last."""
        solid = [thing for thing in self.task.things if thing.kind.is_obstacle]
        fixed = [thing for thing in solid if not isinstance(thing.kind, Obstacle)]
        anywhere = [thing for thing in solid if thing not in fixed and not thing.kind.at and not thing.kind.grid]
        placed = [thing for thing in solid if thing not in fixed and thing not in anywhere]
        owners = [
            thing.name for thing in fixed + placed + anywhere for _ in range(thing.kind.obstacles(self.task.scene))
        ]
        return [i for i, owner in enumerate(owners) if owner == name]

    def nearest(self, all_of, boxes=()):
        """The place of the nearest of these that have not vanished, or the nearest point of boxes, if any."""
        there = [self.places[i] for i in all_of if not math.isnan(self.places[i][0])]
        there += [
            (min(max(self.x, x - wide), x + wide), min(max(self.y, y - high), y + high), 0.0)
            for x, y, wide, high in boxes
        ]
        return min(there, key=self.away, default=None)

    def bearing(self, place, kind):
        """Least and most of a bearing; (0, 1) where it may be either side of the seam."""
        if place is None or (kind.range and self.away(place) > kind.range):
            return 0.5, 0.5
        dx, dy = place[0] - self.x, place[1] - self.y
        c, s = math.cos(self.looks(kind)), math.sin(self.looks(kind))
        return pointed(c * dx + s * dy, c * dy - s * dx, kind.dead_zone)

    def ray(self, angle, kind):
        """Least and most of what a range finder reads: what it grazes, or stands in by a hair, may be met or missed."""
        near, far = sorted(self.distance(angle, more) for more in (1e-3, -1e-3))
        rim = rim_of(self.graph.body, angle - self.angle)
        least, most = (min(1.0, max(0.0, (d - rim) / kind.range)) for d in (near, far))
        return zoned(least, kind.dead_zone, 0.0)[0], zoned(most, kind.dead_zone, 0.0)[1]

    def distance(self, angle, more, loose=None, boxes=None):
        """How far a ray goes among boxes that are `more` larger; one that the robot's centre is in is not seen."""
        c, s = math.cos(angle), math.sin(angle)
        found = math.inf
        for sign in (-1, 1):
            for position, half, direction in ((self.x, self.half[0], c), (self.y, self.half[1], s)):
                if direction * sign > 1e-12:
                    found = min(found, (sign * half - position) / direction)
        for x, y, half_x, half_y in self.boxes if boxes is None else boxes:
            enter, leave = -math.inf, math.inf
            for low, high, direction in (
                (x - half_x - more - self.x, x + half_x + more - self.x, c),
                (y - half_y - more - self.y, y + half_y + more - self.y, s),
            ):
                if abs(direction) > 1e-12:
                    one, other = low / direction, high / direction
                    enter, leave = max(enter, min(one, other)), min(leave, max(one, other))
                elif low > 0 or high < 0:
                    leave = -1.0
            if 0 <= enter <= leave:
                found = min(found, enter)
        return min([found, *(self.body.loose.distances(self, angle, more) if loose is None else loose)])

    def reach(self):
        """How far the claw reaches."""
        return next((a.kind.reach for a in self.graph.actuators if isinstance(a.kind, Gripper)), 1.5)

    def in_claw(self, i, reach):
        """Whether a thing is ahead of the claw's place on the rim, and near enough."""
        dx, dy = self.places[i][0] - self.x, self.places[i][1] - self.y
        c, s = cosine(self.angle), sine(self.angle)
        ahead, aside = c * dx + s * dy - front_of(self.graph.body), c * dy - s * dx
        return ahead >= 0 and ahead**2 + aside**2 <= (reach + self.places[i][2] / 2) ** 2

    def away(self, place):
        """How far the robot is from a place."""
        dx, dy = place[0] - self.x, place[1] - self.y
        return math.sqrt(dx * dx + dy * dy)  # a square by ** may differ in the last bit

    def inside(self, i, x, y):
        """Whether a point is in the square of a thing."""
        return max(abs(self.places[i][0] - x), abs(self.places[i][1] - y)) <= self.places[i][2] / 2

    def seen(self, sensor):
        """For each reading of a sensor the (least, most) that it may be now: late, seldom, noisy, lost."""
        kind, (true, blank) = sensor.kind, self.true(sensor)
        past = self.history.setdefault(sensor.name, [])
        past.append(true)
        at = max(0, self.t - kind.delay) // max(1, kind.every) * max(1, kind.every)
        # a battery that could not be read says what it said before
        known = past[: at + 1] if blank is None and kind.lost else [past[at]]
        found = []
        for k in range(sensor.width):
            spans = [(ticks[k][0] - kind.noise, ticks[k][1] + kind.noise) for ticks in known]
            if isinstance(kind, Bearing | Compass | Direction):
                spans = [(low + turn, high + turn) for low, high in spans for turn in (-1, 0, 1)]
            else:
                spans = [(max(0.0, low), min(1.0, high)) for low, high in spans]
            found.append([*spans, (blank, blank)] if kind.lost and blank is not None else spans)
        return found

    def act(self, wanted):
        """The commands that act in this tick, of those that the hierarchy wants."""
        now = []
        for command, late in zip(wanted, self.late, strict=True):
            late.append(command)
            now.append(late.popleft())
        self.last, self.commands = self.commands, [float(c) for c in now]
        return now

    def grip(self, acting):
        """What the claw holds, and where servos are, under the commands as they act."""
        for actuator, command in zip(self.graph.actuators, acting, strict=True):
            if isinstance(actuator.kind, Servo):
                left = self.sent(actuator.kind, command) - self.swivel[actuator.name]
                self.swivel[actuator.name] += min(actuator.kind.speed, max(-actuator.kind.speed, left))
            if isinstance(actuator.kind, Gripper):
                if command <= 0.5:
                    self.held = -1
                elif self.held < 0:
                    items = [i for i, thing in enumerate(self.things) if isinstance(thing.kind, Item)]
                    near = (i for i in items if self.in_claw(i, actuator.kind.reach))
                    self.held = next((i for i in near if self.has_room(i)), -1)

    def rolling(self, kind):
        """How fast a wheel or a motor rolls."""
        body = self.body.body
        ahead = body.velocity.x * cosine(self.angle) + body.velocity.y * sine(self.angle)
        out = {"left": -1, "right": 1}.get(getattr(kind, "side", ""), 0) * side_of(self.graph.body)
        return ahead + out * body.angular_velocity

    def has_room(self, i):
        """Whether nothing solid is between the robot and an item in its claw, or in the way there."""
        ahead = front_of(self.graph.body) + self.body.largest[i] / 2
        there = self.x + cosine(self.angle) * ahead, self.y + sine(self.angle) * ahead
        loose = [self.places[each] for each in self.body.loose.there]
        for x, y in ((self.x, self.y), self.places[i][:2]):
            by = there[0] - x, there[1] - y
            if self.body.solids.bar((x, y), there) or any(meets(a - x, b - y, *by, c / 2, c / 2) for a, b, c in loose):
                return False
        half, along = self.places[i][2] / 2, (cosine(self.angle), sine(self.angle))
        rims = (along, (-along[1], along[0]), (along[1], -along[0]))
        return not any(
            self.body.solids.wall((self.x, self.y), (there[0] + half * dx, there[1] + half * dy)) for dx, dy in rims
        )

    def step(self, acting, kept):
        """One tick of physics, the battery, and what is carried; each actuator has kept a share of its force."""
        self.was = self.x, self.y
        self.far = [self.away(place) for place in self.places]
        self.apart = [self.between(measure) for measure in self.task.measures]
        self.trail.append(self.was)
        drawn = [each.kind for i, each in enumerate(self.things) if self.is_on_slope(i, self.x, self.y)]
        pull = [(cosine(kind.facing) * kind.pull, sine(kind.facing) * kind.pull) for kind in drawn]
        state = self.body.step(acting, kept, cosine(self.angle), sine(self.angle), self.held, self.places, pull)
        self.x, self.y, self.angle = state[:3]
        for i, (body, _) in self.body.loose.there.items():
            self.places[i][:2] = body.position
        if self.held >= 0:
            hold = front_of(self.graph.body) + self.body.largest[self.held] / 2
            self.places[self.held][:2] = self.x + cosine(self.angle) * hold, self.y + sine(self.angle) * hold
        self.slide()
        self.walkers.walk()
        powered = [i for i, thing in enumerate(self.things) if isinstance(thing.kind, Power)]
        if self.runs_down:
            charged = any(self.inside(i, self.x, self.y) for i in powered)
            self.charge += self.cell.charge if charged else -self.cell.drain
            self.charge = min(1.0, max(0.0, self.charge))
        return state

    def is_on_slope(self, i, x, y):
        """Whether thing i is a slope on which a point is."""
        return isinstance(self.things[i].kind, Slope) and self.inside(i, x, y)

    def slide(self):
        """Items that nobody holds slide down the first slope on which they lie."""
        for k, item in enumerate(self.things):
            x, y, _ = self.places[k]
            slopes = [each.kind for i, each in enumerate(self.things) if self.is_on_slope(i, x, y)]
            if isinstance(item.kind, Item) and k != self.held and slopes:
                far, facing = slopes[0].slides * self.graph.tick, slopes[0].facing
                self.places[k][:2] = x + cosine(facing) * far, y + sine(facing) * far

    def happened(self):
        """How often each event of the task did."""
        reached, delivered = self.begin()
        began, self.touched = self.body.touches and not self.touched, self.body.touches
        found = []
        for event, visited in zip(self.task.events, self.visited, strict=True):
            about = {i for i, thing in enumerate(self.things) if thing.name == getattr(event, "of", None)}
            match event:
                case Reach(by=by) | Leave(by=by) if by or isinstance(event, Leave):
                    before, now = self.there[len(found)], self.present(event)
                    self.there[len(found)] = now
                    found.append(len(now - before if isinstance(event, Reach) else before - now))
                case Reach():
                    found.append(len(about & reached))
                case Delivery(to=""):
                    found.append(len(about & delivered))
                case Delivery():
                    found.append(self.arrived(event, about))
                case Visit():
                    found.append(int(self.patch(event) not in visited))
                    visited.add(self.patch(event))
                case Collision():
                    found.append(int(began))
                case Exhaustion():
                    found.append(int(self.charge == 0))
                case Success():
                    found.append(0)  # `ends` knows
        self.latest |= {event: self.t for event, times in zip(self.task.events, found, strict=True) if times}
        return [times * self.is_soon(event) for event, times in zip(self.task.events, found, strict=True)]

    def is_soon(self, event):
        """Whether the other event that one has to come soon after, if any, happened in this tick or not long ago."""
        within = event.within
        return within is None or self.t - self.latest.get(within.of, -math.inf) <= within.ticks

    def present(self, event):
        """Which things, by their rows, are at any of those that an event is about; −1 is the robot."""
        return {k for k in self.named(event.by) or [-1] if any(self.is_at(k, i) for i in self.named(event.of))}

    def is_at(self, k, i):
        """Whether thing k, or the robot, is in a zone, or near enough to anything else."""
        x, y, size = self.places[k] if k >= 0 else (self.x, self.y, 0.0)
        if isinstance(self.things[i].kind, Zone | Power | Slope):
            return self.inside(i, x, y)
        dx, dy = x - self.places[i][0], y - self.places[i][1]
        most = self.reach() + size / 2 + self.places[i][2] / 2
        return dx * dx + dy * dy <= most * most

    def named(self, name):
        """The rows of the things of a name."""
        return [i for i, thing in enumerate(self.things) if thing.name == name]

    def between(self, measure):
        """The least distance between two things that a measure is about; infinite where there are none."""
        least = math.inf
        for one in self.named(getattr(measure, "of", "")):
            for other in self.named(getattr(measure, "to", "") or measure.thing):
                dx, dy = (a - b for a, b in zip(self.places[one][:2], self.places[other][:2], strict=True))
                square = dx * dx + dy * dy
                least = square if square < least else least
        return math.sqrt(least)

    def arrived(self, event, items):
        """How many items come into one of the zones of an event, and were not in one in the tick before."""
        zones = [i for i, thing in enumerate(self.things) if thing.name == event.to]
        now = {i for i in items & self.inside_now if any(self.inside(z, *self.places[i][:2]) for z in zones)}
        before, self.arrivals[event] = self.arrivals.get(event, set()), now
        return len(now - before)

    def begin(self):
        """What begins to be in reach, and what to be delivered; `changed` is what moves or vanishes by it."""
        kinds = [thing.kind for thing in self.things]
        zones = [i for i, kind in enumerate(kinds) if isinstance(kind, Zone)]
        areas = {i for i, kind in enumerate(kinds) if isinstance(kind, Zone | Power | Slope)}
        reached = {i for i in areas if self.inside(i, self.x, self.y)}
        reached |= {i for i in range(len(kinds)) if i not in areas and self.in_claw(i, self.reach())}
        carried = {self.held, *self.delivered, *self.body.loose.there} - {-1}
        delivered = {i for i in carried if any(self.inside(z, *self.places[i][:2]) for z in zones)}
        self.inside_now = delivered
        new = reached - self.reached, delivered - self.delivered
        self.changed = {i for i in new[0] if kinds[i].reached != "stays"}
        self.changed |= {i for i in new[1] if kinds[i].delivered != "stays"}
        self.reached, self.delivered = reached - self.changed, delivered - self.changed
        return new

    def measured(self):
        """The task's measures."""
        names = [thing.name for thing in self.things]
        closed = {name: self.closed([i for i, its in enumerate(names) if its == name]) for name in names}
        found = []
        for i, measure in enumerate(self.task.measures):
            if measure.other:
                now = self.between(measure)
                nearer = now if isinstance(measure, Apart) else self.apart[i] - now if now < math.inf else 0.0
                nearer = max(0.0, nearer) if isinstance(measure, Advance) else nearer
                nearer = max(0.0, -nearer) if isinstance(measure, Retreat) else nearer
                found.append(nearer if now < math.inf else 0.0)
                continue
            match measure:
                case Time():
                    found.append(self.t + 1.0)
                case Apart(to=of):
                    there = [self.away(self.places[j]) for j, its in enumerate(names) if its == of]
                    found.append(min((far for far in there if not math.isnan(far)), default=0.0))
                case Forward():
                    dx, dy = self.x - self.was[0], self.y - self.was[1]
                    found.append(float(dx * cosine(self.angle) + dy * sine(self.angle) > 1e-6))
                case Progress(toward=of):
                    found.append(closed[of])
                case Advance(toward=of):
                    found.append(max(0.0, closed[of]))
                case Retreat(from_=of):
                    found.append(max(0.0, -closed[of]))
                case CommandChange(beyond=beyond, over=over):
                    found.append(self.thrust_changed(self.turns[i], beyond, over))
        return found

    def closed(self, rows):
        """How much nearer the nearest of some things is; 0 where all have vanished."""
        there = [i for i in rows if not math.isnan(self.far[i])]
        return min(self.far[i] for i in there) - min(self.away(self.places[i]) for i in there) if there else 0.0

    def thrust_changed(self, ticks, beyond, over):
        """ΣΔ of both sides; what is in the middle counts to the left."""
        sides = dict.fromkeys(("left", "right"), 0.0)
        for actuator, now, before in zip(self.graph.actuators, self.commands, self.last, strict=True):
            match actuator.kind:
                case Wheel(side=side):
                    sides[side] += abs(now - float(f(before)))
                case Thruster(at=(_, y)):
                    sides["right" if y < 0 else "left"] += abs(now - float(f(before)))
                case Motor():
                    sides["left"] += abs(now - float(f(before)))
        ticks.append(sides)
        while len(ticks) > over:
            ticks.popleft()
        return sum(max(0.0, sum(tick[side] for tick in ticks) - beyond) for side in sides)

    def ends(self, happened, readings):
        """The number of the end that has come, −1 for none; where that is a success, its event has happened."""
        self.found = self.measured()
        self.counts = [count + it for count, it in zip(self.counts, happened, strict=True)]
        self.tally(happened, readings)
        for number, end in enumerate(self.task.ends):
            if end.when is None:
                met = happened[end.event] and self.counts[end.event] >= end.times
            else:
                met = self.value(end.when, readings, self.found, 0) > 0
            if met and end.opens:
                self.open(end.opens)
            elif met:
                for i, event in enumerate(self.task.events):
                    happened[i] += int(end.succeeds and isinstance(event, Success) and self.is_soon(event))
                return number
        return -1

    def tally(self, happened, readings):
        """Add what happened to each tally, where its condition holds."""
        for i, tally in enumerate(self.task.tallies):
            times = 1 if tally.event is None else happened[tally.event]
            times = times if tally.value is None else self.value(tally.value, readings, self.found, 0)
            if tally.when is not None and not self.value(tally.when, readings, self.found, 0) > 0:
                self.stretches[i] = 0.0
                continue
            self.stretches[i] += times
            longest = max(self.tallies[i], self.stretches[i])
            self.tallies[i] = longest if tally.longest else self.tallies[i] + times

    def reward(self, happened, readings):
        """Add what each line pays."""
        found = self.found
        for i, line in enumerate(self.task.rewards):
            if line.on is not None and not happened[line.on]:
                continue
            rows = range(line.each[0], sum(line.each)) if line.each else [0]
            for row in rows:
                value = self.value(line.amount, readings, found, row)
                is_paid = line.when is None or self.value(line.when, readings, found, row) > 0
                if is_paid and line.last:
                    self.lines[i] = np.float64(value)
                elif is_paid:
                    self.lines[i] = self.lines[i] + value * (1 if line.on is None else happened[line.on])
        self.t += 1

    def value(self, program, readings, found, row):
        """A reward's program as one over readings alone."""
        words = {
            "measure": lambda i: ("number", found[i]),
            "each": lambda i: ("reading", row),
            "command": lambda i: ("number", self.commands[i]),
            "drawn": lambda i: ("number", self.drawn[i]),
            "tally": lambda i: ("number", self.tallies[i]),
        }
        return postfix([words.get(word, lambda i, word=word: (word, i))(i) for word, i in program], readings)


def pointed(ahead, aside, dead_zone):
    """(least, most) of what reads a direction in the robot's frame."""
    if math.hypot(ahead, aside) < 1e-4 or (ahead < 0 and abs(aside) < 1e-4):
        return 0.0, 1.0
    return zoned(0.5 - math.atan2(aside, ahead) / (2 * math.pi), dead_zone, 0.5)


def zoned(value, dead_zone, otherwise):
    """(least, most) of a reading around its dead zone; both where rounding decides."""
    off = abs(value - otherwise) - dead_zone
    low, high = value - 2e-6, value + 2e-6
    if off < -1e-6:
        return otherwise, otherwise
    return (low, high) if off > 1e-6 else (min(low, otherwise), max(high, otherwise))


class PlainBody:
    """The robot in a Space of its own that is stepped in every tick."""

    def __init__(self, of):
        graph = of.graph
        kind, dt = graph.body, graph.tick
        self.dt, self.kind, self.actuators = dt, kind, [a.kind for a in graph.actuators]
        self.linear, self.angular = 1 / (1 + dt * kind.linear_damping), 1 / (1 + dt * kind.angular_damping)
        spans = [thing.kind.size for thing in of.things]
        moving = [span for thing, span in zip(of.things, spans, strict=True) if isinstance(thing.kind, MOVABLE)]
        self.half = min(front_of(kind), side_of(kind))
        least = min([self.half, *(min(span.first, span.last) / 2 for span in moving)])
        self.slop = min(pymunk.Space().collision_slop, 0.25 * max(least, 1e-3))
        self.solids, self.last = Solids(of.boxes, of.half), math.inf
        self.space = self.room()
        self.body = self.solid()
        self.body.position, self.body.angle = (of.x, of.y), of.angle
        self.largest = [max(span.first, span.last) for span in spans]
        self.items = {
            i: self.add(pymunk.Circle(self.body, 1.0, (front_of(kind) + self.largest[i] / 2, 0.0)), ROBOT_FRICTION)
            for i, thing in enumerate(of.things)
            if isinstance(thing.kind, Item)
        }
        self.loose = PlainLoose(self.space, of, self.dt)
        self.touches = False

    def room(self):
        """A Space with what never moves."""
        self.space = pymunk.Space()
        self.space.iterations = 8
        self.space.collision_slop = self.slop
        self.space.use_spatial_hash(20.0, 20)
        self.fixed = []
        for i, (x, y, wide, high) in enumerate(self.solids.boxes):
            there = (x - wide, y - high, x + wide, y + high) if x != OPENED else (0.0, 0.0, 1.0, 1.0)
            self.fixed.append(self.box(*there))
            if x == OPENED:  # it had a number, which others do not get
                self.open(i)
        if self.solids.half[0] < math.inf:
            (a, b), (c, d) = self.solids.half, (half + 2 for half in self.solids.half)
            for sides in ((-c, -d, -a, d), (a, -d, c, d), (-c, -d, c, -b), (-c, b, c, d)):
                self.box(*sides)
        return self.space

    def forget(self, movers):
        """All that moves into a Space that remembers nothing, with bodies that do not either."""
        old = self.space
        shapes = [shape for shape in old.shapes if shape.body is not old.static_body]
        old.remove(*shapes, *old.bodies)
        self.loose.space = self.room()
        self.space.add(*self.loose.gone)
        for mover in movers:
            before, mover.body = mover.body, pymunk.Body(mover.body.mass, mover.body.moment)
            mover.body.position, mover.body.angle = before.position, before.angle
            mover.body.velocity, mover.body.angular_velocity = before.velocity, before.angular_velocity
            self.space.add(mover.body)
            for shape in [*before.shapes]:
                shape.body = mover.body
        for shape in shapes:
            self.space.add(shape)
        self.body = movers[0].body
        there = zip(self.loose.there.items(), movers[1:], strict=True)
        self.loose.there = {i: (mover.body, shape) for (i, (_, shape)), mover in there}

    def solid(self):
        """The body with its outline."""
        kind = self.kind
        if isinstance(kind, Disc | Holonomic):
            radius = kind.size / 2
            mass = kind.density * math.pi * radius**2
            body = pymunk.Body(mass, mass * radius**2 / 2)
            shape = pymunk.Circle(body, radius)
        else:
            long, wide = sides_of(kind)
            mass = kind.density * long * wide
            body = pymunk.Body(mass, pymunk.moment_for_box(mass, (long, wide)))
            x, y = long / 2, wide / 2
            shape = pymunk.Poly(body, [(-x, -y), (x, -y), (x, y), (-x, y)])
        self.space.add(body)
        self.add(shape, kind.friction)
        return body

    def box(self, left, low, right, high):
        """Something solid."""
        shape = pymunk.Poly(self.space.static_body, [(left, low), (right, low), (right, high), (left, high)])
        return self.add(shape, 1.0)

    def open(self, i):
        """A box out of the Space, where it still is in there."""
        if self.fixed[i]:
            self.space.remove(self.fixed[i])
            self.fixed[i] = None

    def add(self, shape, friction):
        """A shape of the world or of the robot."""
        shape.friction = friction
        self.space.add(shape)
        return shape

    def step(self, commands, kept, c, s, held, places, pull=()):
        """x, y, angle and their velocities a tick later."""
        for i, item in self.items.items():
            item.sensor = i != held
            if i == held:
                item.unsafe_set_radius(places[i][2] / 2)
        body = self.body
        ahead, aside, torque, turned = self.pushes(commands, kept)
        body.velocity = (body.velocity.x * self.linear, body.velocity.y * self.linear)
        body.angular_velocity *= self.angular
        if isinstance(self.kind, Car):
            self.roll(turned, c, s)
        x, y = (ahead * c - aside * s, ahead * s + aside * c)
        for pull_x, pull_y in pull:
            x, y = x + pull_x, y + pull_y
        body.force, body.torque = (x, y), torque
        self.loose.damp()
        self.loose.drive()
        self.stride(held, places)
        body = self.body
        return (*body.position, body.angle, *body.velocity, body.angular_velocity)

    def stride(self, held, places):
        """A tick in as many steps as it takes; the force acts in the last of them."""
        kind, left, self.touches = self.kind, self.dt, False
        force, torque, reach = self.body.force, self.body.torque, radius_of(kind)
        item = (front_of(kind) + self.largest[held] / 2, places[held][2] / 2) if held >= 0 else None
        movers = [Mover(self.body, self.half, reach, 0.0 if isinstance(kind, Disc | Holonomic) else reach, item)]
        movers += self.loose.movers(places)
        is_swift = stride(movers, self.solids, self.dt) < self.dt
        watch = Watch(movers, self.solids, lambda angle: (cosine(angle), sine(angle)))
        if held >= 0:
            watch.begin[0][1] = tuple(places[held][:2]), item[1]
        for number in range(MOST):
            most = stride(movers, self.solids, self.dt) if is_swift else self.dt
            is_last = most >= left or number == MOST - 1
            seconds = min(most, left) if is_last else min(most, left / 2)
            if seconds > self.last:
                self.forget(movers)
            share = self.dt / seconds if is_last else 0.0
            self.body.force, self.body.torque = (force[0] * share, force[1] * share), torque * share
            self.loose.push(share)
            watch.look()
            self.space.step(seconds)
            contacts = []
            self.body.each_arbiter(lambda arbiter: contacts.extend(arbiter.shapes))  # noqa: B023
            touches = any(shape.body is self.space.static_body for shape in contacts)
            self.touches |= touches
            self.last = seconds if self.touches or self.loose.are_any else math.inf
            self.loose.rest()
            if self.last < math.inf:
                watch.hold_back()
            left -= seconds
            if is_last:
                break

    def pushes(self, commands, kept):
        """The force ahead and to the left, the torque, and how far to the left the wheels of a car are turned."""
        ahead = aside = torque = turned = 0.0
        for kind, command, share in zip(self.actuators, commands, kept, strict=True):
            way = 1.0 - 2.0 * float(command)
            match kind:
                case Steering():
                    turned = way * kind.range
                case Wheel():
                    half = side_of(self.kind)
                    push = -way * kind.thrust * share
                    ahead += push
                    torque += (-half if kind.side == "left" else half) * push
                case Motor():
                    ahead += -way * kind.thrust * share
                case Thruster(at=(x, y), facing=facing):
                    push, forward, left = -way * kind.thrust * share, cosine(facing), sine(facing)
                    ahead += forward * push
                    aside += left * push
                    torque += (x * left - y * forward) * push
        return ahead, aside, torque, turned

    def roll(self, turned, c, s):
        """Nothing but what a bicycle's axles let through, of the same momentum along it."""
        body, axles = self.body, self.kind.wheelbase * sides_of(self.kind)[0]
        slope = sine(turned) / cosine(turned)
        way = 1.0, slope / 2, slope / axles  # ahead, to the left, and turning
        weight = 1.0, 1.0, body.moment * (1 / body.mass)
        now = (
            body.velocity.x * c + body.velocity.y * s,
            body.velocity.y * c - body.velocity.x * s,
            body.angular_velocity,
        )
        along = sum(a * b * w for a, b, w in zip(now, way, weight, strict=True))
        along /= sum(a * a * w for a, w in zip(way, weight, strict=True))
        body.velocity = along * c - along * way[1] * s, along * s + along * way[1] * c
        body.angular_velocity = along * way[2]
