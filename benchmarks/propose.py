"""Known answers of `mindc propose`: python -m benchmarks.propose [TASK …] [--seeds 5] [--decoys].

Each task of Collect, and GoToPower, without its skill, those above it and their lessons: what is proposed, how much of
what is needed it has, how many readings are needless, and its score beside that of the declared skill from scratch by
the same lesson. With --decoys ten sensors more, of things elsewhere, waves and noise.
"""

import argparse
import shutil
import tempfile
import time
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

from mindrun.sim.rollout import Rollout

from mindlang.compiler.compile import load
from mindlang.compiler.hierarchy import with_ancestors
from mindlang.compiler.source import Splice, spliced
from mindlang.compiler.syntax import Master, Teaches, of_form
from mindlang.editing.insertion import replace_span, without_declarations, without_line
from mindlang.propose.candidates import BIAS, Candidate, function_of
from mindlang.propose.search import WINNER_ATTEMPTS, Proposal, propose
from mindlang.propose.static import known_of
from mindlang.propose.trial import LESSON_GENERATIONS, Stage

COLLECT = Path(__file__).parents[1] / "examples/collect"
DECOYS = """\
sensor decoy_a is bearing of elsewhere
sensor decoy_b is derivative of decoy_a
sensor decoy_c is inside of elsewhere
sensor decoy_d is sine period 3 s
sensor decoy_e is sine period 5 s
sensor decoy_f is sine period 0.7 s
sensor decoy_g is bearing of faraway
sensor decoy_h is inertial noise 40%
sensor decoy_i is inertial noise 100%
sensor decoy_j is bearing of nowhere noise 50%

task Elsewhere in plain
  contains elsewhere is zone size 5
  contains faraway is zone size 5
  contains nowhere is item
  lasts 100 ticks
"""
NEEDED = {  # sets of names of which each has to be among what is read and influenced
    "GoToObject": [{"object_bearing"}],
    "GoToDropZone": [{"drop_zone_bearing"}],
    "Avoid": [{"proximity"}],
    "GoToObject+Avoid": [{"proximity"}, {"object_bearing"}, {"GoToObject"}, {"Avoid"}],
    "GoToDropZone+Avoid": [{"proximity"}, {"drop_zone_bearing"}, {"GoToDropZone"}, {"Avoid"}],
    "Collect": [{"holding", "object_in_reach"}, {"GoToObject+Avoid"}, {"GoToDropZone+Avoid"}, {"Grab"}],
    "GoToPower": [{"power_bearing"}],
}
OPTIONAL = {"Avoid": {"moving", "pulse"}}


def hidden(folder: Path, skill: str, decoys: bool, without: Sequence[str] = ()) -> Path:
    """A copy of the mind in a folder without a skill and others, those above them and their lessons."""
    shutil.copytree(COLLECT, folder, dirs_exist_ok=True)
    path = folder / ("power.mind" if skill == "GoToPower" else "collect.mind")
    mind, _ = load(path).whole
    gone = with_ancestors(mind.influences, [skill, *without])
    main, splices = mind.files[0], list[Splice]()
    for each in main.declarations:
        if each.header.noun.text == "skill" and each.header.name.text in gone:
            splices += without_declarations([each])
        facts = of_form(each.facts, Teaches)
        taught = [fact for fact in facts if fact.skill.text in gone]
        if taught and len(taught) == len(facts):
            splices += without_declarations([each])
        else:
            splices += map(without_line, taught)
    kept = next(each.name for each in mind.skills if each.name not in gone)
    splices += [replace_span(each.name.span, kept) for each in of_form(main.settings, Master)]
    path.write_text(spliced(main.source, splices) + DECOYS * decoys)
    return path


def proposal(path: Path, task: str, seed: int, workers: int) -> tuple[Stage, Proposal]:
    """What is proposed for the task of a hidden skill."""
    compiled = load(path)
    assert compiled.is_valid, compiled.diagnostics
    known = known_of(compiled, task)
    stage = Stage(compiled, path, known, task, "Proposed", seed, workers, Rollout.compile, _quiet)
    return stage, propose(stage)


