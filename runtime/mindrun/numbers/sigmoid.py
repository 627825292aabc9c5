"""The sigmoid of the hidden layers, from + − × ÷ alone: the same bits on every processor, which `exp` does not give.

1/(1 + e^−x) = ½ + ½ tanh(x/2), with tanh as a quotient of two polynomials in float32, within 1e-6 of the true value.
"""

import numpy as np
from numpy.typing import NDArray


def _singles(*values: float) -> tuple[float, ...]:
    return tuple(float(np.float32(value)) for value in values)


# a1, a3, … a13 of the numerator x·(a1 + a3·x² + …), b0, b2, b4, b6 of the denominator; lowest power first.
NUMERATOR = _singles(
    4.89352455891786e-03,
    6.37261928875436e-04,
    1.48572235717979e-05,
    5.12229709037114e-08,
    -8.60467152213735e-11,
    2.00018790482477e-13,
    -2.76076847742355e-16,
)
DENOMINATOR = _singles(4.89352518554385e-03, 2.26843463243900e-03, 1.18534705686654e-04, 1.19825839466702e-06)
(LIMIT,) = _singles(7.90531110763549805)  # from here on tanh is 1 in float32

_HALF, _LOW, _HIGH = np.float32(0.5), np.float32(-LIMIT), np.float32(LIMIT)
_TOP, *_REST = (np.float32(a) for a in reversed(NUMERATOR))
_BOTTOM, *_BELOW = (np.float32(b) for b in reversed(DENOMINATOR))


def sigmoid(values: NDArray[np.float32]) -> NDArray[np.float32]:
    """The sigmoid of each value, float32 in and out; NaN gives what −∞ gives."""
    x: NDArray[np.float32] = np.fmin(np.fmax(values * _HALF, _LOW), _HIGH)
    y = x * x
    p: NDArray[np.float32] = y * _TOP
    q: NDArray[np.float32] = y * _BOTTOM
    for a in _REST[:-1]:
        p += a
        p *= y
    for b in _BELOW[:-1]:
        q += b
        q *= y
    p += _REST[-1]
    q += _BELOW[-1]
    p *= x
    p /= q
    p *= _HALF
    p += _HALF
    return p
