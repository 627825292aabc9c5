"""Boxes and balls in a Space that is stepped in every tick: what the lanes are held against."""

import math

import pymunk
from mindrun.kinds.things.loose import Ball, LooseBox

from tests.sim.plain_strides import Mover
from tests.sim.plain_walkers import way_to

REST = 1e-3  # units and radians per second, below which what is loose stands still


def corners(half):
    """Of a square about its middle."""
    return [(-half, -half), (half, -half), (half, half), (-half, half)]


class PlainLoose:
    """The loose things of a world, by their place among its things; what has vanished is not there, but far away."""

    def __init__(self, space, of, dt):
        kinds, places = [thing.kind for thing in of.things], of.places
        self.space, self.of, self.kinds, self.dt, self.there, self.gone = space, of, kinds, dt, {}, []
        self.forces = {}
        self.are_any = any(isinstance(kind, LooseBox | Ball) for kind in kinds)
        for i, kind in enumerate(kinds):
            if isinstance(kind, LooseBox | Ball):
                self.add(i, kind, places[i])

    def add(self, i, kind, place):
        """A loose thing at its place."""
        body = pymunk.Body(1.0, 1.0)
        is_ball = isinstance(kind, Ball)
        shape = pymunk.Circle(body, 1.0) if is_ball else pymunk.Poly(body, corners(1.0))
        shape.friction = kind.friction
        self.space.add(body, shape)
        self.there[i] = body, shape
        self.resize(i, place)

    def resize(self, i, place):
        """Loose thing i has another size, and stands at a new place."""
        (body, shape), kind, size = self.there[i], self.kinds[i], place[2]
        if isinstance(kind, Ball):
            shape.unsafe_set_radius(size / 2)
            body.mass = kind.density * math.pi * (size / 2 * (size / 2))
            body.moment = body.mass * (size / 2 * (size / 2)) / 2
        else:
            shape.unsafe_set_vertices(corners(size / 2))
            body.mass = kind.density * (size * size)
            body.moment = body.mass * (size * size + size * size) / 12
        body.position, body.angle, body.velocity, body.angular_velocity = tuple(place[:2]), 0.0, (0.0, 0.0), 0.0

    def damp(self):
        """Loose things slow down, and rest."""
        for i, (body, _) in self.there.items():
            slower = 1 / (1 + self.dt * self.kinds[i].damping)
            (x, y), spin = body.velocity, body.angular_velocity * slower
            rests = max(abs(x * slower), abs(y * slower), abs(spin)) < REST
            body.velocity = (0.0, 0.0) if rests else (x * slower, y * slower)
            body.angular_velocity = 0.0 if rests else spin

    def drive(self):
        """The force of each that drives itself: it would take it where it wants to be when it has been damped again."""
        self.forces = {}
        for i in (i for i in self.there if self.kinds[i].thing):
            body, kind = self.there[i][0], self.kinds[i]
            (x, y), (vx, vy) = body.position, body.velocity
            if way := way_to(self.of, i, (x + vx * self.dt, y + vy * self.dt)):
                slower = 1 / (1 + self.dt * kind.damping)
                along = (way[0] / self.dt / slower - vx) * body.mass / self.dt
                across = (way[1] / self.dt / slower - vy) * body.mass / self.dt
                wanted = math.sqrt(along * along + across * across)
                share = kind.thrust / wanted if wanted > kind.thrust else 1.0
                self.forces[i] = along * share, across * share

    def push(self, share):
        """Let a share of these forces act in the next step."""
        for i, (x, y) in self.forces.items():
            self.there[i][0].force = x * share, y * share

    def rest(self):
        """What hardly moves stands."""
        for body, _ in self.there.values():
            if max(abs(body.velocity.x), abs(body.velocity.y), abs(body.angular_velocity)) < REST:
                body.velocity, body.angular_velocity = (0.0, 0.0), 0.0

    def movers(self, places):
        """As what moves, beside the robot."""
        found = []
        for i, (body, shape) in self.there.items():
            is_ball, size = isinstance(shape, pymunk.Circle), places[i][2]
            reach = size * (0.5 if is_ball else 0.7072)
            found.append(Mover(body, size / 2, reach, 0.0 if is_ball else reach))
        return found

    def distances(self, of, angle, more):
        """How far a ray from the robot's centre goes to each loose thing that it meets, if these are `more` larger."""
        yield from (self.distance(of, i, angle, more) for i in self.there)

    def distance(self, of, i, angle, more):
        """The same to one of them; infinitely far where the ray passes it, or begins in it."""
        span = self.span(of, i, angle, more) if i in self.there else None
        return span[0] if span and span[0] >= 0 else math.inf

    def span(self, of, i, angle, more):
        """Where the line from the robot's centre in a direction enters one of them and where it leaves it, if so."""
        body = self.there[i][0]
        half = of.places[i][2] / 2 + more
        turned = angle - body.angle
        c, s = math.cos(turned), math.sin(turned)
        x, y = (body.position - (of.x, of.y)).rotated(-body.angle)
        if isinstance(self.kinds[i], Ball):
            ahead, room = x * c + y * s, half**2 - (x * s - y * c) ** 2
            return (ahead - math.sqrt(room), ahead + math.sqrt(room)) if room >= 0 else None
        spans = [sorted(((v - half) / d, (v + half) / d)) for v, d in ((x, c), (y, s)) if abs(d) > 1e-12]
        spans += [(math.inf, math.inf) for v, d in ((x, c), (y, s)) if abs(d) <= 1e-12 and abs(v) > half]
        enter, leave = max(span[0] for span in spans), min(span[1] for span in spans)
        return (enter, leave) if enter <= leave < math.inf else None

    def replace(self, places, changed):
        """What has been moved elsewhere or has vanished."""
        for i in changed & self.there.keys():
            if math.isnan(places[i][0]):
                body, _ = self.there.pop(i)
                body.position, body.velocity, body.angular_velocity = (1e8 + 1e4 * i, 1e8), (0.0, 0.0), 0.0
                self.gone.append(body)  # its shape keeps its number, by which a hash has the order of all
            else:
                self.resize(i, places[i])
