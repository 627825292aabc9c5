"""The life of an agent, lesson after lesson, written down as it goes: who is stopped goes on where it was."""

import json
import time
from collections.abc import Container, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from mindrun.files.atomic_write import write

from benchmarks.lifelong.agents import AGENTS, CANDIDATES, Agent, Known
from benchmarks.lifelong.report import Record
from benchmarks.lifelong.sequence import TaskSequence
from benchmarks.lifelong.sequences import sequence

FRESH_LAYOUTS_SEED = 20_211_121
SEEDS_APART = 100  # between the seeds of two lives, one for each lesson


def live(name: str, seed: int, of: tuple[str, int], lessons: int, ticks: float, layouts: int, folder: Path) -> str:
    """Go on with the life of an agent with a seed, lesson after lesson; one line on how long that took.

    The sequence `of` tasks is that of a name, drawn with a seed.
    """
    tasks, known, began = sequence(of), dict[str, Any](), time.perf_counter()
    agent: Agent = (AGENTS | CANDIDATES)[name](tasks)
    folder = folder / name.replace(",", "").replace(" ", "-") / f"seed-{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    for lesson in range(lessons):
        weights, written = folder / f"{lesson + 1}.npz", folder / f"{lesson + 1}.json"
        if written.exists():
            with np.load(weights) as found:
                known = dict(found)
            continue
        start = time.process_time()
        learnt = agent.learn(known, lesson, SEEDS_APART * seed + lesson, ticks)
        known = {**learnt.known}
        taught = time.process_time() - start
        record: Record = {
            "agent": name, "seed": seed, "lesson": lesson + 1, "task": tasks.tasks[lesson],
            **played(agent, known, tasks, lesson, layouts), "curve": learnt.curve, "ticks": learnt.ticks,
            "weights": agent.weights(known), "seconds": taught, "seconds_played": time.process_time() - start - taught,
        }  # fmt: skip
        np.savez(weights, **known)
        write(written, json.dumps(record).encode())
    return f"{name}, seed {seed}: {lessons} lessons in {time.perf_counter() - began:.0f} s"


def played(agent: Agent, known: Known, of: TaskSequence, lesson: int, layouts: int) -> dict[str, list[float | None]]:
    """The mean count and score of each task after a lesson, on layouts that are always the same.

    None where nobody could play it yet, or all tasks but the lesson's own are not looked at.
    """
    seeds = np.random.SeedSequence(FRESH_LAYOUTS_SEED).generate_state(layouts, np.uint64).tolist()
    counts, scores = list[float | None](), list[float | None]()
    for task in range(len(of.tasks)):
        player = agent.player(known, task) if task == lesson or of.is_looked_at(lesson) else None
        found = player[0].score(player[1], seeds) if player else None
        counts.append(float(found.counts.mean()) if found else None)
        scores.append(float(found.total.mean()) if found else None)
    return {"counts": counts, "scores": scores}


def read(folder: Path, names: Sequence[str], seeds: Container[int]) -> list[Record]:
    """The records of these agents and seeds, in the order of their names, seeds and lessons."""
    records = [json.loads(path.read_text(encoding="utf-8")) for path in folder.glob("*/seed-*/*.json")]
    chosen = (record for record in records if record["agent"] in names and record["seed"] in seeds)
    return sorted(chosen, key=lambda record: (names.index(record["agent"]), record["seed"], record["lesson"]))
