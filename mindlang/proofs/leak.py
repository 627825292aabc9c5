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
        search = _Leaks(_without_cut(found, delta), actuators, delta)
        return [search.worst_path(actuator) for actuator in range(actuators)]


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


class _Leaks:
    """Rows by skill: W, Σ W over its learnt lines, and the greatest U of a path to it, with that path's last steps."""

    def __init__(self, found: Ways, actuators: int, delta: float) -> None:
        self._found, self._delta = found, delta
        self._reach: dict[int, Row] = {}
        for skill in reversed(found.skills):
            own = np.array([float(actuator in found.drives[skill]) for actuator in range(actuators)])
            self._reach[skill] = sum((way.most * self._reach[way.target] for way in found.onward[skill]), own)
        self._learnt = {skill: self._sum_of_learnt(skill, None) for skill in found.skills}
        self._worst = {skill: np.full(actuators, -1.0) for skill in found.skills}  # where no path leads
        self._worst[found.skills[0]] = np.zeros(actuators)
        self._above: dict[int, dict[int, tuple[int, Way]]] = {skill: {} for skill in found.skills}
        for skill in found.skills:
            for way in found.onward[skill] if self._worst[skill].min(initial=0) >= 0 else ():
                leaked = (self._worst[skill] + delta * self._others(skill, way)) / way.most
                for actuator in np.flatnonzero(leaked > self._worst[way.target]).tolist():
                    self._worst[way.target][actuator] = leaked[actuator]
                    self._above[way.target][actuator] = skill, way

    def _sum_of_learnt(self, skill: int, kept: Way | None) -> Row:
        ways = (way for way in self._found.onward[skill] if way.is_learnt and way is not kept)
        return sum((self._reach[way.target] for way in ways), np.zeros_like(self._reach[skill]))

    def _others(self, skill: int, kept: Way | None) -> Row:
        """Σ W over the learnt lines of a skill other than the one that is meant."""
        if kept is None or not kept.is_learnt:
            return self._learnt[skill]
        if np.isfinite(self._learnt[skill]).all():
            return np.maximum(self._learnt[skill] - self._reach[kept.target], 0.0)
        return self._sum_of_learnt(skill, kept)

    def worst_path(self, actuator: int) -> Leak | None:
        """The worst path of one actuator, followed back from the worst driver."""
        found = self._found
        unwanted = {
            driver: float(self._worst[driver][actuator] + self._delta * self._others(driver, None)[actuator])
            for driver in found.skills
            if actuator in found.drives[driver] and self._worst[driver][actuator] >= 0
        }
        if not unwanted:
            return None
        skill, way = max(unwanted, key=unwanted.__getitem__), None
        most, passed = unwanted[skill], 1.0
        levels: list[Level] = []
        while True:
            passed *= way.most if way else 1.0
            own = self._delta * self._others(skill, way)[actuator] / passed
            leaking = (each.target for each in found.onward[skill] if each.is_learnt and each is not way)
            into = tuple(found.names[target] for target in leaking if self._reach[target][actuator] > 0)
            levels.append(Level(found.names[skill], _share(own, most), into))
            if actuator not in self._above[skill]:
                return Leak(_share(most, most), tuple(reversed(levels)))
            skill, way = self._above[skill][actuator]


def _share(own: float, unwanted: float) -> float:
    """The share own / (1 + unwanted)."""
    return float(own / (1 + unwanted)) if np.isfinite(unwanted) else float(not np.isfinite(own))
