"""`mindc imitate`: a skill learns from recordings of what another one, or a rule, did."""

import json
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest
from mindrun.kinds.functions.ctrnn import Ctrnn
from mindrun.kinds.functions.elman import Elman
from mindrun.kinds.functions.function import NetworkFunction
from mindrun.kinds.functions.gru import Gru
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.neat import Neat
from mindrun.train.manifest import hashes

from mindlang.compiler.compile import load
from mindlang.lock import lock_path, read_lock
from mindlang.run.drives import read_drives
from mindlang.training.subject import open_subject
from mindlang.weights import least_squares
from mindlang.weights.least_squares import Examples, fitted
from tests.calling import Call

MIND = """tick 1/60 s
master Teacher
body Robot is disc size 2 density 2 linear_damping 5 angular_damping 20
actuator left_wheel is wheel side left thrust 80 neutral 0.5 delay 2 ticks
actuator right_wheel is wheel side right thrust 80 neutral 0.5
sensor ball_bearing is bearing of ball
sensor nothing is distance of ball range 50
skill Teacher is rule
  reads ball_bearing
  drives left_wheel at 0.2 + 0.6 * ball_bearing
  drives right_wheel at 0.8 - 0.6 * ball_bearing
skill Go is mlp hidden 2
  reads ball_bearing
  drives left_wheel
  drives right_wheel
skill Off is mlp hidden 1
  reads nothing
  drives left_wheel
skill Chief is mlp hidden 1
  reads ball_bearing
  influences Go
  influences Off
task Find in plain
  contains ball is item size 2 reached moves
  lasts 400 ticks
  rewards progress toward ball per tick
  counts reach of ball
curriculum School is genetic population 4
  teaches Go on Find for 2 generations
"""


