"""`mindrun` on a robot of mock drivers: real processes, from the command line."""

import json
import re
import subprocess
from pathlib import Path

import pytest
from mindrun.cli import tools
from mindrun.cli.doctor import machine
from mindrun.graph.bundle import Bundle, write_bundle
from mindrun.graph.policy import Policy
from mindrun.robot.recording import read

from tests.robot.driving import MINDRUN, NAME, mindrun, wiring
from tests.robot.faults import MIND, SENSORS, graph
from tests.sim.minds import compile_text

NEUTRAL = [0.5, 0.5, 0.0]
OUTSIDE = """mind 1
tick 1/50 s
master Go
sensor height is observation 0 range -1 to 1
actuator torque is action 0 neutral 0.5
skill Go is rule
  reads height
  drives torque at height
task Swing in gymnasium Pendulum-v1
  lasts 100 ticks
  rewards its reward
"""


def test_it_drives_records_and_is_replayed(bundle: Path, tmp_path: Path) -> None:
    day = tmp_path / "day.rec"
    said = mindrun(bundle, "--arm", "--ticks", 25, "--record", day)
    assert (said.returncode, said.stdout) == (0, ""), said.stderr
    assert "25 ticks of 50.0 ms" in said.stderr
    assert "nothing will move" not in said.stderr
    about, parts = read(day)
    (rows,) = parts
    assert about.sensors == ("sense",)
    assert (rows["armed"] == 1).all()
    assert (rows["sent"] == rows["commands"]).all()
    said = mindrun("replay", day, bundle)
    assert (said.returncode, said.stdout) == (0, "25 ticks, the same to the bit\n")
    said = mindrun("report", day, bundle, "--json")
    lines = {line["what"]: line for line in json.loads(said.stdout)["lines"]}
    assert lines["sense lost"]["kept"]


def test_nothing_moves_unless_it_is_armed(bundle: Path, tmp_path: Path) -> None:
    said = mindrun(bundle, "--ticks", 5, "--record", tmp_path / "day.rec")
    assert said.returncode == 0
    assert "nothing will move: --arm lets it" in said.stderr
    _, (rows,) = read(tmp_path / "day.rec")
    assert (rows["armed"] == 0).all()


def test_a_signal_ends_it_and_keeps_the_recording(bundle: Path, tmp_path: Path) -> None:
    day = tmp_path / "day.rec"
    process = subprocess.Popen([*MINDRUN, bundle, "--record", day], stderr=subprocess.PIPE, text=True)
    assert process.stderr
    assert "nothing will move" in process.stderr.readline()
    while not day.exists() or day.stat().st_size < 2000:
        assert process.poll() is None
    process.terminate()
    _, err = process.communicate(timeout=600)
    assert process.returncode == 0, err
    assert "ticks of 50.0 ms" in err
    assert mindrun("replay", day, bundle).returncode == 0


def test_a_bundle_for_another_wiring_moves_nothing(bundle: Path, tmp_path: Path) -> None:
    other, day = tmp_path / "other.bundle", tmp_path / "day.rec"
    write_bundle(other, Bundle(Policy(graph("bearing"), {}), {}, wiring(0.7)))
    said = mindrun(other, "--arm", "--ticks", 3, "--record", day)
    assert (said.returncode, day.exists()) == (2, False)
    assert f"whose wiring or neutral commands are others than those of {NAME}" in said.stderr
    assert mindrun(other, "--ticks", 3).returncode == 2, "a guardian writes neutral, and that is another's motion"
    (tmp_path / "robot" / "identity").unlink()
    said = mindrun(bundle, "--arm", "--ticks", 3)
    assert said.returncode == 2
    assert "this robot has not said how it is wired" in said.stderr
    said = mindrun(other, "--ticks", 3)
    assert said.returncode == 0
    assert "no actuator is opened" in said.stderr


def test_other_neutral_commands_are_another_robot(bundle: Path) -> None:
    text = MIND.format(kind=SENSORS["bearing"][0], function="rule").replace(
        "side left neutral 0.5", "side left neutral 0"
    )
    write_bundle(bundle, Bundle(Policy(compile_text(text), {}), {}, wiring()))
    assert mindrun(bundle, "--ticks", 2).returncode == 2


def test_nothing_is_recorded_over(bundle: Path) -> None:
    data = bundle.read_bytes()
    said = mindrun(bundle, "--ticks", 2, "--record", bundle)
    assert said.returncode == 2
    assert "exists already" in said.stderr
    assert bundle.read_bytes() == data


def test_another_master_is_in_charge(bundle: Path, tmp_path: Path) -> None:
    day = tmp_path / "day.rec"
    said = mindrun(bundle, "--master", "Gone")
    assert said.returncode == 2
    assert "there is no skill Gone" in said.stderr
    said = mindrun(bundle, "--ticks", 3, "--master", "Go", "--record", day)
    assert said.returncode == 0, said.stderr
    assert read(day)[0].master == "Go"
    assert mindrun("replay", day, bundle).returncode == 0


