"""Think: influence flows down the hierarchy (Eq. 2) and the skills that have some compute what they send (Eq. 1)."""

from mindrun.sim.lanes.arithmetic import ONE, ZERO, F, clamp, compiled, finite, sigmoid
from mindrun.sim.lanes.evaluate import evaluate
from mindrun.sim.procedures import call
from mindrun.sim.tables import MLP, PROCEDURE


@compiled
def begin(t, s, n):
    """No influence but the master's, which is 1."""
    s.influence[:, :n] = ZERO
    s.sums[:, :n] = ZERO
    s.influence[t.world[0].master, :n] = ONE


@compiled
def think(t, s, n, first, last):
    """Run the skills first..last of the table: each only in the lanes where it has influence."""
    for i in range(first, last):
        count = wake(t, s, n, i)
        if count > 0:
            skill, out = t.skills[i], 0
            if skill.kind == MLP:
                out = perceive(t, s, skill, count)
            elif skill.kind == PROCEDURE:
                call(skill.address, s.gathered, skill.inputs, s.hidden, skill.outputs, count)
            send(t, s, i, out, count)


@compiled
def wake(t, s, n, i):
    """Gather the inputs of skill i in the lanes where it has influence; how many those are."""
    skill = t.skills[i]
    count = awake(s.influence[skill.index], s.active, n, skill.own)
    if count > 0:
        gather(t.inputs[skill.input : skill.input + skill.inputs], s.readings, s.gathered, s.active, s.row[0], count)
    return count


@compiled
def awake(influence, active, n, own):
    """The lanes in which a skill has influence; all of them, if any, where every lane has weights of its own."""
    count = 0
    for p in range(n):
        active[count] = p
        count += 1 if influence[p] > ZERO else 0
    if own and count > 0:
        for p in range(n):
            active[p] = p
        return n
    return count


@compiled
def gather(rows, readings, gathered, active, sound, count):
    """The inputs of a skill side by side; `sound` becomes 0 where all of them are finite, else NaN."""
    sound[:count] = ZERO
    for j in range(len(rows)):
        source, target = readings[rows[j]], gathered[j]
        for k in range(count):
            target[k] = source[active[k]]
        for k in range(count):
            sound[k] += target[k] - target[k]


@compiled
def perceive(t, s, skill, n):
    """The perceptron's outputs; returns the row of `hidden` where they begin."""
    half = s.hidden.shape[0] // 2
    source, inputs, place = s.gathered, skill.inputs, skill.weights if not skill.own else 0
    base = half
    for _ in range(skill.hidden):
        base = half - base
        target = s.hidden[base : base + half]
        dense(t, s, skill.own, place, source, inputs, target, skill.width, n)
        for q in range(skill.width):
            squash(target[q], n)
        place += inputs * skill.width
        source, inputs = target, skill.width
    base = half - base
    dense(t, s, skill.own, place, source, inputs, s.hidden[base : base + half], skill.outputs, n)
    return base


@compiled
def squash(values, n):
    """The sigmoid of a row."""
    for p in range(n):
        values[p] = sigmoid(values[p])


@compiled
def dense(t, s, own, place, source, inputs, target, outputs, n):
    """target[q] = Σ weight · source[j], summed in the order of j; eight inputs a pass."""
    for q in range(outputs):
        out = target[q]
        out[:n] = ZERO
        j = 0
        if own:
            w = s.genome[place : place + inputs]
            while j + 4 <= inputs:
                add_4_own(out, w[j], source[j], w[j + 1], source[j + 1], w[j + 2], source[j + 2], w[j + 3],
                          source[j + 3], n)  # fmt: skip
                j += 4
            while j < inputs:
                add_own(out, w[j], source[j], n)
                j += 1
        else:
            v = t.weights[place : place + inputs]
            while j + 8 <= inputs:
                add_8(out, v[j : j + 8], source[j], source[j + 1], source[j + 2], source[j + 3], source[j + 4],
                      source[j + 5], source[j + 6], source[j + 7], n)  # fmt: skip
                j += 8
            while j + 4 <= inputs:
                add_4(out, v[j : j + 4], source[j], source[j + 1], source[j + 2], source[j + 3], n)
                j += 4
            while j < inputs:
                add_1(out, v[j], source[j], n)
                j += 1
        place += inputs