def _quiet(what: str, total: int) -> AbstractContextManager[Callable[[float], None]]:
    return nullcontext(lambda more: None)


def answer(stage: Stage, candidate: Candidate) -> tuple[set[str], set[str]]:
    """All that a candidate reads, and whom it influences; where it is like another, what that does, exchanged."""
    if candidate.way not in ("like", "unchanged"):
        return {*candidate.reads} - {BIAS}, {*candidate.subskills}
    own = stage.known.skills[candidate.origin]
    lines = (*candidate.reads, *(line.removeprefix("influences ") for line in candidate.sends))
    swaps = {old: new for new, _, old in (line.partition(" for ") for line in lines)}
    return {swaps.get(name, name) for name in own.reads}, {swaps.get(name, name) for name in own.subskills}


def declared_score(task: str, path: Path, stage: Stage) -> float:
    """The score of the declared skill, taught by the same lesson with the same attempts."""
    whole = load(COLLECT / path.name)
    mind, graph = whole.whole
    skill = next(each for each in mind.skills if each.name == task)
    sends = tuple(edge.fact.span.text for edge in skill.edges)
    base = Candidate("scratch", skill.reads, sends, function=function_of(graph, task))
    trial = stage.begin(base)
    assert trial
    stage.teach(trial, LESSON_GENERATIONS, WINNER_ATTEMPTS)
    return trial.score


def measure(task: str, seed: int, said: argparse.Namespace) -> None:
    """Print what is proposed for a task whose skill is hidden, and how it stands beside the answer."""
    with tempfile.TemporaryDirectory() as folder:
        path = hidden(Path(folder), task, said.decoys, said.without)
        began, cpu = time.perf_counter(), time.process_time()
        stage, found = proposal(path, task, seed, said.workers)
        wall, cpu = time.perf_counter() - began, time.process_time() - cpu
        winner, declared = found.winner, declared_score(task, path, stage)
    reads, influences = answer(stage, winner.candidate)
    recall = sum(bool(each & (reads | influences)) for each in NEEDED[task]) / len(NEEDED[task])
    mind, _ = load(COLLECT / path.name).whole
    known = {*next(each.reads for each in mind.skills if each.name == task)}
    needless = reads - known - OPTIONAL.get(task, set())
    print(
        f"{task} seed {seed}: {winner.candidate.way} {winner.candidate.origin} {sorted(reads)} {sorted(influences)}: "
        f"recall {recall:.2f}, needless {sorted(needless)}, score {winner.score:.1f}, {winner.score / declared:.2f} of "
        f"declared, {wall:.0f} s, {cpu:.0f} s CPU, {found.ticks / 1e6:.0f} M ticks",
        flush=True,
    )
    if said.all:
        for name, worth in (("worth", found.worth), ("refused", found.refused)):
            print(f"  {name}: " + ", ".join(f"{what} {a:+.1f} ± {b:.1f}" for what, (a, b) in worth.items()))
        print("  probes: " + ", ".join(f"{name} {score:.1f}" for name, score in found.probes.items()))
        for each, generations, score in found.tried:
            print(f"    {generations:3} {score:9.1f}", each.way, each.origin, *each.reads, "→", *each.subskills)


def main() -> None:
    parser = argparse.ArgumentParser(allow_abbrev=False, description=__doc__)
    parser.add_argument("tasks", nargs="*", default=[*NEEDED])
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--decoys", action="store_true")
    parser.add_argument("--all", action="store_true", help="print all candidates")
    parser.add_argument("--without", action="append", default=[], help="hide this skill as well")
    said = parser.parse_args()
    for task in said.tasks:
        for seed in range(said.first, said.first + said.seeds):
            measure(task, seed, said)


if __name__ == "__main__":
    main()
