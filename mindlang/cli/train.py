"""`mindc train`: teach the skills of a mind.

Examples:
  mindc train collect.mind    every lesson that has no weights or stale ones
  mindc train collect.mind GoToObject --generations 50 --seed 1
  mindc train on_the_job.mind --scale 0.1      a tenth of the generations
  mindc train on_the_job.mind --attempts 3     the best of three
  mindc train collect.mind --on ssh:a,b        attempts on two machines
  mindc train collect.mind --on slurm:8,cores=4,memory=8GB
  mindc train --resume runs/GoToObject/20260714T120000Z-1
  mindc train collect.mind --tensorboard       then: tensorboard --logdir runs
\b
A cluster with SLURM (what tls.pem is, and other ways: docs/cluster.md):
  TLS="--protocol tls --tls-ca-file tls.pem \\
    --tls-cert tls.pem --tls-key tls.pem"
  sbatch --wrap "dask scheduler --scheduler-file scheduler.json $TLS"
  sbatch --array 1-8 -c 4 --requeue --wrap \\
    "dask worker --scheduler-file scheduler.json --nthreads 4 $TLS"
  mindc train collect.mind --attempts 32 --on dask:scheduler.json,tls.pem
"""

from pathlib import Path
from typing import Any

import click

from mindlang import limits
from mindlang.cli import _options as options
from mindlang.cli._options import NumberOption, WholeOption, flag
from mindlang.cli._terminal import INTERRUPTED, MISUSE, OK, fail, need, refuse_standard_input, refusing_lessons


@click.command
@click.argument("file", required=False)
@click.argument("skills", nargs=-1, metavar="[SKILL]...", shell_complete=options.SKILLS)
@options.named(
    "--curriculum", "NAME", options.declared("curriculum"), "Whose lessons to teach (default: the first in the file)."
)
@click.option("--generations", type=WholeOption(*limits.GENERATION_BOUNDS), help="Instead of what the lesson says.")
@click.option("--scale", type=NumberOption(0, 1000, min_open=True), default=1.0, help="Times so many generations.")
@click.option("--population", type=WholeOption(*limits.POPULATION_BOUNDS), help="Genomes in a generation.")
@click.option("--attempts", type=WholeOption(*limits.ATTEMPT_BOUNDS), help="Independent attempts; the best is kept.")
@flag("--from-scratch", "Forget the weights that the skill has.")
@flag("--force", "Teach what is up to date, too, and keep it even where it does worse.")
@click.option("--seed", type=options.SEED, help="The same seed gives the same weights.")
@options.WORKERS
@options.ON(
    help="Who does the attempts: processes:N, ssh:HOST,HOST, slurm:N, dask:SCHEDULER … (default: threads; processes in"
    " environments of Gymnasium)."
)
@click.option("--runs", type=options.PATH, default="runs", show_default=True, help="Where runs are kept.")
@click.option("--resume", type=options.PATH, metavar="RUN", help="Go on with a run that was stopped.")
@flag("--tensorboard event_files", "Write event files for TensorBoard into the run, too.")
@flag("--json as_json", "Print one line of JSON per lesson.")
@flag("-q --quiet", "Print nothing but errors.")
def command(file: str | None, skills: tuple[str, ...], resume: Path | None, force: bool, **said: Any) -> int:
    """Teach the skills of FILE, in the order of its curriculum.

    Those named, or all without up-to-date weights: where the skill has changed, or the world in which it was taught, as
    mindc status says. New weights that do worse than those of the lock, on common fresh layouts, do not take their
    place.

    Runs the Python code of the file's procedures. Every lesson gets a folder under runs/, from which it can go on after
    Ctrl-C, a crash or a power cut: with --resume, or by itself when the very same lesson is asked for with the same
    --seed. Its progress.csv has a row for each generation. The weights go to the lock of the file in which the lesson
    stands, or to the one that says them now.
    """
    from mindlang.cli._trainer import Trainer
    from mindlang.training.lesson_choice import TrainOptions

    refuse_standard_input(file or "", "Standard input cannot be taught: what is learnt is kept beside a file.")
    if (file is None) == (resume is None):
        fail("Say what to train: a file, or --resume and a run.", "mindc train --help has examples.", MISUSE)
    if said["event_files"]:
        need("tensorboardX", "Event files are written with", "tensorboard")
    trainer, numbers = options.taken(Trainer, said), options.taken(TrainOptions, said)
    with refusing_lessons():
        if resume:
            finished = trainer.resume(resume, force)
        else:
            finished = trainer.teach_file(Path(str(file)), skills, options=numbers, force=force, **said)
    return OK if finished else INTERRUPTED
