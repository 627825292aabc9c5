"""What is asked of a mind whose task is in an environment: each command does it, or says in a sentence why not."""

import gc
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("gymnasium")

import cv2
from mindrun.errors import MindError

from tests.calling import Call, caller
from tests.outside import worlds
from tests.outside.test_environment_workers import mindc as program

RULES = """\
tick 1/50 s
master Go
sensor place is observation 0 range -3 to 3
actuator push is action 0 neutral 1/3

skill Go is rule
  reads place
  influences Left at place
  influences Right at 1 - place

skill Left is rule
  drives push at 0.1

skill Right is rule
  drives push at 0.6

task Go in gymnasium WORLD
  lasts 30 ticks
  rewards its reward
  ends on its end
"""


@pytest.fixture
def mindc(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> Call:
    worlds.register()
    return caller(capsys, monkeypatch)


def rules(folder: Path, world: type[worlds.Line] = worlds.Line, text: str = RULES) -> Path:
    """That mind as a file."""
    path = folder / "go.mind"
    path.write_text(text.replace("WORLD", worlds.name(world)), encoding="utf-8")
    return path


@pytest.fixture
def mind(tmp_path: Path) -> Path:
    return rules(tmp_path)


def test_a_run_is_told(mindc: Call, mind: Path) -> None:
    said = mindc("run", mind, "--seed", 3)
    assert said.code == 0
    assert "rewards its reward" in said.out
    assert "lasted its time" in said.out


def test_what_the_environment_breaks_off_is_said(mindc: Call, tmp_path: Path) -> None:
    mind = rules(tmp_path, worlds.Impatient, RULES.replace("WORLD", "tests.outside.kept:WORLD"))  # processes find it
    assert "ticks  4 of 30, ended by its environment" in mindc("run", mind, "--seed", 3).out
    table = tmp_path / "runs.csv"
    said = mindc("bench", mind, "--runs", 3, "--csv", table, "--json")
    assert json.loads(said.out)["ended"] == {"its environment": 3}
    assert table.read_text().count(",its environment,") == 3


def test_a_trace_has_what_the_mind_has_and_no_robot(mindc: Call, mind: Path, tmp_path: Path) -> None:
    table = tmp_path / "run.csv"
    assert mindc("run", mind, "--seed", 3, "--trace", table).code == 0
    names, *rows = table.read_text().splitlines()
    assert names.split(",")[:4] == ["tick", "time", "reading place", "influence Go"]
    assert not {"x", "angle", "held", "touching", "battery"} & {*names.split(",")}
    assert len(rows) == 30


def test_a_picture_is_what_the_environment_draws(mindc: Call, mind: Path, tmp_path: Path) -> None:
    path = tmp_path / "run.png"
    said = mindc("run", mind, "--seed", 3, "--picture", path)
    assert (said.code, "as its environment draws it" in said.err) == (0, True)
    image = cv2.imread(str(path))
    assert image is not None
    assert (image[100:, 30:970] < 8).mean() > 0.3  # the dark of twelve images


def test_a_film_shows_it_beside_the_hierarchy(mindc: Call, mind: Path, tmp_path: Path) -> None:
    path = tmp_path / "run.mp4"
    assert mindc("run", mind, "--seed", 3, "--video", path, "--speed", 2).code == 0
    film = cv2.VideoCapture(str(path))
    read, image = film.read()
    assert read
    world = image[:, : image.shape[1] // 2]
    assert (world < 16).all(axis=2).mean() > 0.9
    assert (world > 200).all(axis=2).any()


@pytest.mark.parametrize(
    ("world", "message"),
    [
        (worlds.Unseen, "The environment tests/Unseen-v0 cannot be made."),
        (worlds.Dark, "the environment tests/Dark-v0 cannot be drawn"),
        (worlds.Empty, "the environment tests/Empty-v0 draws no pictures"),
    ],
)
@pytest.mark.parametrize("option", ["--picture=run.png", "--video=run.gif"])
def test_where_nothing_can_be_seen_a_sentence_says_why(
    mindc: Call, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, world: type[worlds.Line], message: str, option: str
) -> None:
    monkeypatch.chdir(tmp_path)
    said = mindc("run", rules(tmp_path, world), "--seed", 3, option)
    assert said.code == 2
    assert message in said.err
    assert not list(tmp_path.glob("run.*"))


def test_a_recording_is_replayed_explained_and_asked(mindc: Call, mind: Path, tmp_path: Path) -> None:
    recording, bundle = tmp_path / "run.rec", tmp_path / "go.bundle"
    assert mindc("run", mind, "--seed", 3, "--record", recording).code == 0
    assert mindc("build", mind, "-o", bundle).code == 0
    from mindrun import replay_recording
    from mindrun.robot.recording import read

    about, parts = read(recording)
    assert about.world
    assert (about.world.begin[:3], np.isnan(next(parts)["world"]["pose"]).all()) == ((None, None, None), True)
    assert replay_recording(str(recording), str(bundle)).differs is None
    assert "command to push" in mindc("why", recording, bundle, "--tick", 5, "push").out
    assert "open loop" in mindc("whatif", recording, bundle, "--set", "place=1", "--tick", 3).out
    page = tmp_path / "run.html"
    assert mindc("view", recording, bundle, "--export", page).code == 0
    assert '"world": null' in page.read_text()


def test_an_end_that_the_environment_makes_is_in_the_recording(mindc: Call, tmp_path: Path) -> None:
    mind, recording = rules(tmp_path, worlds.Impatient), tmp_path / "run.rec"
    mindc("run", mind, "--seed", 3, "--record", recording)
    page = tmp_path / "run.html"
    mindc("view", recording, mind, "--export", page)
    assert '"ended_by": "its environment"' in page.read_text()


def test_why_and_what_if(mindc: Call, mind: Path, tmp_path: Path) -> None:
    assert "Left" in mindc("why", mind, "--seed", 3, "--tick", 5, "push").out
    path = tmp_path / "both.png"
    said = mindc("whatif", mind, "--seed", 3, "--tick", 5, "--without", "Left", "--picture", path)
    assert said.code == 0
    assert "influence of Left" in said.out
    assert cv2.imread(str(path)) is not None


def test_a_breakpoint_stops_it(mindc: Call, mind: Path, tmp_path: Path) -> None:
    breaks = tmp_path / "go.break"
    breaks.write_text("stop when place < 60%\n", encoding="utf-8")
    said = mindc("run", mind, "--seed", 3, "--break", breaks)
    assert said.code == 1
    breaks.write_text("stop on its end\n", encoding="utf-8")
    assert mindc("run", mind, "--seed", 3, "--break", breaks).code == 0


def test_a_dry_run_is_refused_before_it_is_begun(mindc: Call, mind: Path, tmp_path: Path) -> None:
    bundle = tmp_path / "go.bundle"
    mindc("build", mind, "-o", bundle)
    words = [sys.executable, "-m", "mindrun", str(bundle), "--dry", "--arm"]
    said = subprocess.run(words, capture_output=True, text=True, check=False)
    assert (said.returncode != 0, said.stdout) == (True, "")
    assert "there is no dry run of Go, which is in the environment tests/Line-v0" in said.stderr
    assert "mindc run and mindc view step it" in said.stderr
    assert "Traceback" not in said.stderr


def test_no_other_simulator_takes_it(mindc: Call, mind: Path) -> None:
    from mindrun.errors import MindError
    from mindrun.sim.commanded_lanes import CommandedWorld

    from mindlang.compiler.compile import load

    graph = load(mind).graph
    assert graph
    with pytest.raises(MindError, match="in the environment tests/Line-v0"):
        CommandedWorld(graph, "Go", 1, None)


def test_a_bundle_thinks_for_readings_from_anywhere(mindc: Call, mind: Path, tmp_path: Path) -> None:
    bundle = tmp_path / "go.bundle"
    mindc("build", mind, "-o", bundle)
    words = [sys.executable, "-m", "mindrun", str(bundle), "--readings", "-"]
    said = subprocess.run(words, input='{"place": 0}\n{"place": 1}\n', capture_output=True, text=True, check=False)
    commands = [json.loads(line)["commands"]["push"] for line in said.stdout.splitlines()]
    assert commands == pytest.approx([0.6, 0.1])


def test_a_robot_may_have_devices_for_what_an_environment_observes(mindc: Call, mind: Path, tmp_path: Path) -> None:
    wiring = tmp_path / "robot.yaml"
    wiring.write_text("robot: Go\nsensors:\n  place: {driver: mock}\nactuators:\n  push: {driver: mock}\n")
    said = mindc("build", mind, "--robot", wiring, "-o", tmp_path / "go.bundle")
    assert said.code == 0
    assert "wired to Go" in said.err


def test_a_training_that_an_environment_ends_is_a_sentence(mindc: Call, tmp_path: Path) -> None:
    raising = "tests.outside.kept:tests/Raising-v0"  # which the worker's process knows, too
    mind = rules(tmp_path, text=(LEARNS + SCHOOL).replace("WORLD", raising))
    said = mindc("train", mind, "--runs", tmp_path / "runs")
    assert said.code in (1, 2)
    assert f"the environment {raising} failed" in said.err
    assert "Traceback" not in said.err
    assert not (tmp_path / "go.lock").exists()


def test_proofs_and_pages(mindc: Call, mind: Path) -> None:
    assert "push" in mindc("prove", mind).out
    assert mindc("lint", mind).code == 0
    assert mindc("fmt", "--check", mind).code == 0
    assert "drives push" in mindc("show", mind).out


@pytest.mark.parametrize("command", ["run", "bench", "why", "whatif", "view"])
def test_an_environment_that_fails_is_one_sentence(mindc: Call, tmp_path: Path, command: str) -> None:
    mind = rules(
        tmp_path, worlds.Raising, RULES.replace("WORLD", "tests.outside.kept:WORLD")
    )  # bench's processes find it
    more = {
        "why": ["--tick", 2, "push", "--seed", 1],
        "whatif": ["--seed", 1, "--tick", 2, "--set", "place=1"],
        "view": ["--export", tmp_path / "run.html", "--seed", 1],
    }
    said = mindc(command, mind, *more.get(command, []))
    assert said.code in (1, 2)
    assert "the environment tests.outside.kept:tests/Raising-v0 failed" in said.err
    assert "Traceback" not in said.err


MODULE = """\
import gymnasium
import numpy as np

print("hello from the module")


class Own(gymnasium.Env):
    observation_space = gymnasium.spaces.Box(-9, 9, (2,))
    action_space = gymnasium.spaces.Box(-1, 1, (1,))

    def __init__(self, gravity):
        self.gravity = gravity

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        return np.full(2, self.gravity, np.float32), {}

    def step(self, action):
        return np.full(2, self.gravity, np.float32), self.gravity, False, False, {}


gymnasium.register("MODULE/Own-v0", "MODULE:Own", kwargs={"gravity": 0.5})
"""


def with_module(folder: Path, module: str) -> Path:
    """A mind in an environment of a module beside it."""
    (folder / f"{module}.py").write_text(MODULE.replace("MODULE", module), encoding="utf-8")
    path = folder / "go.mind"
    path.write_text(RULES.replace("WORLD", f"{module}:{module}/Own-v0"), encoding="utf-8")
    return path


def test_a_module_beside_the_mind_is_found_and_run_by_no_check(tmp_path: Path) -> None:
    mind = with_module(tmp_path, "own_worlds")
    checked = program(tmp_path, "check", mind.name)
    assert (checked.returncode, "hello" in checked.stdout + checked.stderr) == (0, False)
    said = program(tmp_path, "run", mind.name, "--seed", "1", "--json")
    assert "hello from the module" in said.stderr
    assert json.loads(said.stdout)["score"] == 15.0


@pytest.mark.parametrize(
    ("text", "message", "hint"),
    [
        ("def x(", "The environment broken0:broken0/Own-v0 cannot be made.", "SyntaxError"),
        ("import nowhere_at_all", "cannot be made.", "No module named 'nowhere_at_all'"),
        ("", "Gymnasium has no environment called broken2:broken2/Own-v0.", "broken2 has to register it"),
    ],
)
def test_a_module_that_is_wrong_is_told(
    mindc: Call, tmp_path: Path, request: pytest.FixtureRequest, text: str, message: str, hint: str
) -> None:
    module = f"broken{request.node.callspec.indices['text']}"
    mind = with_module(tmp_path, module)
    (tmp_path / f"{module}.py").write_text(text, encoding="utf-8")
    said = mindc("run", mind, "--seed", 1)
    assert said.code == 2
    assert message.replace("broken0", module).replace("broken2", module) in said.err
    assert hint.replace("broken2", module) in said.err


LEARNS = (
    RULES.replace("skill Left is rule", "skill Left is mlp hidden 1\n  reads place")
    .replace("drives push at 0.1", "drives push")
    .replace("rewards its reward", "rewards its reward - push per tick")
)
SCHOOL = "\ncurriculum School is genetic population 4\n  teaches Left on Go under Go for 2 generations\n"


def test_another_text_of_the_module_is_another_world(mindc: Call, tmp_path: Path) -> None:
    mind = with_module(tmp_path, "taught_worlds")
    mind.write_text(LEARNS.replace("WORLD", "taught_worlds:taught_worlds/Own-v0") + SCHOOL, encoding="utf-8")
    assert mindc("train", mind, "--runs", tmp_path / "runs").code == 0
    assert "trained" in mindc("status", mind).out
    module = tmp_path / "taught_worlds.py"
    module.write_text(module.read_text().replace("0.5", "0.25"), encoding="utf-8")
    assert "the text of its task's environment has changed" in mindc("status", mind).out
    mind.write_text(mind.read_text().replace("/Own-v0", "/Own-v1"), encoding="utf-8")
    said = mindc("status", mind).out
    assert "in gymnasium taught_worlds:taught_worlds/Own-v0, now taught_worlds:taught_worlds/Own-v1" in said


def test_environments_are_closed_after_use() -> None:
    from tests.outside import minds

    rollout = minds.rollout_of(minds.text(), lanes=3)
    gc.collect()  # of tests before this one
    before = worlds.Line.closed
    rollout.score(minds.genomes(rollout, 2), [1, 2, 3])
    assert worlds.Line.closed == before + 6  # one for each run
    before = worlds.Line.closed
    rollout = minds.rollout_of(minds.text(scene=worlds.name(worlds.Raising)), lanes=3)
    with pytest.raises(MindError):
        rollout.score(minds.genomes(rollout, 1), [1, 2, 3])
    del rollout
    gc.collect()
    assert worlds.Line.closed >= before + 3  # of runs that were broken off, when nobody has them any more


def test_the_images_of_a_run_are_those_of_its_ticks() -> None:
    from mindrun.sim.outside.seen import SeenEpisode
    from mindrun.sim.trace import trace

    from tests.outside import minds

    rollout = minds.rollout_of(minds.text(actuators="actuator push is action 0 neutral 0.5 delay 2 ticks"))
    moments = list(trace(rollout, 7, minds.genomes(rollout, 1)[0]).moments)
    sent = np.array([moment.acting for moment in moments])
    seen = SeenEpisode(rollout.graph, worlds.name(worlds.Line), None, 7, lambda first, last: sent[first:last])
    for tick in (0, 1, 5, 3, len(moments) - 1):
        column = int(seen.image(tick)[19, :, 0].argmax())
        place = moments[tick].readings[0] * 4 - 2  # what is read in the tick after it
        assert abs(place) == 2 or abs(30 + 9 * place - column) < 1.001
