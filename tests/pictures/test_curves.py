"""`mindc plot`: the curves carry what the log says, the bytes repeat, and whatever is wrong ends in one message."""

import gzip
import json
import sys
from itertools import accumulate
from pathlib import Path
from shutil import copy
from xml.etree import ElementTree

import pytest
from matplotlib.axes import Axes
from mindrun.train.progress import read_progress
from mindrun.train.run_folder import RunFolder, create
from mindrun.train.training import train

from mindlang.pictures.curves import figure, image
from mindlang.pictures.learning_log import along_ticks, load_curves
from tests.calling import Call
from tests.train.climbing import Sphere, lesson, manifest, unwatched

GENERATIONS, ATTEMPTS = 12, 3
RARELY = 1e9  # seconds between two checkpoints
LOG = "attempt,generation,best,reevaluated,verdict\n1,1,3.5,2.0,\n1,2,-inf,,\n1,3,nan,,\n1,4,5.5,4.0,3.75\n2,1,1.0,,\n"


@pytest.fixture
def run(tmp_path: Path) -> RunFolder:
    """A run that has not begun, of three attempts."""
    return create(tmp_path / "runs", manifest(lesson(GENERATIONS, attempts=ATTEMPTS)), {}, {})


@pytest.fixture
def table(tmp_path: Path) -> Path:
    """A log as somebody kept it."""
    path = tmp_path / "Climb.csv"
    path.write_text(LOG)
    return path


def lines(axes: Axes) -> dict[str, list[tuple[float, float]]]:
    """The points of each line of a panel, by what it shows of which attempt."""
    return {str(line.get_label()): [(float(x), float(y)) for x, y in line.get_xydata()] for line in axes.get_lines()}


def test_the_lines_are_what_the_log_says(run: RunFolder) -> None:
    train(run, Sphere(), unwatched(RARELY))
    axes = figure(load_curves([run.folder])).axes[0]
    records = read_progress(run.folder)
    for attempt in range(1, ATTEMPTS + 1):
        for column, count in (("best", GENERATIONS), ("reevaluated", 3), ("verdict", 1)):
            told = [(r["generation"], r[column]) for r in records if r["attempt"] == attempt and r[column] is not None]
            assert len(told) == count
            assert lines(axes)[f"{column} {attempt}"] == told
    assert len(lines(axes)) == 3 * ATTEMPTS
    colours = {str(line.get_label()): line.get_color() for line in axes.get_lines()}
    assert [colours[f"best {n}"] for n in (1, 2, 3)] == [colours[f"verdict {n}"] for n in (1, 2, 3)]
    assert len(set(colours.values())) == ATTEMPTS
    assert axes.get_title(loc="left") == "Climb"


def test_along_ticks_a_point_stands_where_its_attempt_has_spent_so_many(mindc: Call, run: RunFolder) -> None:
    train(run, Sphere(), unwatched(RARELY))
    axes = figure([along_ticks(curve) for curve in load_curves([run.folder / "progress.csv"])]).axes[0]
    first = [record for record in read_progress(run.folder) if record["attempt"] == 1]
    spent = accumulate(record["ticks"] or 0 for record in first)
    assert lines(axes)["best 1"] == [(ticks, record["best"]) for ticks, record in zip(spent, first, strict=True)]
    told = mindc("plot", run.folder, "--ticks", "--mean", "--json", "-o", run.folder / "mean.svg")
    spans = [sum(r["ticks"] or 0 for r in read_progress(run.folder) if r["attempt"] == n) for n in (1, 2, 3)]
    assert json.loads(told.out)["curves"][0]["ticks"] == max(spans)


def test_what_is_not_finite_is_left_out(table: Path) -> None:
    drawn = figure(load_curves([table]))
    shown = lines(drawn.axes[0])
    assert shown["best 1"] == [(1, 3.5), (4, 5.5)]
    assert (shown["verdict 1"], shown["verdict 2"]) == ([(4, 3.75)], [])
    table.write_text("attempt,generation,best\n1,1,-inf\n")
    assert b"<svg" in image(figure(load_curves([table])), ".svg")


def test_the_legend_says_everything_once(table: Path) -> None:
    legend = figure(load_curves([table])).legends[0]
    assert len(legend.get_texts()) == 4
    table.write_text("attempt,generation,best\n1,1,2.0\n")
    assert [text.get_text() for text in figure(load_curves([table])).legends[0].get_texts()] == [
        "best of the generation"
    ]


def test_a_table_gives_the_picture_of_its_run_to_the_byte(run: RunFolder, tmp_path: Path) -> None:
    train(run, Sphere(), unwatched(RARELY))
    table = copy(run.folder / "progress.csv", tmp_path / "Climb.csv")
    packed = tmp_path / "packed" / "Climb.csv.gz"
    packed.parent.mkdir()
    packed.write_bytes(gzip.compress(table.read_bytes()))
    for suffix in (".svg", ".png"):
        assert len({image(figure(load_curves([path])), suffix) for path in (run.folder, table, packed)}) == 1


