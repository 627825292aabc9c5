"""Think: influence flows down the hierarchy (Eq. 2) and the skills that have some compute what they send (Eq. 1)."""

from collections.abc import Callable, Sequence
from typing import Any

from mindrun.registry import kinds
from mindrun.sim.arithmetic import ONE, ZERO, F, clamp, compiled_lane, finite
from mindrun.sim.codes import function_codes
from mindrun.sim.compiling import compiled
from mindrun.sim.lanes.evaluate import evaluate
from mindrun.sim.procedures import call

NOT_SENT = F(-1)


def _chain(functions: Sequence[Any], code: int = 0) -> Callable[..., int]:
    """A function that calls the lane function of a skill's kind: one compilation, whatever the mind is."""
    own = compiled_lane(functions[0])
    if len(functions) == 1:
        return own
    other = _chain(functions[1:], code + 1)

    @compiled
    def compute(t, s, skill, n):
        if skill.kind == code:
            return own(t, s, skill, n)
        return other(t, s, skill, n)

    return compute


compute = _chain([kinds("skill")[name].lane for name in function_codes()])


@compiled
def begin(t, s, n):
    """No influence but the master's, which is 1."""
    s.influence[:, :n] = ZERO
    s.sums[:, :n] = ZERO
    s.influence[t.world[0].master, :n] = ONE


@compiled
def think(t, s, n, first, last):
    """Run the skills first..last of the table: each only in the lanes where it has influence.

    It ends where a procedure fails: `failed` then says which, and for whose inputs.
    """
    for i in range(first, last):
        count = wake(t, s, n, i)
        if count > 0:
            skill, out = t.skills[i], 0
            if skill.address == 0:
                out = compute(t, s, skill, count)
            else:
                s.failed[1] = call(skill.address, s.gathered, s.hidden, count)
                if s.failed[1] >= 0:
                    s.failed[0] = i
                    return
            send(t, s, i, out, count, n)


@compiled
def wake(t, s, n, i):
    """Gather the inputs of skill i in the lanes where it has influence; how many those are."""
    skill = t.skills[i]
    count = awake(s.influence[skill.index], s.active, n, skill.own)
    if count > 0:
        rows = t.inputs[skill.input : skill.input + skill.inputs]
        gather(rows, s.readings, s.gathered, s.active, s.sound, count, count == n)
    return count


@compiled
def awake(influence, active, n, own):
    """The lanes in which a skill has influence; all of them, if any, where every lane has weights of its own."""
    count = 0
    for p in range(n):
        active[count] = p
        count += 1 if influence[p] != ZERO else 0  # NaN too, which becomes a fault further down
    if own and count > 0:
        for p in range(n):
            active[p] = p
        return n
    return count


@compiled
def gather(rows, readings, gathered, active, sound, count, everywhere):
    """The inputs of a skill side by side; `sound` becomes 0 where all of them are finite, else NaN."""
    sound[:count] = ZERO
    for j in range(len(rows)):
        source, target = readings[rows[j]], gathered[j]
        if everywhere:
            for k in range(count):
                target[k] = source[k]
                sound[k] += source[k] - source[k]
        else:
            for k in range(count):
                target[k] = source[active[k]]
            for k in range(count):
                sound[k] += target[k] - target[k]


@compiled
def send(t, s, i, out, n, lanes):
    """Every edge's value, times skill i's influence, to where it goes; a value that is not finite is not sent."""
    skill = t.skills[i]
    influence, sinks = s.influence[skill.index], s.sums.shape[0] // 2
    for e in range(skill.edge, skill.edge + skill.edges):
        edge = t.edges[e]
        if edge.output >= 0:
            values = s.hidden[out + edge.output]
        else:
            values = s.values
            codes = t.codes[edge.code : edge.code + edge.length]
            evaluate(codes, s.readings, s.measures, 0, s.stack, s.active, n, n == lanes)
            for k in range(n):
                values[k] = F(s.stack[0, k])
        check(values, s.sound, s.sent, s.active, s.faults, influence, n)
        if edge.to_skill:
            spread(s.sent, influence, s.influence[edge.target], s.active, n, n == lanes)
        else:
            spread(s.sent, influence, s.sums[edge.target], s.active, n, n == lanes)
            weigh(s.sent, influence, s.sums[sinks + edge.target], s.active, n, n == lanes)


@compiled
def check(values, sound, sent, active, faults, influence, n):
    """What is sent: the values clamped to 0..1; −1 where one is not finite, which is a fault, or not sound."""
    broken = 0
    for k in range(n):
        fine = finite(values[k]) & (sound[k] == ZERO)
        sent[k] = clamp(values[k]) if fine else NOT_SENT
        broken += 0 if fine else 1
    if broken > 0:
        for k in range(n):
            faults[active[k]] += 1 if sent[k] < ZERO and influence[active[k]] != ZERO else 0


@compiled
def spread(sent, influence, target, active, n, everywhere):
    """Add value times influence (Eq. 2) where a value is sent."""
    if everywhere:
        for p in range(n):
            target[p] += sent[p] * influence[p] if sent[p] >= ZERO else ZERO
    else:
        for k in range(n):
            p = active[k]
            target[p] += sent[k] * influence[p] if sent[k] >= ZERO else ZERO


@compiled
def weigh(sent, influence, target, active, n, everywhere):
    """Add the influence behind each command that is sent (Eq. 3)."""
    if everywhere:
        for p in range(n):
            target[p] += influence[p] if sent[p] >= ZERO else ZERO
    else:
        for k in range(n):
            p = active[k]
            target[p] += influence[p] if sent[k] >= ZERO else ZERO
