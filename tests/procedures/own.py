"""Procedures of drawn hierarchies: of any readings, as many values as the name says, and each remembers."""

SEEN = []


def _sent(count, readings):
    SEEN.append(sum(readings) / (1 + len(readings)))
    return tuple(0.3 + SEEN[-1] - 0.5 * SEEN[len(SEEN) // 2] + 0.125 * place for place in range(count))


def send0(*readings):
    return _sent(0, readings)


def send1(*readings):
    return _sent(1, readings)[0]


def send2(*readings):
    return _sent(2, readings)


def send3(*readings):
    return _sent(3, readings)


def send4(*readings):
    return _sent(4, readings)


def send5(*readings):
    return list(_sent(5, readings))
