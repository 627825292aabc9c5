"""Act: the commands that the influence makes (Eq. 3), their delays, and the claw; the memory cells when all is done."""

from mindrun.arithmetic import COSINE, SINE, THING_ROWS, X, Y
from mindrun.sim.arithmetic import HALF, ONE, ZERO, F, clamp, finite, in_claw
from mindrun.sim.codes import GRIPPER, ITEM
from mindrun.sim.compiling import compiled

UNDRIVEN = F(-1)


@compiled
def act(t, s, n, clock):
    """Commands as they act in this tick, and what the claw holds."""
    sinks = s.sums.shape[0] // 2
    for i in range(len(t.actuators)):
        actuator = t.actuators[i]
        means(s.sums[i], s.sums[sinks + i], actuator.neutral, s.commands[i], s.faults, n)
        if actuator.delay > 0:
            wait(s.commands[i], s.late[actuator.ring + clock % actuator.delay], n)
        if actuator.kind == GRIPPER:
            grip(s.commands[i], s.held, s.body, s.heading, s.things, t.things, t.world[0].radius, actuator.reach, n)


@compiled
def recall(t, s, n):
    """The memory cells as they are read in the next tick: a reward of this one has them as its skills had."""
    sinks = s.sums.shape[0] // 2
    for i in range(len(t.memories)):
        memory = t.memories[i]
        sink = len(t.actuators) + i
        means(s.sums[sink], s.sums[sinks + sink], UNDRIVEN, s.sent, s.faults, n)
        remember(s.readings[memory.row], s.sent, memory.decay, memory.rest, n)


@compiled
def means(total, weight, neutral, out, faults, n):
    """The influence-weighted mean of the commands (Eq. 3); `neutral` where there are none.

    A mean that is no finite number, because sums overflowed, is a fault and gives `neutral` too.
    """
    for p in range(n):
        driven = weight[p] != ZERO  # NaN too, where influence overflowed
        value = total[p] / (weight[p] if driven else ONE)
        sound = finite(value)
        out[p] = clamp(value) if driven & sound else neutral
        faults[p] += 1 if driven & (not sound) else 0


@compiled
def wait(commands, late, n):
    """Exchange each command with the one that has waited its turn in the ring."""
    for p in range(n):
        commands[p], late[p] = late[p], commands[p]


@compiled
def remember(cell, command, decay, rest, n):
    """decay·cell + (1 − decay)·command where a skill drives the cell, else decay·cell."""
    for p in range(n):
        kept = decay * cell[p]
        cell[p] = kept + rest * command[p] if command[p] >= ZERO else kept


@compiled
def grip(commands, held, body, heading, things, kinds, radius, reach, n):
    """Close above 0.5 on the first item in reach; open and the item stays where it is."""
    for p in range(n):
        held[p] = -1 if commands[p] <= HALF else held[p]
    for p in range(n):
        if commands[p] > HALF and held[p] < 0:
            for i in range(len(kinds)):
                if kinds[i].kind == ITEM and held[p] < 0 and in_claw(body, heading, things, radius, reach, i, p):
                    held[p] = i


@compiled
def carry(held, body, heading, things, kinds, n):
    """A held item moves with the claw."""
    for p in range(n):
        if held[p] >= 0:
            i, ahead = held[p], kinds[held[p]].hold
            things[THING_ROWS * i + X, p] = body[X, p] + heading[COSINE, p] * ahead
            things[THING_ROWS * i + Y, p] = body[Y, p] + heading[SINE, p] * ahead
