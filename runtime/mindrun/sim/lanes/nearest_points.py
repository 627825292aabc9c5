"""The nearest points of two shapes in Chipmunk's own order of operations: GJK, and EPA where they overlap.

A shape is a solid: a circle, of which only its middle counts here, or a quadrangle. A **vertex** is a corner of what is
seen of one shape from the other, 4·corner of the first + corner of the second.
"""

import numpy as np

MOST_ROUNDS = 30  # of GJK and of EPA
LEAST_NORMAL = 2.2250738585072014e-308  # DBL_MIN, which keeps Chipmunk from dividing by 0
VERTEX_BITS, VERTEX_MASK = 4, 15


def nearest_points(a, b):
    """The points of both shapes, the normal from one to the other, and how far apart they are."""
    dx = middle_of(a.left, a.right) - middle_of(b.left, b.right)
    dy = middle_of(a.low, a.high) - middle_of(b.low, b.high)
    v, w = support(a, b, -dy, dx), support(a, b, dy, -dx)
    for _ in range(MOST_ROUNDS):
        vx, vy = seen(a, b, v)
        wx, wy = seen(a, b, w)
        if is_left(wx, wy, vx, vy, 0.0, 0.0):
            v, w, vx, vy, wx, wy = w, v, wx, wy, vx, vy
        t = nearest_share(vx, vy, wx, wy)
        if t > -1.0 and t < 1.0:
            nx, ny = -(wy - vy), wx - vx
        else:
            nx, ny = between(vx, vy, wx, wy, t)
            nx, ny = -nx, -ny
        c = support(a, b, nx, ny)
        cx, cy = seen(a, b, c)
        if is_left(cx, cy, vx, vy, 0.0, 0.0) and is_left(wx, wy, cx, cy, 0.0, 0.0):
            v, w = expand(a, b, v, c, w)
            break
        ahead_v, ahead_w = vx * nx + vy * ny, wx * nx + wy * ny
        if cx * nx + cy * ny <= (ahead_v if ahead_v > ahead_w else ahead_w):
            break
        if distance(vx, vy, cx, cy) < distance(cx, cy, wx, wy):
            w = c
        else:
            v = c
    return points_on(a, b, v, w)


def middle_of(low, high):
    """The middle between two sides."""
    return low * 0.5 + high * 0.5


def expand(a, b, v, w, u):
    """The edge that is nearest to where both shapes overlap, begun with three vertices (EPA).

    The vertices of the hull so far are the digits of a number.
    """
    hull, count = v | w << VERTEX_BITS | u << 2 * VERTEX_BITS, 3
    for round_ in range(1, MOST_ROUNDS + 1):
        first, least = 0, np.inf
        i = count - 1
        for j in range(count):
            ax, ay = seen(a, b, digit(hull, i))
            bx, by = seen(a, b, digit(hull, j))
            far = distance(ax, ay, bx, by)
            if far < least:
                least, first = far, i
            i = j
        v, w = digit(hull, first), digit(hull, (first + 1) % count)
        ax, ay = seen(a, b, v)
        bx, by = seen(a, b, w)
        c = support(a, b, -(by - ay), bx - ax)
        cx, cy = seen(a, b, c)
        if c in (v, w) or not is_left(ax, ay, bx, by, cx, cy) or round_ == MOST_ROUNDS:
            break
        hull, count = larger_hull(a, b, hull, count, first, c)
    return v, w


def larger_hull(a, b, hull, count, first, c):
    """The hull with vertex c behind the edge `first`, without what is not at its rim any more, and how many it has."""
    larger, size, last = c, 1, c
    for i in range(count):
        place = (first + 1 + i) % count
        vertex = digit(hull, place)
        following = digit(hull, (place + 1) % count) if i + 1 < count else c
        lx, ly = seen(a, b, last)
        hx, hy = seen(a, b, vertex)
        fx, fy = seen(a, b, following)
        if is_left(lx, ly, fx, fy, hx, hy):
            larger |= vertex << VERTEX_BITS * size
            size, last = size + 1, vertex
    return larger, size


def digit(hull, i):
    """Vertex i of a hull."""
    return hull >> VERTEX_BITS * i & VERTEX_MASK


def points_on(a, b, v, w):
    """The nearest points on an edge, as `nearest_points`."""
    vx, vy = seen(a, b, v)
    wx, wy = seen(a, b, w)
    t = nearest_share(vx, vy, wx, wy)
    px, py = between(vx, vy, wx, wy, t)
    one, other = a.corners[v >> 2], a.corners[w >> 2]
    own_x, own_y = between(one.x, one.y, other.x, other.y, t)
    one, other = b.corners[v & 3], b.corners[w & 3]
    its_x, its_y = between(one.x, one.y, other.x, other.y, t)
    dx, dy = wy - vy, -(wx - vx)
    scale = 1.0 / (np.sqrt(dx * dx + dy * dy) + LEAST_NORMAL)
    nx, ny = dx * scale, dy * scale
    apart = nx * px + ny * py
    if not (apart <= 0.0 or (t > -1.0 and t < 1.0)):  # of two corners
        apart = np.sqrt(px * px + py * py)
        scale = 1.0 / (apart + LEAST_NORMAL)
        nx, ny = px * scale, py * scale
    return own_x, own_y, its_x, its_y, nx, ny, apart


def support(a, b, nx, ny):
    """The vertex that is farthest in a direction."""
    return 4 * farthest(a, -nx, -ny) + farthest(b, nx, ny)


def farthest(a, nx, ny):
    """The number of the corner of a shape that is farthest in a direction."""
    if a.is_round:
        return 0
    c = a.corners
    most, found = c[0].x * nx + c[0].y * ny, 0
    far = c[1].x * nx + c[1].y * ny
    most, found = (far, 1) if far > most else (most, found)
    far = c[2].x * nx + c[2].y * ny
    most, found = (far, 2) if far > most else (most, found)
    return 3 if c[3].x * nx + c[3].y * ny > most else found


def seen(a, b, vertex):
    """The x and y of a vertex."""
    own, its = a.corners[vertex >> 2], b.corners[vertex & 3]
    return its.x - own.x, its.y - own.y


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
