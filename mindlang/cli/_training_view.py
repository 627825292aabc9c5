"""Trainings to be seen: the folder read, the simulator compiled, and the newest champion at its beginning."""

import secrets
from pathlib import Path

from mindrun.errors import MindError
from mindrun.train import NotFoundError

from mindlang.cli._run_session import RunSession
from mindlang.cli._simulator_compilation import ensure_compiled
from mindlang.cli._terminal import FINDINGS, MISUSE, fail, procedures_talk
from mindlang.view.learning import Learning, open_learning
from mindlang.view.messages import RefusedError
from mindlang.view.viewed import Viewed


@procedures_talk()
def training_view(folder: Path, seed: int | None, quiet: bool) -> tuple[Viewed, Learning]:
    """The champion that was found last, and all others; what is no training ends the program with one message."""
    try:
        learning = open_learning(folder, secrets.randbits(31) if seed is None else seed)
        number, attempt, generation = learning.newest()
        ensure_compiled(learning.rollout(number), RunSession(quiet).say)
        return learning.begin(number, attempt, generation), learning
    except NotFoundError as error:
        fail(str(error), error.hint, MISUSE)
    except (MindError, RefusedError) as error:
        fail(str(error), getattr(error, "hint", ""), FINDINGS)
