"""The nearest points of a disc's middle and a box, as Chipmunk finds them: GJK, and EPA where the middle is inside.

Both look at the box as it is seen from the disc's middle, corner by corner, in Chipmunk's order of operations.
"""

import numpy as np

MOST_ROUNDS = 30  # of GJK and of EPA
LEAST_NORMAL = 2.2250738585072014e-308  # DBL_MIN, which keeps Chipmunk from dividing by 0


def nearest_points(x, y, radius, left, low, right, top):
    """The point of a disc's middle, that of the box, the normal from one to the other, and how far apart they are."""
    dx = ((x - radius) * 0.5 + (x + radius) * 0.5) - (left * 0.5 + right * 0.5)
    dy = ((y - radius) * 0.5 + (y + radius) * 0.5) - (low * 0.5 + top * 0.5)
    a, b = support(-dy, dx, left, low, right, top), support(dy, -dx, left, low, right, top)
    for _ in range(MOST_ROUNDS):
        ax, ay = seen(a, x, y, left, low, right, top)
        bx, by = seen(b, x, y, left, low, right, top)
        if is_left(bx, by, ax, ay, 0.0, 0.0):
            a, b, ax, ay, bx, by = b, a, bx, by, ax, ay
        t = nearest_share(ax, ay, bx, by)
        if t > -1.0 and t < 1.0:
            nx, ny = -(by - ay), bx - ax
        else:
            nx, ny = between(ax, ay, bx, by, t)
            nx, ny = -nx, -ny
        c = support(nx, ny, left, low, right, top)
        cx, cy = seen(c, x, y, left, low, right, top)
        if is_left(cx, cy, ax, ay, 0.0, 0.0) and is_left(bx, by, cx, cy, 0.0, 0.0):
            a, b = expand(a, c, b, x, y, left, low, right, top)
            break
        ahead_a, ahead_b = ax * nx + ay * ny, bx * nx + by * ny
        if cx * nx + cy * ny <= (ahead_a if ahead_a > ahead_b else ahead_b):
            break
        if distance(ax, ay, cx, cy) < distance(cx, cy, bx, by):
            b = c
        else:
            a = c
    return points_on(a, b, x, y, left, low, right, top)


def expand(a, b, c, x, y, left, low, right, top):
    """The edge of a box that is nearest to a point inside of it, begun with three of its corners (EPA).

    The corners of the hull so far are the digits of a number.
    """
    hull, count = a | b << 3 | c << 6, 3
    for round_ in range(1, MOST_ROUNDS + 1):
        first, least = 0, np.inf
        i = count - 1
        for j in range(count):
            ax, ay = seen(hull >> 3 * i & 7, x, y, left, low, right, top)
            bx, by = seen(hull >> 3 * j & 7, x, y, left, low, right, top)
            far = distance(ax, ay, bx, by)
            if far < least:
                least, first = far, i
            i = j
        a, b = hull >> 3 * first & 7, hull >> 3 * ((first + 1) % count) & 7
        ax, ay = seen(a, x, y, left, low, right, top)
        bx, by = seen(b, x, y, left, low, right, top)
        c = support(-(by - ay), bx - ax, left, low, right, top)
        cx, cy = seen(c, x, y, left, low, right, top)
        if c in (a, b) or not is_left(ax, ay, bx, by, cx, cy) or round_ == MOST_ROUNDS:
            break
        larger, size, last = c, 1, c
        for i in range(count):
            place = (first + 1 + i) % count
            corner = hull >> 3 * place & 7
            following = hull >> 3 * ((place + 1) % count) & 7 if i + 1 < count else c
            lx, ly = seen(last, x, y, left, low, right, top)
            hx, hy = seen(corner, x, y, left, low, right, top)
            fx, fy = seen(following, x, y, left, low, right, top)
            if is_left(lx, ly, fx, fy, hx, hy):
                larger |= corner << 3 * size
                size, last = size + 1, corner
        hull, count = larger, size
    return a, b


def points_on(a, b, x, y, left, low, right, top):
    """The nearest points on an edge of a box, as `nearest_points`."""
    ax, ay = seen(a, x, y, left, low, right, top)
    bx, by = seen(b, x, y, left, low, right, top)
    t = nearest_share(ax, ay, bx, by)
    px, py = between(ax, ay, bx, by, t)
    own_x, own_y = between(x, y, x, y, t)
    corner_x, corner_y = corner_of(a, left, low, right, top)
    other_x, other_y = corner_of(b, left, low, right, top)
    its_x, its_y = between(corner_x, corner_y, other_x, other_y, t)
    dx, dy = by - ay, -(bx - ax)
    scale = 1.0 / (np.sqrt(dx * dx + dy * dy) + LEAST_NORMAL)
    nx, ny = dx * scale, dy * scale
    apart = nx * px + ny * py
    if not (apart <= 0.0 or (t > -1.0 and t < 1.0)):  # of two corners
        apart = np.sqrt(px * px + py * py)
        scale = 1.0 / (apart + LEAST_NORMAL)
        nx, ny = px * scale, py * scale
    return own_x, own_y, its_x, its_y, nx, ny, apart


def support(nx, ny, left, low, right, top):
    """The number of the corner of a box that is farthest in a direction."""
    most, found = left * nx + low * ny, 0
    far = right * nx + low * ny
    most, found = (far, 1) if far > most else (most, found)
    far = right * nx + top * ny
    most, found = (far, 2) if far > most else (most, found)
    return 3 if left * nx + top * ny > most else found


def corner_of(i, left, low, right, top):
    """The x and y of corner i."""
    return right if i in (1, 2) else left, top if i >= 2 else low


def seen(i, x, y, left, low, right, top):
    """The x and y of corner i, from a point."""
    corner_x, corner_y = corner_of(i, left, low, right, top)
    return corner_x - x, corner_y - y


def is_left(ax, ay, bx, by, cx, cy):
    """True if c is to the left of the way from a to b."""
    return (by - ay) * (ax + bx - 2.0 * cx) > (bx - ax) * (ay + by - 2.0 * cy)


def nearest_share(ax, ay, bx, by):
    """The place of the point of a way that is nearest to the origin: −1 at a, 1 at b."""
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    if square == 0.0:
        return 0.0
    t = (dx * (ax + bx) + dy * (ay + by)) / square
    t = t if t > -1.0 else -1.0
    return -(t if t < 1.0 else 1.0)


def between(ax, ay, bx, by, t):
    """The point of a way at a place of −1 to 1."""
    half = 0.5 * t
    return ax * (0.5 - half) + bx * (0.5 + half), ay * (0.5 - half) + by * (0.5 + half)


def distance(ax, ay, bx, by):
    """The square of the distance of a way from the origin."""
    x, y = between(ax, ay, bx, by, nearest_share(ax, ay, bx, by))
    return x * x + y * y
