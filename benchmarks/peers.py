"""Other systems that move a small robot in the plane, beside this one: agent-steps per second of CPU time, on one core.

    python -m benchmarks.peers [--rounds 3] [--seconds 2] [PEER…]     # in turns; --list says what a step of each is
    python -m benchmarks.peers --install build/peers      # each peer's packages, in an environment of its own
    python -m benchmarks.peers --environments build/peers

The bold world is that of `examples/collect`: a disc in an arena of side 100 among 16 boxes, pushed by two wheels, ten
range finders of range 12, a network 14-32-30-2 (one for all robots) that acts in every tick of 1/60 s. A peer whose
packages are not there is left out, and named.
"""

import argparse
import importlib.util
import json
import math
import os
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from statistics import median
from typing import Any, NamedTuple

ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
ONE_THREAD |= {"JAX_PLATFORMS": "cpu", "XLA_FLAGS": "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"}
os.environ.update(ONE_THREAD)

import numpy as np  # noqa: E402  after the number of threads

ROOT = Path(__file__).resolve().parent.parent
LAYER_SIZES = 14, 32, 30, 2
ANGLES = np.radians([0, 22.5, 45, 90, 135, 180, 225, 270, 315, 337.5])
TICK_SECONDS, WHEEL_THRUST, RANGE_UNITS, HALF_SIDE_UNITS, ROBOT_MASS, ROBOT_INERTIA = (
    1 / 60,
    80.0,
    12.0,
    50.0,
    2 * math.pi,
    math.pi,
)
LINEAR_SHARE, ANGULAR_SHARE = 1 / (1 + TICK_SECONDS * 5), 1 / (1 + TICK_SECONDS * 20)
CALL_TICKS = 32  # of all robots, in a call that is timed
Step = Callable[[], object]


class Ready(NamedTuple):
    """A peer that is set up: what is called, and how many agent-steps that makes."""

    call: Step
    steps: int


def layers(sizes: tuple[int, ...] = LAYER_SIZES) -> list[Any]:
    """Random matrices [values in, values out] of a network."""
    rng = np.random.default_rng(0)
    return [(rng.normal(size=(a, b)) / math.sqrt(a)).astype(np.float32) for a, b in pairwise(sizes)]


def network(matrices: list[Any], values: Any, squash: Any = np.tanh) -> Any:
    """The outputs of a network."""
    for matrix in matrices:
        values = squash(values @ matrix)
    return values


def rocks() -> Any:
    """The boxes [16, 3]: x, y and half a side."""
    rng = np.random.default_rng(0)
    at = [(-30 + 20 * i, -30 + 20 * j) for i in range(4) for j in range(4)]
    return np.array([(x + rng.uniform(-1, 1), y + rng.uniform(-1, 1), rng.uniform(2, 4)) for x, y in at], np.float32)


def starts(count: int) -> Any:
    """Places between the boxes and angles [count, 3]."""
    rng = np.random.default_rng(1)
    return np.column_stack([rng.integers(0, 3, (count, 2)) * 20 - 20, rng.uniform(-math.pi, math.pi, count)])


def mind(task: str) -> Ready:
    """Collect's whole hierarchy, or the skill Avoid, with the shipped weights."""
    import mindlang

    loaded, runs = mindlang.load(str(ROOT / "examples" / "collect" / "collect.mind")), 256
    ticks = int(loaded.bench(task, runs=runs, workers=1)["ticks"])
    return Ready(lambda: loaded.bench(task, runs=runs, workers=1), ticks)


