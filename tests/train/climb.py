"""Go on with a run in a process of its own: `climb.py FOLDER [CODE TO RUN BEFORE] [SECONDS A GENERATION]`."""

import sys
from pathlib import Path
from time import perf_counter, sleep

from climbing import Sphere, forget
from mindrun.train import RunError
from mindrun.train.run_folder import open_run
from mindrun.train.training import Watch, train


def main(folder: str, before: str = "", pause: str = "0") -> None:
    run = open_run(Path(folder))
    exec(before)
    print("ready", flush=True)
    try:
        train(
            run, Sphere(), Watch(lambda *_: sleep(float(pause)), forget, lambda: False, perf_counter, save_every=0.01)
        )
    except RunError as error:
        sys.exit(str(error))


main(*sys.argv[1:])
