"""What `mindc prove` does: a mind with its weights, what is proved of it, a run where one is asked for; printed."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from mindrun.errors import MindError

from mindlang.cli._terminal import (
    FINDINGS,
    MISUSE,
    fail,
    load_compiled,
    print_json,
    print_table,
    procedures_talk,
)
from mindlang.compiler.compile import Compiled
from mindlang.compiler.diagnostic import did_you_mean
from mindlang.lock import lock_sources, read_locks
from mindlang.lock.ready import make_ready
from mindlang.proofs.proof import prove
from mindlang.proofs.report import as_data, report

if TYPE_CHECKING:
    from mindlang.proofs.recorded import Recorded


@dataclass(frozen=True, slots=True)
class ProofOptions:
    """What the command line says."""

    leak: float
    master: str | None
    run: bool
    task: str | None
    seed: int
    as_json: bool


def perform(file: str, options: ProofOptions) -> None:
    """Prove and print."""
    compiled = _under(load_compiled(file), options.master)
    assert compiled.graph
    ready = make_ready(compiled.graph, compiled.sources)
    lock = read_locks(lock_sources(compiled.sources))
    hashes = {skill: lock[skill].weights for skill in ready.policy.weights if skill in lock}
    run = _run(file, compiled, options) if options.run else None
    proof = prove(ready.policy.graph, ready.policy.weights, options.leak)
    data = as_data(proof, hashes, run)
    if options.as_json:
        print_json(data)
    else:
        print_table(report(data))


def _under(compiled: Compiled, master: str | None) -> Compiled:
    """The mind with another skill in charge."""
    assert compiled.graph
    if master is None:
        return compiled
    names = [skill.name for skill in compiled.graph.skills]
    if master not in names:
        fail(f"there is no skill called {master}", did_you_mean(master, names), MISUSE)
    return replace(compiled, graph=replace(compiled.graph, master=master))


def _run(file: str, compiled: Compiled, options: ProofOptions) -> Recorded:
    from mindlang.cli._simulator_compilation import prepare
    from mindlang.proofs.recorded import record
    from mindlang.run.setup import SetupError, set_up

    assert compiled.graph
    try:
        setup = set_up(file, compiled, options.task, compiled.graph.master)
        with procedures_talk():
            return record(setup, options.seed, prepare)
    except SetupError as error:
        fail(f"--run: {error}", error.hint, MISUSE if error.misuse else FINDINGS)
    except MindError as error:
        fail(f"--run: {error}", error.hint, MISUSE)
