"""Kinds of one's own, as the guide shows them: two packages that are installed by hand, and what the language says."""

import importlib
import re
import sys
import tomllib
from collections import defaultdict
from collections.abc import Callable, Iterator
from pathlib import Path
from shutil import rmtree
from typing import Any

import numpy as np
import pytest
from mindrun.errors import BundleError, ProcedureError
from mindrun.graph.bundle import read_bundle
from mindrun.kinds import packages, registry
from mindrun.kinds.functions.array_function import ArrayFunction
from mindrun.kinds.functions.function import Width
from mindrun.kinds.registry import kind, kinds, refused_packages

from mindlang.explaining import article, collection
from mindlang.explaining import kinds as explained
from mindlang.testing import check_kind
from tests.calling import Call
from tests.pages.transcript import Write, steps
from tests.project.sources import ROOT

PAGE = ROOT / "docs" / "guides" / "own-kinds.md"
FILES = {step.path: step.text for step in steps(PAGE.read_text(encoding="utf-8")) if isinstance(step, Write)}
PROJECT = tomllib.loads(FILES["pyproject.toml"])["project"]
Install = Callable[[str, str, str, str], None]


@pytest.fixture
def install(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Install]:
    """What installs a package (name, version, module, text), and takes the place of one of that module."""
    site, before = tmp_path / "site", {*sys.modules}
    monkeypatch.syspath_prepend(str(site))
    for noun in registry.ROOMS:
        kinds(noun)  # here, and not while they would be forgotten
    known = {noun: {**found} for noun, found in registry._kinds.items()}

    def forget() -> None:
        importlib.invalidate_caches()
        for each in (packages.entries, *vars(article).values(), *vars(explained).values(), *vars(collection).values()):
            if hasattr(each, "cache_clear"):
                each.cache_clear()
        monkeypatch.setattr(registry, "_kinds", defaultdict(dict, {noun: {**found} for noun, found in known.items()}))
        monkeypatch.setattr(registry, "_brought", {})
        monkeypatch.setattr(registry, "_refused", {})
        for name in [name for name in sys.modules if name in {f"{path.stem}" for path in site.glob("*.py")} - before]:
            del sys.modules[name]

    def install(name: str, version: str, module: str, text: str) -> None:
        for old in site.glob(f"{module}-*"):
            rmtree(old)
        info = site / f"{module}-{version}.dist-info"
        info.mkdir(parents=True, exist_ok=True)
        (info / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")
        (info / "entry_points.txt").write_text(f"[{packages.KINDS}]\n{module.partition('_')[0]} = {module}\n")
        (site / f"{module}.py").write_text(text)
        forget()

    yield install
    forget()


@pytest.fixture
def lab(install: Install) -> Install:
    """The guide's packages, installed."""
    assert PROJECT["entry-points"][packages.KINDS] == {"lab": "lab_kinds"}
    install(PROJECT["name"], PROJECT["version"], "lab_kinds", FILES["lab_kinds.py"])
    install("fast-kinds", "0.2", "fast_kinds", FILES["fast_kinds.py"])
    return install


@pytest.fixture
def roam(tmp_path: Path) -> Path:
    path = tmp_path / "roam.mind"
    path.write_text(FILES["roam.mind"])
    return path


@pytest.mark.usefixtures("lab")
@pytest.mark.parametrize("name", ["lab.spiking", "fast.rectified"])
def test_the_kinds_of_the_guide_hold(name: str) -> None:
    check_kind(kinds("skill")[name], rows=1500)


@pytest.mark.slow
def test_the_test_of_the_guide_passes(lab: Install) -> None:
    lab("lab-tests", "0.1", "test_lab_kinds", FILES["test_lab_kinds.py"])
    importlib.import_module("test_lab_kinds").test_spiking()


@pytest.mark.slow
@pytest.mark.usefixtures("lab")
@pytest.mark.parametrize("name", ["fast.rectified", "mlp", "elman", "gru"])
def test_functions_hold_in_ten_thousand_rows(name: str) -> None:
    check_kind(kinds("skill")[name](width=4))


class Sums(ArrayFunction):
    """Sums of the inputs, which tests break."""

    __slots__ = ()
    width: Width = 3

    def matrix_shapes(self, inputs: int, outputs: int) -> Any:
        return ((inputs, outputs),) if inputs and outputs else ()

    def apply(self, x: Any, w: Any, state: Any) -> Any:
        return (w[0] * x[:, None, :]).sum(axis=2), state


CALLS: list[int] = []


def others(self: Any, x: Any, w: Any, state: Any) -> Any:
    return Sums.apply(self, x - x.mean(axis=0), w, state)


def remembering(self: Any, x: Any, w: Any, state: Any) -> Any:
    CALLS.append(1)
    return Sums.apply(self, x, w, state)[0] * np.float32(len(CALLS)), state


def unordered(self: Any, weights: Any, inputs: Any, outputs: Any) -> Any:
    return weights


def too_few(self: Any, x: Any, w: Any, state: Any) -> Any:
    return x[:, :1], state


def writing(self: Any, x: Any, w: Any, state: Any) -> Any:
    x[:] = 0
    return Sums.apply(self, x, w, state)


@pytest.mark.parametrize(
    ("broken", "said"),
    [
        ({}, ""),
        ({"apply": others}, "test.sums: a run depends on those beside it: apply each row by itself"),
        ({"apply": remembering}, "test.sums with 1 inputs: the simulator commands "),
        ({"reordered": unordered}, "test.sums: with another order of its lines it gives "),
        ({"apply": too_few}, "test.sums gives outputs of the shape (1, 1) instead of (1, 3)"),
        ({"apply": writing}, "ValueError: assignment destination is read-only"),
    ],
    ids=["sound", "others", "remembering", "unordered", "too few", "writing"],
)
@pytest.mark.usefixtures("lab")
def test_the_kit_finds_what_is_broken(broken: dict[str, Any], said: str) -> None:
    own = kind("skill", "test.sums")(type("Sums", (Sums,), {"__module__": __name__, **broken}))
    if not said:
        check_kind(own, rows=400)
        return
    with pytest.raises((AssertionError, ProcedureError), match=re.escape(said)):
        check_kind(own, rows=400)


@pytest.mark.parametrize("name", ["lab.spiking", "fast.rectified"])
def test_it_is_taught_locked_built_and_run(mindc: Call, lab: Install, roam: Path, name: str) -> None:
    roam.write_text(roam.read_text().replace("lab.spiking", name))
    assert (mindc("fmt", roam, "--check").code, mindc("check", roam).code) == (0, 0)
    taught = mindc("train", roam, "--seed", 1)
    assert taught.code == 0, taught.err
    assert mindc("status", roam).out.startswith("Roam  trained ")
    assert mindc("bench", roam, "--task", "Roam").code == 0
    bundle = roam.with_suffix(".bundle")
    assert mindc("build", roam, "-o", bundle).code == 0
    assert read_bundle(bundle).graph.skills[0].function == kinds("skill")[name](width=5)
    if name == "fast.rectified":
        return
    for version, text, said in (
        ("0.1", FILES["lab_kinds.py"] + "\n", "the code of lab-kinds 0.1 is not that with which this bundle was built"),
        ("0.3", FILES["lab_kinds.py"], "this mind needs lab-kinds 0.1, and lab-kinds 0.3 is installed"),
    ):
        lab("lab-kinds", version, "lab_kinds", text)
        with pytest.raises(BundleError, match=said):
            read_bundle(bundle)
    assert "Roam has changed: of lab-kinds 0.1, now of lab-kinds 0.3" in mindc("status", roam).out
    lab("lab-other", "0.1", "lab_kinds", "")
    with pytest.raises(BundleError, match=r"lab-kinds 0.1, which is not installed: pip install 'lab-kinds==0.1'"):
        read_bundle(bundle)
    said = mindc("check", roam).err
    assert "There is no kind of skill called lab.spiking." in said
    assert "A kind with a dot is brought by a package" in said


@pytest.mark.parametrize(
    ("before", "after", "why"),
    [
        ("import numpy", "import nosuch", "ModuleNotFoundError: No module named 'nosuch'"),
        ("lab.spiking", "Spiking", "ValueError: Spiking is no name with a dot, such as lab.spiking"),
        ("lab.spiking", "gru", "ValueError: gru is no name with a dot"),
        ("lab.spiking", "fast.rectified", "ValueError: fast_kinds has a kind fast.rectified, too"),
        ('"skill"', '"sensor"', "ValueError: lab.spiking is no function of a skill"),
        ("keeps: Ratio", "keeps: float", "TypeError: <class 'float'> does not say what an argument means"),
        ("import numpy as np", "raise SystemExit", "SystemExit: SystemExit"),
    ],
)
def test_a_package_that_cannot_be_is_left_out(
    mindc: Call, lab: Install, roam: Path, before: str, after: str, why: str
) -> None:
    lab("lab-kinds", "0.1", "lab_kinds", FILES["lab_kinds.py"].replace(before, after))
    assert [name for name in kinds("skill") if "." in name or not name.islower()] == ["fast.rectified"]
    assert [*refused_packages()] == ["lab-kinds 0.1"]
    assert refused_packages()["lab-kinds 0.1"].startswith(why)
    assert f"lab-kinds 0.1 has kinds that cannot be used: {why}" in " ".join(mindc("check", roam).err.split())
    assert kinds("skill")["gru"].__module__ == "mindrun.kinds.functions.gru"
    assert "lab.spiking" not in kinds("sensor")


@pytest.mark.usefixtures("lab")
def test_it_is_explained(mindc: Call) -> None:
    said = mindc("explain", "lab.spiking").out
    assert said.startswith("lab.spiking (kind of skill, of lab-kinds 0.1)\nNeurons that leak, and fire where they")
    assert "keeps         a share between 0 and 1" in said