@compiled
def add_8(out, w, a, b, c, d, e, f, g, h, n):
    """out += w0·a + … + w7·h, from left to right."""
    w0, w1, w2, w3, w4, w5, w6, w7 = w[0], w[1], w[2], w[3], w[4], w[5], w[6], w[7]
    for p in range(n):
        out[p] = out[p] + w0 * a[p] + w1 * b[p] + w2 * c[p] + w3 * d[p] + w4 * e[p] + w5 * f[p] + w6 * g[p] + w7 * h[p]


@compiled
def add_4(out, w, a, b, c, d, n):
    """out += w0·a + … + w3·d, from left to right."""
    w0, w1, w2, w3 = w[0], w[1], w[2], w[3]
    for p in range(n):
        out[p] = out[p] + w0 * a[p] + w1 * b[p] + w2 * c[p] + w3 * d[p]


@compiled
def add_1(out, w, a, n):
    """out += w·a."""
    for p in range(n):
        out[p] = out[p] + w * a[p]


@compiled
def add_4_own(out, w, a, x, b, y, c, z, d, n):
    """out += w·a + x·b + y·c + z·d, from left to right, every lane with its own weights."""
    for p in range(n):
        out[p] = out[p] + w[p] * a[p] + x[p] * b[p] + y[p] * c[p] + z[p] * d[p]


@compiled
def add_own(out, w, a, n):
    """out += w·a, every lane with its own weight."""
    for p in range(n):
        out[p] = out[p] + w[p] * a[p]


@compiled
def send(t, s, i, out, n):
    """Every edge's value, times skill i's influence, to where it goes; a value that is not finite is not sent."""
    skill = t.skills[i]
    influence, sinks = s.influence[skill.index], s.sums.shape[0] // 2
    for e in range(skill.edge, skill.edge + skill.edges):
        edge = t.edges[e]
        if edge.output >= 0:
            values = s.hidden[out + edge.output]
        else:
            values = s.row[1]
            evaluate(t.codes[edge.code : edge.code + edge.length], s.readings, s.measures, 0, s.stack, s.active, n)
            for k in range(n):
                values[k] = F(s.stack[0, k])
        if edge.to_skill:
            pass_on(s.influence[edge.target], values, influence, s.row[0], s.active, s.faults, n)
        else:
            command(
                s.sums[edge.target], s.sums[sinks + edge.target], values, influence, s.row[0], s.active, s.faults, n
            )


@compiled
def pass_on(target, values, influence, sound, active, faults, n):
    """Influence to a subskill (Eq. 2)."""
    for k in range(n):
        p = active[k]
        if influence[p] > ZERO:
            if finite(values[k]) and sound[k] == ZERO:
                target[p] += clamp(values[k]) * influence[p]
            else:
                faults[p] += 1


@compiled
def command(total, weight, values, influence, sound, active, faults, n):
    """A command to an actuator or a memory, and the influence behind it (Eq. 3)."""
    for k in range(n):
        p = active[k]
        if influence[p] > ZERO:
            if finite(values[k]) and sound[k] == ZERO:
                total[p] += clamp(values[k]) * influence[p]
                weight[p] += influence[p]
            else:
                faults[p] += 1


@compiled
def mean(total, weight, neutral, p):
    """The influence-weighted mean of the commands (Eq. 3); `neutral` where there are none, or none that is finite."""
    if weight[p] > ZERO:
        value = total[p] / weight[p]
        if finite(value):
            return clamp(value)
    return neutral


__all__ = ["begin", "mean", "think"]
