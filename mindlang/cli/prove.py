"""`mindc prove`: what can be said about a mind without running it.

Examples:
  mindc prove collect.mind
  mindc prove collect.mind --leak 0.05
  mindc prove collect.mind --master GoToObject+Avoid
  mindc prove collect.mind --run --seed 3
  mindc prove collect.mind --json
"""

from dataclasses import replace

import click

from mindlang.cli._options import LAYOUT, SKILLS, TASKS, NumberOption, flag, json_flag, named
from mindlang.cli._terminal import MISUSE, is_asked, load_compiled, print_json, print_table, procedures_talk, refusing


@click.command
@click.argument("file")
@click.option(
    "--leak",
    type=NumberOption(0, 1, min_open=True),
    default=0.01,
    metavar="δ",
    help="What a learnt line sends where it should send 0. Default: 0.01.",
)
@named("--master", "SKILL", SKILLS, "Who is in charge. Default: the mind's master.")
@flag("--run with_run", "Run a task, too, and count ticks without influence.")
@named("--task", "TASK", TASKS, "Of the run. Default: the one that `mindc run` takes.")
@click.option("--seed", type=LAYOUT, default=1, help="Of the run. Default: 1.")
@json_flag()
def command(file: str, leak: float, master: str | None, with_run: bool, task: str | None, seed: int) -> None:
    """Prove what FILE can and cannot do, for any readings.

    From the declaration alone: the paths of influence to each actuator, and how much of a command small leaks of
    influence along them can take. With weights: what each actuator can be sent, whether it can be without influence
    (its neutral is sent then), which skills and lines are dead. Every claim says what it rests on.

    Runs no Python code of the file's procedures, except with --run.
    """
    if task is not None and not with_run:
        raise click.UsageError("--task is of the run: say --run, too.")
    from mindlang.lock import lock_sources, read_locks
    from mindlang.lock.status import make_ready
    from mindlang.proofs.proof import prove
    from mindlang.proofs.report import proof_data, proof_report
    from mindlang.run.chosen_task import skill_of

    compiled = load_compiled(file)
    _, graph = compiled.whole
    with refusing(MISUSE):
        graph = replace(graph, master=skill_of(graph, master or graph.master))
    compiled = replace(compiled, graph=graph)
    ready = make_ready(graph, compiled.sources)
    lock = read_locks(lock_sources(compiled.sources))
    hashes = {skill: lock[skill].weights for skill in ready.policy.weights if skill in lock}
    run = None
    if with_run:
        from mindlang.cli._session import ensure_compiled, refusing_setups
        from mindlang.proofs.recorded import record_undriven
        from mindlang.run.setup import set_up

        with refusing_setups("--run: "), procedures_talk():
            run = record_undriven(set_up(file, compiled, task, graph.master), seed, ensure_compiled)
    data = proof_data(prove(ready.policy.graph, ready.policy.weights, leak), hashes, run)
    if is_asked("as_json"):
        print_json(data)
    else:
        print_table(proof_report(data))