def test_a_master_that_reads_what_is_not_wired_is_refused(bundle: Path) -> None:
    text = MIND.format(kind=SENSORS["bearing"][0], function="rule")
    text = text.replace("sensor pulse", "sensor charge is battery\nsensor pulse")
    look = "skill Look is rule\n  reads charge\n  drives claw at charge\n"
    write_bundle(bundle, Bundle(Policy(compile_text(text.replace("task Play", f"{look}task Play")), {}), {}, wiring()))
    assert mindrun(bundle, "--ticks", 2).returncode == 0
    said = mindrun(bundle, "--ticks", 2, "--master", "Look")
    assert said.returncode == 2
    assert "Look reads charge, which is not wired" in said.stderr


def test_a_bundle_without_wiring_says_what_it_holds(tmp_path: Path) -> None:
    bundle = tmp_path / "mind.bundle"
    write_bundle(bundle, Bundle(Policy(graph("bearing"), {}), {}))
    assert mindrun(bundle).stdout.startswith("master Go, 20 ticks a second")
    assert mindrun(bundle, "--arm").returncode == 2
    said = mindrun("replay", bundle, bundle)
    assert (said.returncode, said.stdout) == (2, "")
    assert "is no recording of this mindrun" in said.stderr


def test_describe_moves_nothing(bundle: Path) -> None:
    assert mindrun(bundle, "--describe").stdout.startswith("master Go")
    assert json.loads(mindrun(bundle, "--json").stdout)["master"] == "Go"


def test_a_damaged_bundle_moves_nothing(bundle: Path) -> None:
    data = bytearray(bundle.read_bytes())
    data[len(data) // 2] ^= 1
    bundle.write_bytes(data)
    said = mindrun(bundle, "--arm", "--ticks", 3)
    assert said.returncode == 2
    assert "damaged" in said.stderr


def test_doctor_says_what_answers(bundle: Path) -> None:
    said = mindrun("doctor", bundle)
    assert said.returncode == 0, said.stdout
    rows = {line[4:].split()[0]: line for line in said.stdout.splitlines()}
    assert rows["sense"].startswith("ok   sense")
    assert "mock reads 0.6" in rows["sense"]
    assert "mock, left alone" in rows["claw"]


def test_what_is_not_there_is_neither_fine_nor_a_fault(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindrun.cli.doctor.find_spec", lambda package: None)
    marks = {finding.what: (finding.mark.strip(), finding.words) for finding in machine()}
    assert marks["machine"][0] == "ok"
    assert marks["lgpio"] == ("-", "not installed: sudo apt install python3-lgpio")
    assert marks["numpy"][0] == "NOT"


def test_calibrate_prints_lines_for_the_wiring(bundle: Path) -> None:
    said = mindrun("calibrate", bundle, "sense", "--seconds", 0.5)
    assert said.returncode == 0, said.stderr
    assert "# from and to are those of training (0 to 1)" in said.stdout
    assert mindrun("calibrate", bundle, "sense", "--seconds", "nan").returncode == 2
    said = mindrun("calibrate", bundle, "sence")
    assert said.returncode == 2
    assert "no sensor or motor sence is wired" in said.stderr


def test_every_tool_explains_itself() -> None:
    for tool in tools():
        said = mindrun(tool, "--help")
        assert said.returncode == 0
        assert f"mindrun {tool}" in said.stdout
        assert "examples:" in said.stdout


def test_a_dry_run_says_where_it_drives_and_is_over_when_its_run_is(quick: Path) -> None:
    seed = 2**64 - 1  # as `mindc bench` prints them
    said = mindrun(quick, "--dry", "--arm", "--ticks", 100_000, "--seed", seed)
    assert said.returncode == 0, said.stderr
    lines = said.stderr.splitlines()
    assert lines[0].startswith("dry run: Play with ")
    assert lines[0].endswith(f" in charge, in a world of 40 x 40 with ball, spot, seed {seed}")
    assert lines[1] == "no device is touched: the world is simulated, in real time"
    assert "Ctrl-C ends it now" in lines[2]
    assert "20 of 20, lasted its time" in said.stderr
    assert said.stderr.count("tick ") == 1  # one line, where there is no terminal, and the next one after 10 s
    assert f"seed  {seed}" in said.stderr
    assert re.match(r"\d+ ticks of ", lines[-1])


def test_a_dry_run_in_an_environment_of_gymnasium_is_refused(tmp_path: Path) -> None:
    pytest.importorskip("gymnasium")
    write_bundle(tmp_path / "swing.bundle", Bundle(Policy(compile_text(OUTSIDE), {}), {}))
    said = mindrun(tmp_path / "swing.bundle", "--dry")
    assert said.returncode == 2
    assert said.stderr.splitlines()[-2:] == [
        "mindrun: there is no dry run of Swing, which is in the environment Pendulum-v1",
        "  mindc run and mindc view step it, from the source of this bundle",
    ]
    assert "dry run:" not in said.stderr


def test_a_quiet_dry_run_says_nothing_and_ends_as_well(quick: Path) -> None:
    said = mindrun(quick, "--dry", "--arm", "--quiet")
    assert (said.returncode, said.stdout, said.stderr) == (0, "", "")
