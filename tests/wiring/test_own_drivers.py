"""Drivers of one's own: built with a bundle and named there by their hash, run on a robot and by nobody who reads."""

import json
import subprocess
import sys
from dataclasses import replace
from hashlib import sha256
from math import inf
from pathlib import Path
from shutil import copy
from textwrap import dedent
from types import SimpleNamespace

import pytest
from mindrun.cli.doctor import wired
from mindrun.driver import DeviceError
from mindrun.errors import BundleError
from mindrun.graph.bundle import Bundle, fingerprint, pack, read_bundle, unpack
from mindrun.graph.describe import describe
from mindrun.robot.drivers.own import OwnActuator, OwnSensor
from mindrun.robot.guardian.plan import plan_of, to_json
from mindrun.robot.sensing import Sampler

from mindlang.cli import commands
from mindlang.robot import driver
from mindlang.robot.deployment import make_release
from mindlang.robot.driver_inspection import UnfitDriverError, timing_of
from tests.calling import Call, write_rules
from tests.project.sources import ROOT

ROBOT = """robot: desk
sensors:
  ball_bearing:
    driver: mock
  feeler:
    driver: {sensor}
actuators:
  left_wheel:
    driver: {actuator}
  right_wheel:
    driver: mock
"""
FILE = '''"""Drivers that tell where they were imported."""

from dataclasses import dataclass
from pathlib import Path

with Path("{log}").open("a") as log:
    log.write("imported ")


@dataclass(frozen=True)
class Wires:
    values: tuple[float, ...]

    def read(self):
        return self.values

    def write(self, value):
        print("told", value)

    def close(self):
        raise RuntimeError("closing fails")


@dataclass(frozen=True)
class Feelers:
    pins: tuple[int, ...] = (1, 2, 3)
    gain: float = 0.5
    wide: bool = False

    unit = "m"
    possible = (0.0, float("inf"))
    usual = (0.0, 2.0)

    @property
    def readings(self):
        return len(self.pins)

    def open(self):
        return Wires(tuple(pin * self.gain for pin in self.pins))


@dataclass(frozen=True)
class Wheel:
    device: str = "/dev/ttyUSB0"

    def open(self):
        return Wires(())
'''