def plain_pymunk() -> Ready:
    """One Space for each robot, in a loop of Python."""
    import pymunk

    matrices, own, seen = layers(), pymunk.ShapeFilter(categories=2), pymunk.ShapeFilter(mask=1)

    def robot(x: float, y: float, angle: float) -> Step:
        space = pymunk.Space()
        space.iterations = 8
        corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
        sides = [pymunk.Segment(space.static_body, (50 * a, 50 * b), (50 * c, 50 * d), 0)
                 for (a, b), (c, d) in zip(corners, corners[1:] + corners[:1], strict=True)]  # fmt: skip
        boxes = [
            pymunk.Poly(space.static_body, [(x + h * a, y + h * b) for a, b in corners]) for x, y, h in rocks().tolist()
        ]
        for shape in (*sides, *boxes):
            shape.filter = pymunk.ShapeFilter(categories=1)
        body = pymunk.Body(ROBOT_MASS, ROBOT_INERTIA)
        body.position, body.angle = (x, y), angle
        disc = pymunk.Circle(body, 1)
        disc.filter = own
        space.add(body, disc, *sides, *boxes)

        def tick() -> None:
            (x, y), angle = body.position, body.angle
            values = np.array([*[1.0] * 10, x / 50, y / 50, math.cos(angle), math.sin(angle)], np.float32)
            for ray, turn in enumerate(ANGLES + angle):
                end = x + RANGE_UNITS * math.cos(turn), y + RANGE_UNITS * math.sin(turn)
                if hit := space.segment_query_first((x, y), end, 0, seen):
                    values[ray] = hit.alpha
            left, right = network(matrices, values).tolist()
            body.apply_force_at_local_point((WHEEL_THRUST * (0.5 + left / 2), 0), (0, 1))
            body.apply_force_at_local_point((WHEEL_THRUST * (0.5 + right / 2), 0), (0, -1))
            space.step(TICK_SECONDS)
            body.velocity, body.angular_velocity = body.velocity * LINEAR_SHARE, body.angular_velocity * ANGULAR_SHARE

        return tick

    robots = [robot(*place) for place in starts(8).tolist()]
    return Ready(lambda: [tick() for tick in robots for _ in range(CALL_TICKS)], len(robots) * CALL_TICKS)


def box2d() -> Ready:
    """One world for each robot, in a loop of Python."""
    import Box2D as b2  # type: ignore[import-untyped]  # noqa: N813

    matrices = layers()

    class Ray(b2.b2RayCastCallback):  # type: ignore[misc]
        share = 1.0

        def ReportFixture(self, fixture: Any, point: Any, normal: Any, fraction: float) -> float:  # noqa: N802
            self.share = fraction
            return fraction

    def robot(x: float, y: float, angle: float) -> Step:
        world, ray = b2.b2World(gravity=(0, 0)), Ray()
        corners = [(-50, -50), (50, -50), (50, 50), (-50, 50)]
        world.CreateStaticBody(shapes=b2.b2LoopShape(vertices=corners))
        for box_x, box_y, half in rocks().tolist():
            world.CreateStaticBody(position=(box_x, box_y), shapes=b2.b2PolygonShape(box=(half, half)))
        body = world.CreateDynamicBody(position=(x, y), angle=angle, linearDamping=5, angularDamping=20)
        body.CreateCircleFixture(radius=1, density=2, friction=0.2)

        def tick() -> None:
            (x, y), angle = body.position, body.angle
            values = np.array([*[1.0] * 10, x / 50, y / 50, math.cos(angle), math.sin(angle)], np.float32)
            for number, turn in enumerate(ANGLES + angle):
                ray.share = 1.0
                world.RayCast(ray, (x, y), (x + RANGE_UNITS * math.cos(turn), y + RANGE_UNITS * math.sin(turn)))
                values[number] = ray.share
            for side, value in zip((1, -1), network(matrices, values).tolist(), strict=True):
                force = body.GetWorldVector((WHEEL_THRUST * (0.5 + value / 2), 0))
                body.ApplyForce(force, body.GetWorldPoint((0, side)), True)
            world.Step(TICK_SECONDS, 8, 3)

        return tick

    robots = [robot(*place) for place in starts(8).tolist()]
    return Ready(lambda: [tick() for tick in robots for _ in range(CALL_TICKS)], len(robots) * CALL_TICKS)


def cartpole() -> Ready:
    """Gymnasium's vector environment of 1,024 carts in numpy, without a body, rays or contact; 1,478 weights."""
    import gymnasium

    carts, matrices = 1024, layers((4, 38, 34, 1))
    environment = gymnasium.make_vec("CartPole-v1", num_envs=carts, vectorization_mode="vector_entry_point")
    values = environment.reset(seed=0)[0]

    def call() -> None:
        nonlocal values
        for _ in range(CALL_TICKS):
            values = environment.step((network(matrices, values)[:, 0] > 0).astype(np.int64))[0]

    return Ready(call, carts * CALL_TICKS)


