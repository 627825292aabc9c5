"""`python -m mindrun` as its users meet it."""

import json
import subprocess
import tomllib
from pathlib import Path
from tempfile import NamedTemporaryFile

import numpy as np
import pytest
from mindrun import VERSION
from mindrun.__main__ import main
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.graph import Edge
from mindrun.graph.policy import Policy
from mindrun.graph.weights import genes
from mindrun.kinds.functions.mlp import Mlp
from mindrun.kinds.functions.procedure import Procedure
from mindrun.kinds.memory import Cell

from mindlang.compiler.compile import load
from tests.minds import always, mind, rule, skill
from tests.project.sources import ROOT
from tests.surroundings.streams import ended


@pytest.fixture
def bundle(tmp_path: Path) -> Path:
    """A bundle with a rule over a trained skill, and a memory that counts."""
    echo = Edge("actuator", 1, None, (("reading", 1),))
    top = rule("Top", always("skill", 1, 1.0), always("memory", 0, 1.0), echo, reads=(1,))
    go = skill("Go", Mlp(1), (0,), ("actuator", 0))
    path = tmp_path / "a.bundle"
    write_bundle(path, Bundle(Policy(mind(top, go, cells=(Cell(0.5),)), {"Go": np.ones(genes(go), np.float32)}), {}))
    return path


def mindrun(*words: object, text: str = "") -> subprocess.CompletedProcess[str]:
    """Run the command with a standard input, in a fork of this process."""
    with NamedTemporaryFile("w", encoding="utf-8") as given:
        given.write(text)
        given.flush()
        code, out, err = ended(main, words, stdin=given.name)
    return subprocess.CompletedProcess([], code, out.decode(), err.decode())


def test_it_says_what_a_bundle_holds(bundle: Path) -> None:
    said = mindrun(bundle)
    assert said.returncode == 0
    assert said.stdout.splitlines() == [
        "master Top, 60 ticks a second",
        "sensor r0 is battery: 1 reading",
        "memory m0 is cell: decay 0.5",
        "actuator left_wheel is wheel: neutral 0.5",
        "actuator right_wheel is wheel: neutral 0.5",
        "skill Top is rule: 1 input",
        "skill Go is mlp: 1 input, 6 weights",
    ]
    assert json.loads(mindrun(bundle, "--json").stdout)["master"] == "Top"


def test_it_runs_lines_of_readings(bundle: Path) -> None:
    said = mindrun(bundle, "--readings", "-", "--influence", text='{"r0": 1}\n\n{"r0": 0.5}\n{"r0": [0]}\n')
    lines = [json.loads(line) for line in said.stdout.splitlines()]
    assert said.returncode == 0
    assert [line["commands"] for line in lines] == [
        {"left_wheel": 1.0, "right_wheel": 0.0},
        {"left_wheel": 1.0, "right_wheel": 0.5},
        {"left_wheel": 1.0, "right_wheel": 0.75},
    ]
    assert lines[0]["influence"] == {"Top": 1.0, "Go": 1.0}


def test_another_master_and_missing_readings(bundle: Path) -> None:
    said = mindrun(bundle, "--readings", "-", "--master", "Go", "--fill", "0.5", text="{}")
    assert json.loads(said.stdout) == {"commands": {"left_wheel": 1.0, "right_wheel": 0.5}}


def test_a_failed_reading_is_reported_and_goes_nowhere(bundle: Path) -> None:
    said = mindrun(bundle, "--readings", "-", text='{"r0": NaN}')
    assert json.loads(said.stdout)["commands"]["left_wheel"] == 0.5
    assert said.stderr == "1 output was not sent, because a number was not finite\n"


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("{}", "line 1: there is no reading of sensor r0 (--fill 0.5 would set it)"),
        ('{"r0": 1, "r00": 1}', "line 1: there is no sensor r00; did you mean r0?"),
        ('{"r0": 1, "m0": 1}', "line 1: m0 is computed by the mind itself, leave it out"),
        ('{"r0": [1, 1]}', "line 1: sensor r0 has 1 reading, not 2"),
        ('{"r0": 1.5}', "line 1: sensor r0 cannot read 1.5: a reading is a number from 0 to 1"),
        ('{"r0": "1"}', "line 1: sensor r0 cannot read '1': a reading is a number from 0 to 1"),
        ('{"r0": true}', "line 1: sensor r0 cannot read True: a reading is a number from 0 to 1"),
        ("[1]", 'line 1: write readings as {"sensor": 0.5}'),
        ("{", 'line 1: write readings as {"sensor": 0.5}'),
        ("[" * 100_000, 'line 1: write readings as {"sensor": 0.5}'),
    ],
)
def test_wrong_readings(bundle: Path, line: str, message: str) -> None:
    said = mindrun(bundle, "--readings", "-", text=line)
    assert said.returncode == 2
    assert said.stderr.startswith(f"mindrun: standard input, {message}")
    assert said.stderr.count("\n") == 1