@pytest.fixture(scope="module")
def desk(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the small mind, wired to drivers of a file beside its robot.yaml, and built."""
    folder = tmp_path_factory.mktemp("desk")
    rules = write_rules(folder)
    (folder / "own.py").write_text(FILE.format(log=folder / "log.txt"))
    (folder / "robot.yaml").write_text(ROBOT.format(sensor="own.Feelers\n    gain: 0.25", actuator="own.Wheel"))
    words = ["build", rules, "--robot", folder / "robot.yaml", "-o", folder / "a.bundle"]
    commands.main([str(word) for word in words], standalone_mode=False)
    return folder


@pytest.fixture
def log(desk: Path) -> Path:
    """What `own.py` writes when it is run."""
    (desk / "log.txt").unlink(missing_ok=True)
    return desk / "log.txt"


@pytest.fixture
def built(desk: Path, rules: Path, log: Path) -> Path:
    """The bundle of the folder, in one of its own."""
    for name in ("own.py", "robot.yaml", "a.bundle"):
        copy(desk / name, rules.parent)
    return rules.with_name("a.bundle")


def build(mindc: Call, rules: Path, robot: str):
    path = rules.with_name("robot.yaml")
    path.write_text(robot, encoding="utf-8")
    return mindc("build", rules, "--robot", path, "-o", rules.with_name("a.bundle"), "--json")


def own_of(path: Path) -> tuple[OwnSensor, OwnActuator]:
    wiring = read_bundle(path).wiring
    assert wiring
    sensor, actuator = wiring.sensors[1].driver, wiring.actuators[0].driver
    assert isinstance(sensor, OwnSensor)
    assert isinstance(actuator, OwnActuator)
    return sensor, actuator


def test_the_bundle_has_the_text_and_its_hash(built: Path, log: Path) -> None:
    sensor, actuator = own_of(built)
    text = built.with_name("own.py").read_bytes()
    assert sensor.digest == actuator.digest == sha256(text).hexdigest()
    assert (sensor.name, sensor.readings, sensor.unit, sensor.usual, sensor.near) == ("own.Feelers", 3, "m", (0, 2), 0)
    assert actuator.device == "/dev/ttyUSB0"
    assert f"driver own.Feelers is the user's own, {sensor.digest[:12]}" in describe(read_bundle(built))
    assert not log.exists()


def test_it_does_what_it_is_told_where_it_is_opened(built: Path, capsys: pytest.CaptureFixture[str]) -> None:
    sensor, actuator = own_of(built)
    assert sensor.open().read() == (0.25, 0.5, 0.75)
    assert sensor.motionless.open().read() == (0.25, 0.5, 0.75)
    device = actuator.open()
    device.write(0.75)
    with pytest.raises(DeviceError, match="was not sent"):
        device.write(float("nan"))
    device.close()
    assert capsys.readouterr().out == "told 0.75\n"


def test_nothing_that_reads_runs_it(built: Path, rules: Path, mindc: Call, tmp_path: Path) -> None:
    log = tmp_path / "log.txt"
    built.with_name("own.py").write_text(FILE.format(log=log))  # which this process has not imported
    assert build(mindc, rules, rules.with_name("robot.yaml").read_text()).code == 0
    log.unlink()
    for words in (["check"], ["lint"], ["show"], ["status"], ["fmt", "--check"]):
        mindc(words[0], rules, *words[1:])
    bundle = read_bundle(built)
    assert unpack(pack(bundle)).wiring == bundle.wiring
    assert bundle.wiring
    describe(bundle)
    fingerprint(bundle.wiring)
    folder = tmp_path / "release"
    folder.mkdir()
    make_release(built, bundle, folder)
    subprocess.run([sys.executable, "-m", "mindrun", str(built), "--describe"], check=True, capture_output=True)
    assert not log.exists()
    assert json.loads((folder / "release.json").read_text())["drivers"].keys() == {"own.Feelers", "own.Wheel"}
    own_of(built)[0].open()
    assert log.read_text() == "imported "
    own_of(built)[1].open()
    assert log.read_text() == "imported ", "one file is one module in a process"


def test_doctor_names_it(built: Path) -> None:
    bundle = read_bundle(built)
    assert bundle.wiring
    said = {check.what: check.words for check in wired(bundle.wiring, bundle.graph)}
    assert said["feeler"] == "own.Feelers reads 0.25 0.5 0.75 m"
    assert said["left_wheel"] == "own.Wheel, left alone"


def test_the_guardian_opens_it_without_numpy(built: Path) -> None:
    bundle = read_bundle(built)
    assert bundle.wiring
    plan = to_json(plan_of(bundle.graph.tick, {"left_wheel": 0.5, "right_wheel": 0.5}, bundle.wiring))
    program = """
    import sys
    from mindrun.robot.guardian.plan import from_json
    from_json(sys.stdin.readline()).channels[0].driver.open().write(1.0)
    assert "numpy" not in sys.modules
    """
    done = subprocess.run([sys.executable, "-c", dedent(program)], input=plan, capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("told 1.0\n", "")


def test_a_text_that_its_hash_does_not_name_is_refused(built: Path) -> None:
    bundle = read_bundle(built)
    assert bundle.wiring
    wires = [*bundle.wiring.sensors]
    forged = object.__new__(OwnSensor)
    for name in OwnSensor.__dataclass_fields__:
        object.__setattr__(forged, name, getattr(wires[1].driver, name))
    object.__setattr__(forged, "lines", (*forged.lines, "import os"))
    wires[1] = replace(wires[1], driver=forged)
    wiring = replace(bundle.wiring, sensors=tuple(wires))
    with pytest.raises(BundleError, match="its text is not the one that its hash names"):
        unpack(pack(Bundle(bundle.policy, bundle.procedures, wiring)))


def test_the_same_file_is_the_same_bundle_and_another_is_another(built: Path, mindc: Call, rules: Path) -> None:
    first, robot = built.read_bytes(), rules.with_name("robot.yaml").read_text()
    assert build(mindc, rules, robot).code == 0
    assert built.read_bytes() == first
    path = rules.with_name("own.py")
    path.write_text(path.read_text() + "# another line\n")
    assert build(mindc, rules, robot).code == 0
    assert built.read_bytes() != first


def test_a_file_that_hangs_is_told_on_its_line(
    mindc: Call, rules: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(driver, "ANSWER_SECONDS", 1.0)
    (tmp_path / "slow.py").write_text("while True:\n    pass\n")
    said = build(mindc, rules, ROBOT.format(sensor="slow.Feelers", actuator="mock"))
    assert said.code == 1
    assert "robot.yaml:6:13: error: slow.py has not been imported after 1 s. [broken-driver]" in said.err


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("def broken(:\n", "bad.py cannot be imported: line 1: SyntaxError: invalid syntax"),
        ("import nowhere_at_all\n", "line 1: ModuleNotFoundError: No module named 'nowhere_at_all'"),
        ("\n\nraise SystemExit(0)\n", "line 3: SystemExit: 0"),
        ("", "bad.py has no class Feelers"),
        ("def Feelers(): pass\n", "bad.Feelers is no frozen dataclass"),
        ("x = '" + "a" * 40_000 + "'\n", "bad.py is larger than 32 kB"),
    ],
)
def test_a_file_that_is_wrong_is_told_on_its_line(mindc: Call, rules: Path, text: str, why: str) -> None:
    rules.with_name("bad.py").write_text(text)
    said = build(mindc, rules, ROBOT.format(sensor="bad.Feelers", actuator="mock"))
    assert said.code == 1
    assert "robot.yaml:6:13: error: " in said.err
    assert why in " ".join(said.err.split())
    assert said.err.count("error:") == 1


@pytest.mark.parametrize(
    ("said", "kind", "told"),
    [
        ("seconds = 0.06", "warning", "One measurement takes 60 ms here"),
        ("most = 1.5", "warning", "It is to read up to 2 m, and measures 1.5 m at most"),
        ("bus_seconds, bus = 0.06, 3", "warning", "In each second feeler needs 1.2 s of I2C bus 3"),
        ("seconds, most, bus_seconds, queue = 0.05, inf, 0, 'a chip'", "", ""),
        ("seconds = nan", "error", "own.Feelers has seconds that are no number from 0: nan"),
        ("seconds = property(lambda self: self.nothing)", "error", "has no attribute 'nothing'"),
    ],
)
def test_it_is_asked_for_its_timing(
    mindc: Call, rules: Path, tmp_path: Path, log: Path, said: str, kind: str, told: str
) -> None:
    text = FILE.format(log=log).replace('unit = "m"', f'unit = "m"\n    {said}')
    (tmp_path / "own.py").write_text(text.replace("from pathlib", "from math import inf, nan\nfrom pathlib", 1))
    err = " ".join(build(mindc, rules, ROBOT.format(sensor="own.Feelers", actuator="mock")).err.split())
    assert [word for word in ("error", "warning") for _ in range(err.count(f"{word}:"))] == [kind] * bool(kind)
    assert told in err


@pytest.mark.parametrize(
    ("said", "told"),
    [
        ({"seconds": inf}, "has seconds that are no number from 0: inf"),
        ({"most": "much"}, "has most that is no number from 0: 'much'"),
        ({"bus_seconds": -1}, "has bus_seconds that are no number from 0: -1"),
        ({"seconds": True}, "has seconds that are no number from 0: True"),
        ({"bus_seconds": 0.01}, "has bus_seconds, and no bus that is a whole number from 0 to 99"),
        ({"queue": 3}, "has a queue that is no text"),
    ],
)
def test_a_timing_that_cannot_be_is_refused(said: dict[str, object], told: str) -> None:
    with pytest.raises(UnfitDriverError) as refused:
        timing_of(SimpleNamespace(**said), "sensor")
    assert str(refused.value) == told


def test_a_folder_of_that_name_is_told_on_its_line(mindc: Call, rules: Path) -> None:
    rules.with_name("bad.py").mkdir()
    said = build(mindc, rules, ROBOT.format(sensor="bad.Feelers", actuator="mock"))
    assert (said.code, said.err.count("error:")) == (1, 1)
    assert "robot.yaml:6:13: error: bad.py cannot be read: it is a folder. [broken-driver]" in said.err


def test_what_fails_on_the_robot_is_a_fault_with_its_name(built: Path) -> None:
    wiring = read_bundle(built).wiring
    assert wiring
    wire = wiring.sensors[1]
    assert isinstance(wire.driver, OwnSensor)
    text = "import only_at_the_desk"
    driver = replace(wire.driver, lines=(text,), digest=sha256(text.encode()).hexdigest())
    sample = Sampler(replace(wire, driver=driver)).measured_once()
    assert sample.fault.startswith("the driver own.Feelers does not run: ModuleNotFoundError")


def test_a_range_finder_wired_to_one_that_reads_the_other_way_round_is_a_warning(
    mindc: Call, rules: Path, tmp_path: Path, log: Path
) -> None:
    (tmp_path / "own.py").write_text(FILE.format(log=log).replace("usual = (0.0, 2.0)", "usual = (2.0, 0.0)"))
    said = build(mindc, rules, ROBOT.format(sensor="own.Feelers", actuator="mock"))
    assert said.code == 0
    assert "robot.yaml:6:13: warning" in said.err
    assert "[reads-backwards]" in said.err


@pytest.fixture
def installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, log: Path) -> Path:
    """The folder of an installed package with the same drivers."""
    site = tmp_path / "site"
    info = site / "acme_robots-1.2.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: acme-robots\nVersion: 1.2\n")
    entries = "[mindrun.drivers]\nFeelers = acme_parts.wires:Feelers\nWheel = acme_parts.wires:Wheel\n"
    (info / "entry_points.txt").write_text(entries)
    package = site / "acme_parts"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "wires.py").write_text(FILE.format(log=log))
    monkeypatch.syspath_prepend(str(site))
    yield package
    for name in [name for name in sys.modules if name.startswith("acme_parts")]:
        del sys.modules[name]


def test_a_package_is_named_by_version_and_hash(mindc: Call, rules: Path, installed: Path, log: Path) -> None:
    robot = ROBOT.format(sensor="acme_robots.Feelers", actuator="acme_robots.Wheel")
    said = build(mindc, rules, robot)
    assert said.code == 0, said.err
    log.unlink()
    sensor, actuator = own_of(rules.with_name("a.bundle"))
    assert (sensor.package, sensor.lines) == ("acme-robots 1.2", ())
    assert json.loads(said.out)["drivers"] == {"acme_robots.Feelers": sensor.digest, "acme_robots.Wheel": sensor.digest}
    assert not log.exists()
    assert sensor.open().read() == (0.5, 1.0, 1.5)
    assert log.exists()
    (installed / "more.py").write_text("")
    with pytest.raises(DeviceError, match=r"its code is not that of acme-robots 1\.2 in the bundle"):
        actuator.open()


def test_a_package_that_is_not_on_the_robot_says_what_to_install(mindc: Call, rules: Path, installed: Path) -> None:
    assert build(mindc, rules, ROBOT.format(sensor="acme_robots.Feelers", actuator="acme_robots.Wheel")).code == 0
    sensor, _ = own_of(rules.with_name("a.bundle"))
    with pytest.raises(DeviceError, match="acme-robots 9 is not installed") as caught:
        replace(sensor, name="acme_other.Feelers", package="acme-robots 9").open()
    assert caught.value.hint == "pip install 'acme-robots==9'"


def test_a_file_comes_before_a_package(mindc: Call, rules: Path, installed: Path, log: Path) -> None:
    rules.with_name("acme_robots.py").write_text(FILE.format(log=log))
    assert build(mindc, rules, ROBOT.format(sensor="acme_robots.Feelers", actuator="acme_robots.Wheel")).code == 0
    assert own_of(rules.with_name("a.bundle"))[0].package == ""


def test_the_example_of_the_documentation_is_whole(mindc: Call, rules: Path, tmp_path: Path) -> None:
    page = (ROOT / "docs" / "robot-yaml.md").read_text(encoding="utf-8")
    text = page.partition("```python heat.py\n")[2].partition("```")[0]
    (tmp_path / "heat.py").write_text(text)
    (tmp_path / "temperature").write_text("51500\n")
    rules.write_text(rules.read_text().replace("range_finder at 0 30 330 deg", "battery"))
    sensor = f"heat.Heat\n    path: {tmp_path / 'temperature'}\n    from: 40 °C"
    said = build(mindc, rules, ROBOT.format(sensor=sensor, actuator="mock"))
    assert said.code == 0, said.err
    wiring = read_bundle(tmp_path / "a.bundle").wiring
    assert wiring
    wire = wiring.sensors[1]
    assert (wire.low, wire.high, wire.driver.open().read()) == (40.0, 80.0, (51.5,))
    (tmp_path / "temperature").unlink()
    with pytest.raises(DeviceError, match="the temperature cannot be read"):
        wire.driver.open().read()
