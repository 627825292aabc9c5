"""The worst case of a small leak of influence, from the declaration alone: the open question of the paper's section 9.

One path is meant: each of its skills sends all that its line allows along the path, and should send 0 over its other
learnt lines, but sends δ there. Below a leak anything may happen: 1 over every learnt line, over `at` its maximum.
Influence multiplies on its way (Eq. 2), so with v the values along the path and W(m) the weighted number of ways from m
to the actuator, the unwanted influence there, as a multiple of the wanted one, is at most

    U = Σ over the path's skills n, over other learnt lines n → m, of δ·W(m) / Π of v from n down,

and U / (1 + U) of the command (Eq. 3) is not the driver's. A line that `cuts below` c does not leak at a skill whose
influence is at most I, if δ·I < c: what would arrive there is none. U is found from the master down: of a skill's
parents the worst counts, because more leaks above a skill are never better. So all paths are compared, and none is
listed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from mindlang.proofs.paths import Way, Ways

Row = NDArray[np.float64]  # one value per actuator


@dataclass(frozen=True, slots=True)
class Level:
    """A skill on the worst path: the `share` of the command that its own leaks can take, and into which skills."""

    skill: str
    share: float
    into: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Leak:
    """The worst path of an actuator, from the master to the driver, and the share of the command that leaks take."""

    share: float
    levels: tuple[Level, ...]

    @property
    def worst(self) -> Level | None:
        """The level that leaks most."""
        most = max(self.levels, key=lambda level: level.share)
        return most if most.share > 0 else None


def leaks(found: Ways, actuators: int, delta: float) -> list[Leak | None]:
    """For each actuator the worst case of a leak of `delta`; None where no path leads to it."""
    with np.errstate(all="ignore"):  # where the ways are too many for a number, they are infinitely many
        found = _without_cut(found, delta)
        reach = _weighted(found, actuators)
        learnt = {skill: _learnt(found, reach, skill, None) for skill in found.skills}
        worst, above = _worst(found, reach, learnt, actuators, delta)
        return [_leak(found, reach, learnt, worst, above, actuator, delta) for actuator in range(actuators)]


def _without_cut(found: Ways, delta: float) -> Ways:
    """The ways without the leaks that lines cut: where δ times the greatest influence of the skill is too small."""
    most = dict.fromkeys(found.skills, 0.0)
    most[found.skills[0]] = 1.0
    onward = list(found.onward)
    for skill in found.skills:
        for way in found.onward[skill]:
            most[way.target] += most[skill] * way.most
        onward[skill] = tuple(
            replace(way, is_learnt=way.is_learnt and not delta * most[skill] < way.cuts) for way in found.onward[skill]
        )
    return replace(found, onward=tuple(onward))


def _weighted(found: Ways, actuators: int) -> dict[int, Row]:
    """W: by skill, how much influence an influence of 1 can become at each actuator."""
    reach: dict[int, Row] = {}
    for skill in reversed(found.skills):
        own = np.array([float(actuator in found.drives[skill]) for actuator in range(actuators)])
        for way in found.onward[skill]:
            own += way.most * reach[way.target]
        reach[skill] = own
    return reach


def _others(found: Ways, reach: dict[int, Row], learnt: dict[int, Row], skill: int, kept: Way | None) -> Row:
    """Σ W over the learnt lines of a skill other than the one that is meant; `learnt` has the sums over all of them."""
    if kept is None or not kept.is_learnt:
        return learnt[skill]
    if np.isfinite(learnt[skill]).all():
        return np.maximum(learnt[skill] - reach[kept.target], 0.0)
    return _learnt(found, reach, skill, kept)


def _learnt(found: Ways, reach: dict[int, Row], skill: int, kept: Way | None) -> Row:
    total = np.zeros_like(reach[skill])
    for way in found.onward[skill]:
        if way.is_learnt and way is not kept:
            total += reach[way.target]
    return total


def _worst(
    found: Ways, reach: dict[int, Row], learnt: dict[int, Row], actuators: int, delta: float
) -> tuple[dict[int, Row], dict[int, list[tuple[int, Way] | None]]]:
    """By skill: the greatest U of a path to it, by actuator, −1 where there is none, and the last step of that path."""
    master = found.skills[0]
    worst = {skill: np.full(actuators, -1.0) for skill in found.skills}
    above: dict[int, list[tuple[int, Way] | None]] = {skill: [None] * actuators for skill in found.skills}
    worst[master] = np.zeros(actuators)
    for skill in found.skills:
        for way in found.onward[skill] if worst[skill].min(initial=0) >= 0 else ():
            leaked = (worst[skill] + delta * _others(found, reach, learnt, skill, way)) / way.most
            for actuator in np.flatnonzero(leaked > worst[way.target]).tolist():
                worst[way.target][actuator] = leaked[actuator]
                above[way.target][actuator] = skill, way
    return worst, above


def _leak(
    found: Ways,
    reach: dict[int, Row],
    learnt: dict[int, Row],
    worst: dict[int, Row],
    above: dict[int, list[tuple[int, Way] | None]],
    actuator: int,
    delta: float,
) -> Leak | None:
    """The worst path of one actuator, followed back from the worst driver."""
    drivers = [skill for skill in found.skills if actuator in found.drives[skill] and worst[skill][actuator] >= 0]
    if not drivers:
        return None
    ends = [
        worst[driver][actuator] + delta * _others(found, reach, learnt, driver, None)[actuator] for driver in drivers
    ]
    unwanted = max(ends)
    skill, way = drivers[ends.index(unwanted)], None
    levels: list[Level] = []
    passed = 1.0
    while True:
        passed *= way.most if way else 1.0
        own = delta * _others(found, reach, learnt, skill, way)[actuator] / passed
        into = (w.target for w in found.onward[skill] if w.is_learnt and w is not way and reach[w.target][actuator] > 0)
        levels.append(Level(found.names[skill], _share(own, unwanted), tuple(found.names[m] for m in into)))
        step = above[skill][actuator]
        if step is None:
            return Leak(_share(unwanted, unwanted), tuple(reversed(levels)))
        skill, way = step


def _share(own: float, unwanted: float) -> float:
    """The share own / (1 + unwanted)."""
    return float(own / (1 + unwanted)) if np.isfinite(unwanted) else float(not np.isfinite(own))