@pytest.fixture
def path(mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A mind whose rule drove three times, as a file in the working folder."""
    monkeypatch.chdir(tmp_path)
    found = Path("go.mind")
    found.write_text(MIND)
    for seed in (1, 2, 3):
        said = mindc("run", found, "--master", "Teacher", "--seed", seed, "--record", f"{seed}.rec", "-q")
        assert said.code == 0, said.err
    return found


def test_a_rule_is_learnt_and_a_lesson_goes_on_from_it(mindc: Call, path: Path) -> None:
    """To a thousandth on a drive that was held out, though commands reach one wheel two ticks later."""
    said = mindc("imitate", path, "Go", "1.rec", "2.rec", "3.rec", "--json")
    assert said.code == 0, said.err
    data, entry = json.loads(said.out), read_lock(lock_path(path))["Go"]
    assert [each["to"] for each in data["outputs"]] == ["left_wheel", "right_wheel"]
    assert all(each["error"] < 0.001 < 0.05 < each["of_mean"] for each in data["outputs"])
    assert data["recordings"] == {f"{n}.rec": sha256(Path(f"{n}.rec").read_bytes()).hexdigest() for n in (1, 2, 3)}
    assert (data["ticks"], data["held_out_ticks"]) == (800, 400)
    assert entry.weights == data["weights"]
    assert entry.origin_file.endswith(f";seed=1;error={np.mean([each['error'] for each in data['outputs']]):.4f}")
    again = mindc("imitate", path, "Go", "1.rec", "2.rec", "3.rec")
    assert "has these weights already" in again.out, "the same seed gives the same weights"
    assert mindc("train", path, "Go", "-q").code == 0
    [run] = Path("runs").glob("*/*/")
    weights = json.loads((run / "manifest.json").read_text())["weights"]
    taught = np.load(Path("weights") / f"{data['weights']}.npy")
    assert weights == hashes({"Go": taught}), "it began with them"


def test_what_remembers_is_fitted_tick_by_tick() -> None:
    """A gated unit finds what another one does to things that it saw before."""
    teacher, rng = Gru(2), np.random.default_rng(3)
    weights = teacher.draw(1, 1, 1, rng)[0] / np.float32(2)
    inputs = np.repeat(rng.random((20, 2, 1)), 5, axis=0)
    wanted = np.zeros((100, 2, 1))
    for place in range(2):
        compute = teacher.ready(1, 1, weights, {})
        wanted[:, place] = [np.clip(compute(row.astype(np.float32)), 0, 1) for row in inputs[:, place]]
    found = teacher.ready(1, 1, fitted(Gru(2), Examples(inputs, wanted), 1, lambda steps: None), {})
    sent = np.array([np.clip(found(row.astype(np.float32)), 0, 1) for row in inputs[:, 0]])
    assert np.abs(sent - wanted[:, 0]).mean() < 0.1 * np.abs(wanted[:, 0] - wanted.mean()).mean()


@pytest.mark.parametrize(
    "function",
    [Mlp(hidden=2, bias=1), Neat(most=2), Neat(most=2, links="any"), Elman(2), Gru(2, bias=1), Ctrnn(2)],
    ids=repr,
)
def test_a_fit_computes_what_the_skill_does(function: NetworkFunction) -> None:
    rng = np.random.default_rng(5)
    inputs, genomes = rng.random((9, 2, 3)), rng.standard_normal((4, function.genome_length(3, 2)))
    found = least_squares._residuals(function, Examples(inputs, np.full((9, 2, 2), 0.5)), genomes)
    for genome, residuals in zip(genomes, found.reshape(4, 9, 2, 2), strict=True):
        for place in range(2):
            compute = function.ready(3, 2, genome.astype(np.float32), {})
            sent = np.array([compute(row.astype(np.float32)) for row in inputs[:, place]])
            assert np.abs(sent - 0.5 - residuals[:, place]).max() < 1e-4


@pytest.mark.parametrize(
    ("words", "old", "new", "said"),
    [
        (("Go", "1.rec"), "sensor nothing is distance of ball range 50", "", "is a recording of another mind"),
        (
            ("Go", "1.rec"),
            "left_wheel is",
            "port_wheel is",
            "it drives left_wheel and right_wheel, and the mind port_w",
        ),
        (("Go", "1.rec"), "tick 1/60 s", "tick 1/30 s", "its tick is 0.0166667 s"),
        (("Off", "1.rec"), "teaches Go", "teaches Off", "1.rec has no reading of nothing, which Off reads"),
        (("Teacher", "1.rec"), "", "", "Teacher has no weights: it learns nothing"),
        (("Nobody", "1.rec"), "", "", "there is no skill called Nobody"),
        (("Go", "short.rec"), "", "", "short.rec shows Go too little: 50 ticks that can be compared, 10"),
        (
            ("Chief", "1.rec"),
            "teaches Go",
            "teaches Chief",
            "Chief cannot be tried on Find yet: Go has not been taught",
        ),
        (("Go", "go.mind"), "", "", "go.mind is no recording"),
    ],
)
def test_what_cannot_be_learnt_is_said(
    mindc: Call, path: Path, words: tuple[str, ...], old: str, new: str, said: str
) -> None:
    short = MIND.replace("lasts 400 ticks", "lasts 50 ticks")
    Path("short.mind").write_text(short)
    mindc("run", "short.mind", "--master", "Teacher", "--record", "short.rec", "-q")
    text = MIND.replace(old, new) if old else MIND
    if "port_wheel" in text:
        text = text.replace("drives left_wheel", "drives port_wheel")
    if words[0] == "Off" or "distance" not in text:
        text = text if "distance" in text else text.replace("reads nothing", "reads ball_bearing")
    path.write_text(text)
    found = mindc("imitate", path, *words)
    assert found.code != 0
    assert said in found.err, found.err
    assert not lock_path(path).exists()


def test_commands_stand_in_the_ticks_in_which_they_were_sent(path: Path) -> None:
    graph = open_subject(path, load(path)).graph
    [drive] = read_drives([Path("1.rec")], graph)
    left, right = drive.commands[:398].T
    assert np.allclose(left + right, 1, atol=1e-6)
    assert np.isnan(drive.commands[398:, 0]).all()
