"""A cart with two poles (Wieland, 1991), as machine code: the same bits on every processor."""

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numpy as np
from mindrun.numbers import arithmetic
from mindrun.numbers.arrays import Doubles, Singles
from numba import njit

C = TypeVar("C", bound=Callable[..., Any])

GRAVITY_MS2 = 9.8
CART_KG, LONG_KG, SHORT_KG = 1.0, 0.1, 0.01
LONG_HALF_M, SHORT_HALF_M = 0.5, 0.05  # half the length of a pole
CART_FRICTION, HINGE_FRICTION = 0.0005, 0.000002
STEP_SECONDS, STEPS_PER_TICK = 0.01, 2
PUSH_N, TRACK_M, FALLEN_RADIANS = 10.0, 2.4, np.pi / 5  # most force; half the track; 36 degrees


def compiled(function: C) -> C:
    """The function as machine code."""
    return cast(C, njit(cache=True)(function))


sine_cosine = compiled(arithmetic.sine_cosine)  # the same bits on every processor


@compiled
def pole(angle: float, spin: float, kg: float, half: float, friction: float) -> tuple[float, float, float, float]:
    """A pole's push on the cart, its mass there (Wieland, 1991), the cosine of its angle, and what makes it fall."""
    sine, cosine = sine_cosine(angle)
    falls = friction * spin / (kg * half) - GRAVITY_MS2 * sine
    return kg * half * spin * spin * sine + 0.75 * kg * cosine * falls, kg * (1 - 0.75 * cosine * cosine), cosine, falls


@compiled
def change(state: Doubles, force: float, cart_friction: float, hinge_friction: float) -> Doubles:
    """How fast a state [6] changes under a force."""
    _, speed, long, long_spin, short, short_spin = state
    push, mass, cosine, falls = pole(long, long_spin, LONG_KG, LONG_HALF_M, hinge_friction)
    other_push, other_mass, other_cosine, other_falls = pole(short, short_spin, SHORT_KG, SHORT_HALF_M, hinge_friction)
    faster = (force - cart_friction * np.sign(speed) + push + other_push) / (CART_KG + mass + other_mass)
    spun = -0.75 / LONG_HALF_M * (faster * cosine + falls)
    other_spun = -0.75 / SHORT_HALF_M * (faster * other_cosine + other_falls)
    return np.array([speed, faster, long_spin, spun, short_spin, other_spun])


@compiled
def after(state: Doubles, force: float, cart_friction: float, hinge_friction: float, step: float) -> Doubles:
    """A state [6] after a step of so many seconds, by the classical method of Runge and Kutta."""
    a = change(state, force, cart_friction, hinge_friction)
    b = change(state + step / 2 * a, force, cart_friction, hinge_friction)
    c = change(state + step / 2 * b, force, cart_friction, hinge_friction)
    d = change(state + step * c, force, cart_friction, hinge_friction)
    return state + step / 6 * (a + 2 * b + 2 * c + d)


@compiled
def tick(states: Doubles, outputs: Singles) -> None:
    """Push each cart of states [carts, 6] as outputs [carts, 1] in 0..1 say, for 0.02 s."""
    for i in range(len(states)):
        command = min(max(outputs[i, 0], np.float32(0)), np.float32(1))
        for _ in range(STEPS_PER_TICK):
            force = PUSH_N * (2 * np.float64(command) - 1)
            states[i] = after(states[i], force, CART_FRICTION, HINGE_FRICTION, STEP_SECONDS)
