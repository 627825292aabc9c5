"""Sine and cosine in float64 from + − × ÷ alone: the same bits on every processor, in Python and compiled by numba."""

import math

# π/2 in three parts: k times either of the first two is exact for |k| < 2²⁰ (Cody and Waite; digits of fdlibm).
PART_1, PART_2, PART_3 = 1.57079632673412561417e00, 6.07710050630396597660e-11, 2.02226624879595063154e-21
S1, S2, S3 = -1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04
S4, S5, S6 = 2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10
C1, C2, C3 = 4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05
C4, C5, C6 = -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11


def wave(x: float, quarters: int) -> float:
    """sin(x + quarters·π/2) for |x| up to 1e5; without calls of its own, so that numba compiles it as it is."""
    k = math.floor(x * 0.6366197723675814 + 0.5)
    r = ((x - k * PART_1) - k * PART_2) - k * PART_3
    z = r * r
    sine = r + z * r * (S1 + z * (S2 + z * (S3 + z * (S4 + z * (S5 + z * S6)))))
    half = 0.5 * z
    rest = 1.0 - half
    tail = z * z * (C1 + z * (C2 + z * (C3 + z * (C4 + z * (C5 + z * C6)))))
    cosine = rest + (((1.0 - rest) - half) + tail)
    quadrant = (k + quarters) % 4
    value = sine if quadrant % 2 == 0 else cosine
    return value if quadrant < 2 else -value


def sine(x: float) -> float:
    """sin(x) for |x| up to 1e5, within 2e-16 of the true value."""
    return wave(x, 0)


def cosine(x: float) -> float:
    """cos(x) for |x| up to 1e5, within 2e-16 of the true value."""
    return wave(x, 1)
