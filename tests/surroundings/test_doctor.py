"""`mindc doctor`: what is missing is never called ok, and the line that mends it is said."""

import json
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import pytest
from mindrun.cli import doctor, tool_parser
from mindrun.sim import cache

from mindlang import diagnosis, physics_check
from mindlang.diagnosis import DoctorFinding
from tests.calling import Call


def without(monkeypatch: pytest.MonkeyPatch, *names: str, **others: str) -> None:
    """Let packages be missing, or of another version; what needs them is said here."""

    def found(name: str) -> str:
        if name in names:
            raise PackageNotFoundError(name)
        return others.get(name) or version(name)

    lines = ["numpy>=1.26", "numba<0.69,>=0.63", 'matplotlib>=3.8; extra == "plot"', 'pytest>=8; extra == "dev"']
    monkeypatch.setattr(diagnosis, "version", found)
    monkeypatch.setattr(diagnosis, "requires", lambda _: lines)
    monkeypatch.setattr(diagnosis, "extras", lambda: ["plot", "dev"])


def said(mindc: Call) -> tuple[int, dict[str, dict[str, str]]]:
    done = mindc("doctor", "--json")
    data = json.loads(done.out)
    assert data["ok"] == (done.code == 0)
    return done.code, {each["what"]: each for each in data["checks"]}


def test_where_all_is_there(mindc: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    without(monkeypatch)
    code, found = said(mindc)
    assert code == 0
    assert found["numpy"] == {"what": "numpy", "state": "ok", "seen": version("numpy"), "mend": ""}
    text = mindc("doctor")
    assert (text.code, text.err) == (0, "all that is needed is there\n")
    assert text.out.count("\n") >= len(found)


@pytest.mark.parametrize(("there", "seen"), [("", "not installed"), ("0.70.1", "0.70.1, and <0.69,>=0.63 is needed")])
def test_what_is_needed_and_missing(mindc: Call, monkeypatch: pytest.MonkeyPatch, there: str, seen: str) -> None:
    without(monkeypatch, *([] if there else ["numba"]), numba=there)
    code, found = said(mindc)
    assert code == 1
    assert found["numba"]["state"] == "wrong"
    assert found["numba"]["seen"] == seen
    assert found["numba"]["mend"] == "pip install 'numba<0.69,>=0.63'"
    text = mindc("doctor")
    assert text.code == 1
    assert "NOT  numba " in text.out
    assert text.err == "1 to be mended\n"


def test_an_extra_that_is_absent_is_neither_ok_nor_wrong(mindc: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    without(monkeypatch, "matplotlib")
    code, found = said(mindc)
    assert code == 0
    assert found["[plot]"]["state"] == "absent"
    assert found["[plot]"]["mend"] == "pip install 'mindlang[plot]'"


def test_a_cache_that_cannot_be_written(mindc: Call, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(cache, "folder", lambda: tmp_path)
    code, found = said(mindc)
    assert code == 1
    assert "no folder can be written" in found["compiler cache"]["seen"]


def test_a_cold_cache_is_absent(mindc: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "is_native", lambda *_: False)
    monkeypatch.setattr(cache, "missing", lambda units: [*units])
    code, found = said(mindc)
    assert (code, found["simulator"]["state"]) == (0, "absent")
    assert found["simulator"]["mend"] == "mindc warmup"


def test_the_physics_is_that_of_pymunk() -> None:
    physics_check.world().compile()
    assert [physics_check.differing_tick(seed) for seed in range(5)] == [0] * 5
    assert [each.state for each in diagnosis.physics()] == ["ok"]


def test_physics_that_another_machine_computes_otherwise(monkeypatch: pytest.MonkeyPatch) -> None:
    physics_check.world().compile()
    monkeypatch.setattr(physics_check, "REST_SPEED", 2e-3)  # so pymunk does
    (found,) = diagnosis.physics()
    assert found.state == "wrong"
    assert "from tick 512 on" in found.seen


def test_physics_that_is_not_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "missing", lambda units: units)
    (found,) = diagnosis.physics()
    assert (found.state, found.mend) == ("absent", "mindc warmup")


def test_a_check_that_fails_hides_no_other(mindc: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    def packages() -> list[DoctorFinding]:
        raise ImportError("numba: undefined symbol\nand more")

    monkeypatch.setattr(diagnosis, "CHECKS", [packages, diagnosis.browser])
    code, found = said(mindc)
    assert code == 1
    assert found["packages"]["seen"] == "ImportError: numba: undefined symbol"
    assert "browser" in found


def test_programs_of_two_versions(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindrun.VERSION", "0.0.9")
    assert [each.state for each in diagnosis.programs()] == ["ok", "wrong"]


def test_little_memory_and_an_old_python(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("mindlang.limits.available", lambda: 100 << 20)
    assert [each.seen for each in diagnosis.machine() if each.state == "wrong"] == ["100 MiB free"]
    monkeypatch.setattr("platform.python_version", lambda: "3.10.2")
    assert [each.state for each in diagnosis.python()] == ["wrong"]


def test_no_browser(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.setattr("webbrowser._tryorder", [])
    monkeypatch.setattr("webbrowser._browsers", {})
    assert [each.state for each in diagnosis.browser()] == ["absent"]


def test_on_a_robot_nothing_that_is_absent_is_ok(
    capsysbinary: pytest.CaptureFixture[bytes], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(doctor, "find_spec", lambda name: None if name == "lgpio" else object())
    monkeypatch.setattr(doctor, "Path", lambda _: Path("/nowhere"))
    assert doctor.run(tool_parser("doctor").parse_args(["--json"])) == 0
    found = {each["what"]: each["state"] for each in json.loads(capsysbinary.readouterr().out)["checks"]}
    assert found["lgpio"] == "absent"
    assert found["/nowhere/video0"] == "absent"
    assert found["numpy"] == "ok"