def test_the_settings_of_the_user_change_nothing(table: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import matplotlib

    before = image(figure(load_curves([table])), ".svg")
    monkeypatch.setitem(matplotlib.rcParams, "lines.linewidth", 9.0)
    monkeypatch.setitem(matplotlib.rcParams, "font.size", 20.0)
    assert image(figure(load_curves([table])), ".svg") == before


def test_a_run_that_goes_on_is_drawn_as_far_as_it_is(run: RunFolder) -> None:
    train(run, Sphere(), unwatched(stop_after=5))
    for name, late in (("progress.jsonl", b'{"attempt": 1, "gen'), ("progress.csv", b"1,6,-0.")):
        with (run.folder / name).open("ab") as file:
            file.write(late)
    for path in (run.folder, run.folder / "progress.csv"):
        shown = lines(figure(load_curves([path])).axes[0])
        assert [generation for generation, _ in shown["best 1"]] == [1, 2, 3, 4, 5]
        assert shown["verdict 1"] == []


def test_all_runs_beneath_a_folder_are_drawn_side_by_side(
    mindc: Call, run: RunFolder, table: Path, tmp_path: Path
) -> None:
    other = create(tmp_path / "runs", manifest(lesson(2)), {}, {})
    create(tmp_path / "runs", manifest(lesson(2), seed=7), {}, {})  # has learnt nothing yet
    for each in (run, other):
        train(each, Sphere(), unwatched(RARELY))
    curves = load_curves([tmp_path / "runs", run.folder, table])
    assert [(curve.path, curve.note) for curve in curves] == [
        (run.folder, f"runs/Climb/{run.folder.name}"),
        (other.folder, f"runs/Climb/{other.folder.name}"),
        (table, "Climb.csv"),
    ]
    picture = tmp_path / "curves.svg"
    said = mindc("plot", tmp_path / "runs", table, "-o", picture, "--json")
    assert (said.code, said.err) == (0, f"{picture}: how 3 runs were learnt\n")
    assert [curve["generations"] for curve in json.loads(said.out)["curves"]] == [36, 2, 5]
    assert len([e for e in ElementTree.parse(picture).iter() if str(e.get("id")).startswith("axes_")]) == 3


def test_the_picture_lies_where_one_stands(
    mindc: Call, table: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert mindc("plot", "Climb.csv") == (0, "", "curves.svg: how Climb was learnt\n")
    assert (tmp_path / "curves.svg").read_bytes() == image(figure(load_curves([table])), ".svg")
    assert mindc("plot", "Climb.csv", "-q", "-o", "curves.PNG") == (0, "", "")
    assert (tmp_path / "curves.PNG").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"


@pytest.mark.parametrize(
    ("words", "code", "message"),
    [
        (("nowhere",), 2, "there is no run nowhere"),
        (("notes.txt",), 2, "notes.txt is not a run"),
        (("empty",), 2, "there is no run in empty that has learnt for a generation"),
        (("stray",), 2, "stray is not a run: No such file or directory (stray/manifest.json)"),
        (("header.csv",), 1, "header.csv has no generations yet"),
        (("other.csv",), 1, "other.csv is not the log of a run: it has no column attempt"),
        (("wrong.csv",), 1, "wrong.csv, line 3: not a generation of a log"),
        (("huge.csv",), 1, "huge.csv, line 2: not a generation of a log"),
        (("torn.csv.gz",), 2, "torn.csv.gz cannot be read: "),
        (("bytes.csv",), 1, "bytes.csv is not a table of text"),
        (("Climb.csv", "-o", "curves.jpg"), 2, "curves.jpg must end in .svg or .png"),
        (("Climb.csv", "-o", "no/curves.svg"), 2, "no/curves.svg cannot be written: there is no folder no"),
        (("Climb.csv", "-o", "folder.svg"), 2, "folder.svg cannot be written: it is a folder"),
    ],
)
def test_what_cannot_be_drawn_is_said(
    mindc: Call,
    table: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    words: tuple[str, ...],
    code: int,
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    for folder in ("empty", "stray", "folder.svg"):
        Path(folder).mkdir()
    Path("stray/progress.jsonl").touch()
    Path("notes.txt").touch()
    Path("header.csv").write_text("attempt,generation,best\n")
    Path("other.csv").write_text("name,price\nnut,1\n")
    Path("wrong.csv").write_text("attempt,generation,best\n1,1,2.0\n1,two,2.0\n")
    Path("huge.csv").write_text(f"attempt,generation,best\n1,1{'0' * 400},2.0\n")
    Path("torn.csv.gz").write_bytes(gzip.compress(LOG.encode())[:-12])
    Path("bytes.csv").write_bytes(b"\xff\xfe\x00")
    before = sorted(tmp_path.iterdir())
    said = mindc("plot", *words)
    assert (said.code, said.out) == (code, "")
    assert said.err.startswith(message)
    assert sorted(tmp_path.iterdir()) == before


def test_a_run_without_a_generation_says_so(mindc: Call, run: RunFolder) -> None:
    assert mindc("plot", run.folder) == (1, "", f"{run.folder} has no generations yet\n")


def test_a_run_of_another_version_has_its_table_to_draw(mindc: Call, run: RunFolder, tmp_path: Path) -> None:
    train(run, Sphere(), unwatched(RARELY))
    (run.folder / "manifest.json").write_text('{"format": 1}')
    said = mindc("plot", run.folder, "-o", tmp_path / "curves.svg")
    assert (said.code, said.out) == (1, "")
    assert said.err.startswith(f"{run.folder}: the run was made by another version of mindc\n")
    assert mindc("plot", run.folder / "progress.csv", "-o", tmp_path / "curves.svg").code == 0


def test_without_matplotlib_the_command_says_how_to_get_it(
    mindc: Call, table: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    said = mindc("plot", table)
    assert (said.code, said.out) == (2, "")
    assert said.err.splitlines()[1:] == ["  pip install 'mindlang[plot]'"]