def vmas_world(worlds: int) -> Any:
    """The bold world as a scenario of VMAS."""
    import torch
    from vmas.simulator.core import Agent, Box, Landmark, Sphere, World
    from vmas.simulator.scenario import BaseScenario
    from vmas.simulator.sensors import Lidar

    at = rocks()

    class Rocks(BaseScenario):  # type: ignore[misc]
        def make_world(self, batch_dim: int, device: Any, **_: Any) -> Any:
            world = World(batch_dim, device, dt=TICK_SECONDS, drag=0.08, x_semidim=50, y_semidim=50, substeps=1)
            rays = Lidar(world, angle_start=0.0, angle_end=1.8 * math.pi, n_rays=10, max_range=RANGE_UNITS,
                         entity_filter=lambda entity: entity.name.startswith("rock"))  # fmt: skip
            shape = Sphere(1.0)
            world.add_agent(
                Agent("robot", shape=shape, mass=ROBOT_MASS, u_multiplier=WHEEL_THRUST, rotatable=True, sensors=[rays])
            )
            for number, (_, _, half) in enumerate(at.tolist()):
                shape = Box(2 * half, 2 * half)
                world.add_landmark(Landmark(f"rock{number}", shape=shape, collide=True, movable=False))
            return world

        def reset_world_at(self, env_index: int | None = None) -> None:
            for mark, (x, y, _) in zip(self.world.landmarks, at.tolist(), strict=True):
                mark.set_pos(torch.tensor([x, y]), batch_index=env_index)
            places = torch.tensor(starts(worlds)[:, :2], dtype=torch.float32)
            self.world.agents[0].set_pos(places if env_index is None else places[env_index], batch_index=env_index)

        def observation(self, agent: Any) -> Any:
            return torch.cat([agent.sensors[0].measure() / RANGE_UNITS, agent.state.pos / 50, agent.state.vel / 10], -1)

        def reward(self, agent: Any) -> Any:
            return agent.state.vel.norm(dim=-1)

    return Rocks()


def vmas() -> Ready:
    """8,192 worlds of VMAS on torch; pushed by a force along x and y, not by wheels."""
    import torch
    from vmas import make_env

    torch.set_num_threads(1)
    worlds = 8192

    environment = make_env(vmas_world(worlds), num_envs=worlds, device="cpu", continuous_actions=True)
    matrices, values = [torch.tensor(matrix) for matrix in layers()], environment.reset()[0]

    def call() -> None:
        nonlocal values
        with torch.no_grad():
            for _ in range(4):
                values = environment.step([network(matrices, values, torch.tanh)])[0][0]

    return Ready(call, 4 * worlds)


def jax_tick() -> Any:
    """A tick of the bold world in jax."""
    import jax.numpy as jnp  # type: ignore[import-not-found]

    matrices, at, angles = [jnp.asarray(m) for m in layers()], jnp.asarray(rocks()), jnp.asarray(ANGLES)
    halves = at[:, 2:]

    def look(place: Any, angle: Any) -> Any:
        way = jnp.stack([jnp.cos(angle + angles), jnp.sin(angle + angles)], -1)
        inverse = 1 / jnp.where(jnp.abs(way) < 1e-9, 1e-9, way)
        low, high = (((at[:, :2] + side * halves - place)[:, None] * inverse) for side in (-1, 1))
        near, far = jnp.minimum(low, high).max(-1), jnp.maximum(low, high).min(-1)
        box = jnp.where((near <= far) & (near > 0), near, RANGE_UNITS).min(0)
        wall = jnp.where(way > 0, (HALF_SIDE_UNITS - place) / way, (-HALF_SIDE_UNITS - place) / way).min(-1)
        return jnp.clip(jnp.minimum(box, wall), 0, RANGE_UNITS) / RANGE_UNITS

    def tick(state: Any) -> Any:
        place, speed, angle, spin = state
        ahead = jnp.array([jnp.cos(angle), jnp.sin(angle)])
        values = jnp.concatenate([look(place, angle), place / 50, ahead])
        left, right = WHEEL_THRUST * (0.5 + network(matrices, values, jnp.tanh) / 2)
        speed = (speed + TICK_SECONDS * (left + right) / ROBOT_MASS * ahead) * LINEAR_SHARE
        spin = (spin + TICK_SECONDS * (right - left) / ROBOT_INERTIA) * ANGULAR_SHARE
        place, angle = place + TICK_SECONDS * speed, angle + TICK_SECONDS * spin
        gap = place - at[:, :2]
        gap = gap - jnp.clip(gap, -halves, halves)
        far = jnp.sqrt((gap**2).sum(-1, keepdims=True) + 1e-9)
        out = jnp.where(far < 1, gap / far * (1 - far), 0.0).sum(0)
        size = jnp.sqrt((out**2).sum() + 1e-12)
        into = jnp.where(size > 1e-5, jnp.minimum(speed @ out / size, 0.0), 0.0)
        return jnp.clip(place + out, -49, 49), speed - into * out / size, angle, spin

    return tick