def test_wrong_usage(bundle: Path, tmp_path: Path) -> None:
    (tmp_path / "binary").write_bytes(b"\xff\xfe\n")
    for words, message in [
        ((tmp_path / "no.bundle",), "No such file"),
        ((tmp_path / "binary",), "is not a bundle"),
        ((bundle, "--readings", tmp_path / "no.jsonl"), "No such file"),
        ((bundle, "--readings", tmp_path / "binary"), "is not UTF-8"),
        ((bundle, "--readings", "-", "--master", "Nobody"), "there is no skill Nobody"),
        ((bundle, "--readings", "-", "--fill", "2"), "--fill: 2 is not a number from 0 to 1"),
        ((bundle, "--readings", "-", "--fill", "half"), "--fill: half is not a number from 0 to 1"),
        ((), "required"),
    ]:
        said = mindrun(*words)
        assert said.returncode == 2, words
        assert message in said.stderr
        assert "Traceback" not in said.stderr


def test_a_procedure_that_fails_is_a_failed_run(tmp_path: Path) -> None:
    path = tmp_path / "a.bundle"
    go = skill("Go", Procedure("claw.grip"), (0,), ("actuator", 0))
    write_bundle(path, Bundle(Policy(mind(go), {}), {"claw": "def grip(r): return 1 / r"}))
    said = mindrun(path, "--readings", "-", text='{"r0": 0}')
    assert said.returncode == 1
    failed = "procedure claw.grip fails for [0.0] in claw.py, line 1: ZeroDivisionError: float division by zero"
    assert said.stderr == f"mindrun: {failed}\n"


def test_what_a_procedure_prints_is_no_command(tmp_path: Path) -> None:
    path = tmp_path / "a.bundle"
    go = skill("Go", Procedure("claw.grip"), (0,), ("actuator", 0))
    write_bundle(
        path, Bundle(Policy(mind(go), {}), {"claw": "print('begins')\ndef grip(r):\n    print('grips')\n    return r"})
    )
    said = mindrun(path, "--readings", "-", text='{"r0": 1}')
    assert json.loads(said.stdout)["commands"]["left_wheel"] == 1.0
    assert said.stderr == "begins\ngrips\n"


def test_help_has_an_example_for_every_option() -> None:
    said = mindrun("--help").stdout
    for option in ("--json", "--readings", "--fill", "--influence", "--master"):
        assert said.count(option) >= 2, option


def test_what_nobody_reads_need_not_be_given(tmp_path: Path) -> None:
    """And what the master or a skill below it reads, as a derivative too, has to."""
    text = """\
tick 1/10 s
master Go
body Robot is disc
actuator wheel is wheel side left neutral 0.5
sensor eyes is range_finder at 0 90 deg
sensor charge is battery
sensor spare is inertial
sensor drain is derivative of charge
skill Go is rule
  reads drain
  drives wheel at drain
skill Look is rule
  reads eyes
  drives wheel at eyes
"""
    (tmp_path / "any.mind").write_text(text.replace("at eyes", "at 0.25"))
    found = load(tmp_path / "any.mind")
    assert found.graph, found.diagnostics
    write_bundle(tmp_path / "a.bundle", Bundle(Policy(found.graph, {}), {}))
    run = (tmp_path / "a.bundle", "--readings", "-")
    assert mindrun(*run, text='{"charge": 0.5}').stdout == '{"commands": {"wheel": 0.5}}\n'
    assert mindrun(*run, text='{"charge": 0.5, "eyes": [0, 1]}').returncode == 0
    assert "there is no reading of sensor charge" in mindrun(*run, text='{"eyes": [1, 1]}').stderr
    assert "there is no reading of sensor eyes" in mindrun(*run, "--master", "Look", text='{"charge": 0.5}').stderr


def test_its_version_is_that_of_its_packages() -> None:
    for path in (ROOT / "pyproject.toml", ROOT / "runtime" / "pyproject.toml"):
        assert tomllib.loads(path.read_text(encoding="utf-8"))["project"]["version"] == VERSION
    assert mindrun("--version").stdout == f"mindrun, version {VERSION}\n"
