"""Act: the commands that the influence makes (Eq. 3), their delays, the memory cells, and the claw."""

from mindrun.sim.lanes.arithmetic import HALF, ZERO, compiled
from mindrun.sim.lanes.sense import in_claw
from mindrun.sim.lanes.think import mean
from mindrun.sim.tables import GRIPPER, ITEM


@compiled
def act(t, s, n, clock):
    """Commands as they act in this tick, memory for the next one, and what the claw holds."""
    sinks = s.sums.shape[0] // 2
    for i in range(len(t.actuators)):
        actuator = t.actuators[i]
        for p in range(n):
            s.commands[i, p] = mean(s.sums[i], s.sums[sinks + i], actuator.neutral, p)
        if actuator.delay > 0:
            wait(s.commands[i], s.late[actuator.ring + clock % actuator.delay], n)
        if actuator.kind == GRIPPER:
            grip(s.commands[i], s.held, s.body, s.heading, s.things, t.things, t.world[0].radius, actuator.reach, n)
    for i in range(len(t.memories)):
        memory = t.memories[i]
        sink = len(t.actuators) + i
        remember(s.readings[memory.row], s.sums[sink], s.sums[sinks + sink], memory.decay, memory.rest, n)


@compiled
def wait(commands, late, n):
    """Exchange each command with the one that has waited its turn in the ring."""
    for p in range(n):
        commands[p], late[p] = late[p], commands[p]


@compiled
def remember(cell, total, weight, decay, rest, n):
    """decay·cell + (1 − decay)·command where a skill drives the cell, else decay·cell."""
    for p in range(n):
        value = decay * cell[p]
        if weight[p] > ZERO:
            value = value + rest * mean(total, weight, ZERO, p)
        cell[p] = value


@compiled
def grip(commands, held, body, heading, things, kinds, radius, reach, n):
    """Close above 0.5 on the first item in reach; open and the item stays where it is."""
    for p in range(n):
        if commands[p] <= HALF:
            held[p] = -1
        elif held[p] < 0:
            for i in range(len(kinds)):
                if kinds[i].kind == ITEM and held[p] < 0 and in_claw(body, heading, things, radius, reach, i, p):
                    held[p] = i


@compiled
def carry(held, body, heading, things, kinds, n):
    """A held item moves with the claw."""
    for p in range(n):
        if held[p] >= 0:
            i, ahead = held[p], kinds[held[p]].hold
            things[4 * i, p] = body[0, p] + heading[0, p] * ahead
            things[4 * i + 1, p] = body[1, p] + heading[1, p] * ahead
