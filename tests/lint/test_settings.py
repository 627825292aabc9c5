"""`mind.toml`: which rules are held where, and what is wrong in it, on its line."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mindlang.lint.rules import all_rules
from mindlang.lint.settings import LintSettings, settings_of
from tests.calling import RULES, Call

UNREAD = RULES.replace("sensor feeler", "sensor pulse is sine period 2 s\nsensor feeler")
BOTH = ["unread-sensor", "unreached-skill"]
CODES = st.lists(st.sampled_from(sorted(all_rules())), unique=True)


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "drafts" / "a.mind"
    path.parent.mkdir()
    path.write_text(UNREAD)
    return path


def test_what_is_ignored_is_not_found(mindc: Call, file: Path) -> None:
    assert "unread-sensor" in mindc("lint", file).out
    Path("mind.toml").write_text('[lint]\nignore = ["unread-sensor"]\n')
    assert "unread-sensor" not in mindc("lint", file).out
    assert "unread-sensor" in mindc("lint", file, "--select", "unread-sensor").out


def test_only_what_is_selected_is_found(mindc: Call, file: Path) -> None:
    Path("mind.toml").write_text('[lint]\nselect = ["unread-sensor"]\n')
    assert mindc("lint", file).err == "1 finding, 1 can be mended with --fix\n"
    assert mindc("lint", file, "--ignore", "unread-sensor").err == "nothing found\n"


@pytest.mark.parametrize(
    ("pattern", "is_ignored"),
    [("drafts/*", True), ("*", True), ("a.mind", True), ("*.mind", True), ("draft/*", False), ("b.mind", False)],
)
def test_some_files_are_spared_a_rule(mindc: Call, file: Path, pattern: str, is_ignored: bool) -> None:
    Path("mind.toml").write_text(f'[lint.per-file-ignores]\n"{pattern}" = ["unread-sensor"]\n')
    for words in (), ("--select", "unread-sensor"):
        assert ("unread-sensor" not in mindc("lint", file, *words).out) == is_ignored


def test_the_nearest_file_counts(mindc: Call, file: Path) -> None:
    Path("mind.toml").write_text('[lint]\nignore = ["unread-sensor"]\n')
    Path("drafts/mind.toml").write_text("")
    assert "unread-sensor" in mindc("lint", "drafts").out


@given(select=CODES, ignore=CODES, said=CODES, left_out=CODES)
def test_the_command_line_has_the_last_word(
    select: list[str], ignore: list[str], said: list[str], left_out: list[str]
) -> None:
    settings = LintSettings(select=tuple(select), ignore=tuple(ignore), per_file={"a.mind": tuple(left_out[:1])})
    held = settings.codes(Path("a.mind"), said, left_out)
    assert not set(held) & set(left_out)
    assert set(held) == (set(said) or (set(select or all_rules()) - set(ignore))) - set(left_out)


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ('[lint]\nignor = ["x"]\n', "2:1", "There is no setting called ignor."),
        ("[limt]\n", "1:2", "There is no section called limt."),
        ('[lint]\n# untaught-skil\nselect = ["untaught-skil"]\n', "3:12", "There is no rule called untaught-skil."),
        ('[lint]\nignore = ["no-tick"]\n', "2:12", "no-tick is an error, not a rule"),
        ('[lint]\nignore = "untaught-skill"\n', "2:1", "ignore is a list of codes."),
        ("[lint]\nselect = []\n", "2:1", "select names no rule."),
        ("[lint]\nselect = [1]\n", "2:1", "select is a list of codes."),
        ("lint = 3\n", "1:1", "lint is a section."),
        ("[lint]\nper-file-ignores = 3\n", "2:1", "per-file-ignores is a section of patterns."),
        ('[lint.per-file-ignores]\n"a/*" = 1\n', "2:2", "a/* is a list of codes."),
        ("[lint\n", "1:6", "This is no TOML"),
        ('[lint]\nignore = ["a]\n', "2:14", "This is no TOML"),
        ("[lint]\nignore = [\n", "2:11", "This is no TOML"),
    ],
)
def test_a_mistake_is_on_its_line(mindc: Call, file: Path, text: str, place: str, message: str) -> None:
    Path("mind.toml").write_text(text)
    said = mindc("lint", file)
    assert (said.code, said.out) == (2, "")
    assert said.err.startswith(f"mind.toml:{place}: error: {message}")


def test_all_mistakes_are_told_in_order(mindc: Call, file: Path) -> None:
    Path("mind.toml").write_text('[other]\n[lint]\nselect = ["x", "x"]\nselct = 1\n')
    found = mindc("lint", file).err
    places = [line.split(" ")[0] for line in found.splitlines() if line.startswith("mind.toml")]
    assert places == ["mind.toml:1:2:", "mind.toml:3:12:", "mind.toml:3:17:", "mind.toml:4:1:"]
    assert "Did you mean select?" in found


@given(st.text(max_size=60) | st.sampled_from(["[lint]\n", "[lint.per-file-ignores]\n"]).flatmap(
    lambda head: st.text(alphabet='abc"[]=.\n #-1', max_size=40).map(lambda rest: head + rest)
))  # fmt: skip
def test_no_text_ends_in_an_exception(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    folder = tmp_path_factory.mktemp("settings")
    (folder / "mind.toml").write_text(text, encoding="utf-8", errors="surrogatepass", newline="")
    found = settings_of(folder / "a.mind")
    assert all(each.span is None or each.span.line >= 1 for each in found.wrong)


def test_a_file_that_is_no_text_is_told(mindc: Call, file: Path) -> None:
    Path("mind.toml").write_bytes(b"\xff")
    assert "mind.toml cannot be read" in mindc("lint", file).err
