"""A recording computed again: the same bits on any machine, or the first tick that differs."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from mindrun.bundle import digest, read_bundle
from mindrun.engine import Engine
from mindrun.robot.recording import RecordingError, read


@dataclass(frozen=True, slots=True)
class Replayed:
    """How many ticks were computed again, and what differs first: its tick and a sentence."""

    ticks: int
    differs: tuple[int, str] | None


def replay_recording(
    recording: Path | str, bundle: Path | str, told: Callable[[int], None] = lambda ticks: None
) -> Replayed:
    """Compute a recorded drive again with the bundle that was running; `told` is told of the ticks so far.

    MindError where one of the two cannot be read, or the recording was made with another bundle. Runs the Python code
    of the bundle's procedures.
    """
    path, file = Path(recording), Path(bundle)
    mind = read_bundle(file)
    about, _ = read(path)
    return replay(path, digest(file), Engine(mind.policy, mind.procedures, about.master), told)


def replay(path: Path, bundle: str, engine: Engine, told: Callable[[int], None] = lambda ticks: None) -> Replayed:
    """Compute the ticks of a recording with the mind of a bundle of that SHA-256.

    RecordingError where it was made with another. A recording that says its first tick again was begun anew there.
    """
    about, parts = read(path)
    about.refuse_another(bundle, engine.graph)
    ticks = 0
    for rows in parts:
        for row in rows:
            if row["tick"] == 0:
                engine.reset()
            commands = engine.tick(row["readings"])
            if commands.tobytes() != row["commands"].tobytes():
                return Replayed(ticks, (int(row["tick"]), _different(about.actuators, commands, row["commands"])))
            if engine.influence.tobytes() != row["influence"].tobytes():
                return Replayed(ticks, (int(row["tick"]), _different(about.skills, engine.influence, row["influence"])))
            ticks += 1
        told(ticks)
    if not ticks:
        raise RecordingError(f"{path} has no tick in it")
    return Replayed(ticks, None)


def _different(names: tuple[str, ...], now: object, then: object) -> str:
    pairs = zip(names, now, then, strict=True)  # type: ignore[call-overload]
    name, a, b = next((name, a, b) for name, a, b in pairs if a.tobytes() != b.tobytes())
    return f"{name} is {a:.9g} and was {b:.9g}"
