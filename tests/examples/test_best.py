"""The best minds: what docs/learning.md says of their shipped weights, with a wide margin for 40 runs."""

import numpy as np
from mindrun.sim.rollout import Rollout

from mindlang.compiler.compile import load
from mindlang.lock.status import make_ready
from tests.examples.test_paper import COLLECT

RUNS = 40


def test_the_best_minds_deliver_more_than_the_one_that_one_begins_with() -> None:
    objects = {}
    for name in ("on_the_job.mind", "best.mind", "all_on_the_job.mind"):
        found = load(COLLECT / name)
        assert found.graph
        ready = make_ready(found.graph, found.sources)
        assert not ready.refusals
        rollout = Rollout(ready.policy, "Collect", found.graph.master)
        scores = rollout.score(np.zeros((1, 0), np.float32), range(RUNS))
        objects[name] = scores.counts.mean()
        assert scores.ticks.mean() > 0.93 * rollout.task.ticks
    assert objects["best.mind"] > 16.2  # 17.6 ± 0.1 of 1,000, so ± 0.55 of 40
    assert objects["all_on_the_job.mind"] > 16.6  # 18.1 ± 0.12 of 1,000
    assert min(objects["best.mind"], objects["all_on_the_job.mind"]) > objects["on_the_job.mind"]
