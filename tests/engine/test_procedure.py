"""Procedures: Python functions inside a mind, and all they can do wrong."""

from dataclasses import replace
from pathlib import Path

import pytest
from mindrun.engine.engine import Engine, procedure_sources
from mindrun.errors import BundleError, ProcedureError
from mindrun.graph.bundle import Bundle, pack, unpack
from mindrun.graph.policy import Policy
from mindrun.kinds.functions.procedure import Procedure, used_file

from tests.minds import mind, skill


def engine(folder: Path, text: str, name: str = "claw.grip", outputs: int = 2) -> Engine:
    """An engine whose only skill is a procedure of a module with this text."""
    (folder / "claw.py").write_text(text)
    targets = [("actuator", i) for i in range(outputs)]
    return Engine(Policy(mind(skill("Go", Procedure(name), (0, 1), *targets), readings=2), {}), folder)


def test_one_float_per_reading_in_one_per_output_out(tmp_path: Path) -> None:
    text = "def grip(near, held):\n    assert type(near) is float\n    return near - held, held"
    assert engine(tmp_path, text).tick([1.0, 0.25]).tolist() == [0.75, 0.25]


def test_a_single_output_needs_no_tuple(tmp_path: Path) -> None:
    assert engine(tmp_path, "def grip(a, b): return a / 4", outputs=1).tick([1.0, 0.0]).tolist() == [0.25, 0.5]


def test_what_a_module_remembers_is_of_one_run(tmp_path: Path) -> None:
    """As in the simulated world, where every run has a module of its own; no module is run again for nothing."""
    (tmp_path / "runs").write_text("")
    text = f"open({str(tmp_path / 'runs')!r}, 'a').write('x')\nSEEN = []\n"
    text += "def grip(a, b):\n    SEEN.append(a)\n    return len(SEEN) / 8"
    running = engine(tmp_path, text, outputs=1)
    for begun in (1, 2, 3):
        assert [running.tick([0.0, 0.0])[0] for _ in range(3)] == [0.125, 0.25, 0.375]
        assert len((tmp_path / "runs").read_text()) == begun
        running.reset()
        running.reset()


def test_an_engine_that_is_given_no_modules_says_which_it_lacks() -> None:
    with pytest.raises(ProcedureError, match="claw"):
        Engine(Policy(mind(skill("Go", Procedure("claw.grip"), (0,), ("actuator", 0))), {}))


def test_modules_stand_in_folders(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "arm.py").write_text("def up(a, b): return [a, b]")
    assert engine(tmp_path, "", "parts.arm.up").tick([1.0, 0.0]).tolist() == [1.0, 0.0]


def test_what_is_not_finite_is_not_sent(tmp_path: Path) -> None:
    running = engine(tmp_path, "def grip(a, b): return float('nan'), 1e300")
    assert running.tick([0.0, 0.0]).tolist() == [0.5, 0.5]
    assert running.faults == 2


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("def grip(a, b): return 1", "returned 1 values instead of 2"),
        ("def grip(a, b): return 'x', 'y'", "'x' is no number"),
        ("def grip(a, b): return [None][0]", "fails"),
        ("def grip(a, b): return a / b, 1", "ZeroDivisionError"),
        ("import sys\ndef grip(a, b): return sys.exit(0)", "SystemExit"),
    ],
)
def test_a_call_that_fails_says_so(tmp_path: Path, text: str, message: str) -> None:
    running = engine(tmp_path, text)
    with pytest.raises(ProcedureError, match=message):
        running.tick([0.0, 0.0])


@pytest.mark.parametrize(
    ("text", "name", "message"),
    [
        ("def grip(: pass", "claw.grip", "SyntaxError"),
        ("raise SystemExit\ndef grip(a, b): return a, b", "claw.grip", "its module fails"),
        ("", "claw.grip", "has no such function"),
        ("grip = 3", "claw.grip", "has no such function"),
        ("", "paw.grip", "cannot read"),
        ("", "grip", "write it as module.function"),
        ("", "..claw.grip", "write it as module.function"),
        ("", "os/path.join", "write it as module.function"),
    ],
)
def test_a_module_that_fails_says_so(tmp_path: Path, text: str, name: str, message: str) -> None:
    with pytest.raises(ProcedureError, match=message):
        engine(tmp_path, text, name)


def test_a_link_does_not_lead_out(tmp_path: Path) -> None:
    inside = tmp_path / "inside"
    inside.mkdir()
    (tmp_path / "secret.py").write_text("def f(a, b): return 1, 1")
    (inside / "claw.py").symlink_to(tmp_path / "secret.py")
    with pytest.raises(ProcedureError, match="lies outside"):
        Engine(Policy(mind(skill("Go", Procedure("claw.f"), (0,), ("actuator", 0))), {}), inside)


def test_the_procedures_of_a_mind_are_those_below_its_master(tmp_path: Path) -> None:
    for name in ("claw", "arm"):
        (tmp_path / f"{name}.py").write_text(f"def grip(a): return a  # {name}\n")
    both = mind(skill("Go", Procedure("claw.grip"), (0,), ("skill", 1)), skill("On", Procedure("arm.grip"), (0,)))
    assert set(procedure_sources(both, tmp_path)) == {"claw", "arm"}
    assert procedure_sources(both, tmp_path, "On") == {"arm": "def grip(a): return a  # arm\n"}


def test_a_procedure_has_its_files_beside_it_wherever_it_runs(tmp_path: Path) -> None:
    text = "from pathlib import Path\nGAIN = float((Path(__file__).parent / 'models' / 'gain').read_text())\n"
    text += "def grip(a, b): return GAIN * a"
    (tmp_path / "claw.py").write_text(text)
    (tmp_path / "models").mkdir()
    (tmp_path / "models" / "gain").write_bytes(b"0.25")
    go = replace(skill("Go", Procedure("claw.grip"), (0, 1), ("actuator", 0)), files=("models/gain",))
    policy = Policy(mind(go, readings=2), {})
    sources = procedure_sources(policy.graph, tmp_path)
    assert set(sources) == {"claw", "files/models/gain"}
    data = pack(Bundle(policy, sources))
    (tmp_path / "models" / "gain").unlink()
    back = unpack(data)
    assert pack(back) == data
    assert Engine(back.policy, back.procedures).tick([1.0, 0.0]).tolist() == [0.25, 0.5]
    with pytest.raises(ProcedureError, match="models/gain"):
        procedure_sources(policy.graph, tmp_path)
    without = Bundle(Policy(mind(replace(go, files=()), readings=2), {}), back.procedures)
    with pytest.raises(BundleError, match="files that no procedure"):
        unpack(pack(without))


@pytest.mark.parametrize("name", ["/etc/passwd", "../gain", "a/../gain", "./gain", "", "a//b", "a\nb"])
def test_no_file_outside_of_the_folder_is_used(tmp_path: Path, name: str) -> None:
    (tmp_path / "gain").write_text("1")
    with pytest.raises(ProcedureError, match="outside"):
        used_file("claw.grip", name, tmp_path)


def test_no_link_leads_outside(tmp_path: Path) -> None:
    (tmp_path / "mind").mkdir()
    (tmp_path / "gain").write_text("1")
    (tmp_path / "mind" / "gain").symlink_to(tmp_path / "gain")
    with pytest.raises(ProcedureError, match="outside"):
        used_file("claw.grip", "gain", tmp_path / "mind")