def own_jax() -> Ready:
    """1,024 worlds written out by hand, what one does where no engine fits; no friction, layouts or rewards."""
    import jax
    import jax.numpy as jnp

    worlds, tick = 1024, jax_tick()
    run = jax.jit(lambda all_: jax.lax.scan(lambda now, _: (jax.vmap(tick)(now), None), all_, None, CALL_TICKS)[0])
    begin = jnp.asarray(starts(worlds), jnp.float32)
    state = begin[:, :2], jnp.zeros((worlds, 2)), begin[:, 2], jnp.zeros(worlds)

    def call() -> None:
        nonlocal state
        state = jax.block_until_ready(run(state))

    return Ready(call, worlds * CALL_TICKS)


class Peer(NamedTuple):
    """A system: how it is set up, and the packages that it needs, by the name of the module."""

    ready: Callable[[], Ready]
    packages: Mapping[str, str] = {}


PEERS: Mapping[str, Peer] = {
    "mind, Collect": Peer(lambda: mind("Collect")),
    "mind, Avoid": Peer(lambda: mind("Avoid")),
    "gymnasium CartPole": Peer(cartpole, {"gymnasium": "gymnasium"}),
    "own jax": Peer(own_jax, {"jax": "jax"}),
    "vmas": Peer(vmas, {"vmas": "vmas"}),
    "box2d": Peer(box2d, {"Box2D": "box2d"}),
    "pymunk": Peer(plain_pymunk),
}


def rate(peer: Peer, seconds: float) -> float:
    """Agent-steps per second of CPU time, after a first call that counts for nothing."""
    call, steps = peer.ready()
    call()
    calls, begun = 0, time.process_time()
    while (spent := time.process_time() - begun) < seconds or calls < 2:
        call()
        calls += 1
    return calls * steps / spent


def python_of(name: str, environments: Path | None) -> str | None:
    """The Python that has a peer's packages, or None."""
    packages = PEERS[name].packages
    if environments and packages:
        python = environments.resolve() / name.replace(" ", "-") / "bin" / "python"
        return str(python) if python.exists() else None
    return sys.executable if all(map(importlib.util.find_spec, packages)) else None


def install(names: list[str], environments: Path) -> None:
    """Make an environment for each of some peers that need packages."""
    for name in names:
        if packages := [*PEERS[name].packages.values()]:
            folder = environments / name.replace(" ", "-")
            subprocess.run([sys.executable, "-m", "venv", folder], check=True)
            subprocess.run([folder / "bin" / "pip", "install", "-q", "numpy", *packages], check=True)


def in_turns(names: list[str], rounds: int, seconds: float, environments: Path | None) -> Mapping[str, list[float]]:
    """The rates of each peer that is there, a process for each in each of so many turns."""
    pythons = {name: python for name in names if (python := python_of(name, environments))}
    for name in [name for name in names if name not in pythons]:
        wanted = " ".join(PEERS[name].packages.values())
        print(f"{name} is left out: pip install {wanted}, or --install a folder", file=sys.stderr)
    found: dict[str, list[float]] = {name: [] for name in pythons}
    for _ in range(rounds):
        for name, python in pythons.items():
            words = [python, __file__, "--one", name, "--seconds", str(seconds)]
            said = subprocess.run(words, check=True, capture_output=True, text=True, cwd=ROOT).stdout
            found[name].append(float(json.loads(said.splitlines()[-1])))
    return found


def main() -> None:
    """Measure in turns, and print the medians and how many times as fast Collect is, within each turn."""
    parser = argparse.ArgumentParser(
        description=__doc__, allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("peers", nargs="*", metavar="PEER")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=2.0)
    parser.add_argument("--environments", type=Path)
    parser.add_argument("--install", type=Path, metavar="FOLDER")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--one", help=argparse.SUPPRESS)
    given = parser.parse_args()
    names = given.peers or [*PEERS]
    if given.one:
        print(json.dumps(rate(PEERS[given.one], given.seconds)))
    elif given.list:
        print(
            "\n".join(f"{name:20} {(peer.ready.__doc__ or mind.__doc__ or '').strip()}" for name, peer in PEERS.items())
        )
    elif given.install:
        install(names, given.install)
    else:
        found = in_turns([*dict.fromkeys(["mind, Collect", *names])], given.rounds, given.seconds, given.environments)
        for name, rates in found.items():
            ratios = sorted(one / other for one, other in zip(found["mind, Collect"], rates, strict=True))
            least, most = ratios[0], ratios[-1]
            print(f"{name:20} {median(rates):12,.0f}   Collect: {median(ratios):.1f} times ({least:.1f} to {most:.1f})")


if __name__ == "__main__":
    main()
