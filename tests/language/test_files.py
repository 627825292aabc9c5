"""Files that cannot be read, files that use one another, text that is hostile."""

from pathlib import Path

import pytest

from mindlang.cli._diagnostic_printer import as_data, plain
from mindlang.compiler.compile import Compiled, load
from tests.language.examples import RIGHT, changed, codes, compiled

TEXT = RIGHT.read_text(encoding="utf-8")
TICK, REST = "tick 1/60 s\n", TEXT.removeprefix("tick 1/60 s\n")


def written(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def the_only_message(found: Compiled) -> str:
    assert found.graph is None
    assert len(found.diagnostics) == 1
    return found.diagnostics[0].message


@pytest.mark.parametrize(
    ("data", "word"),
    [
        (b"tick 1/60 s\0", "binary"),
        (b"# caf\xe9\n", "not UTF-8 text (line 1)"),
        (b"\xff\xfet\0i\0", "binary"),
        (b"#" * (1 << 20) + b"\n", "larger than 1 MiB"),
    ],
)
def test_a_file_that_is_no_text_is_unreadable(tmp_path: Path, data: bytes, word: str) -> None:
    path = tmp_path / "bad.mind"
    path.write_bytes(data)
    found = load(path)
    assert word in the_only_message(found)
    assert not found.readable


@pytest.mark.parametrize("name", ["nowhere.mind", ".", "a\0b", "x" * 5000, "a/../b/c.mind"])
def test_a_path_without_a_file_is_unreadable(tmp_path: Path, name: str) -> None:
    found = load(f"{tmp_path}/{name}")
    assert not found.readable
    assert the_only_message(found)


def test_an_endless_file_is_not_even_opened() -> None:
    found = load("/dev/zero")
    assert the_only_message(found) == "/dev/zero cannot be read: it is a device."
    assert not found.readable


def test_a_mark_of_byte_order_is_no_mistake(tmp_path: Path) -> None:
    path = tmp_path / "bom.mind"
    path.write_bytes(b"\xef\xbb\xbf" + TEXT.encode())
    assert load(path).diagnostics == ()


def test_the_parts_of_a_mind_may_stand_in_several_files(tmp_path: Path) -> None:
    head, facts = REST.split("skill Seek is", 1)
    written(tmp_path / "parts" / "body.mind", TICK + head.replace("master Go", "master Nobody"))
    written(tmp_path / "parts" / "all.mind", 'use "body.mind"\nuse "../more.mind"\n')
    written(tmp_path / "more.mind", 'use "parts/body.mind"\n')
    main = written(tmp_path / "main.mind", f'use "parts/all.mind"\nmaster Go\nskill Seek is{facts}')
    found = load(main)
    assert found.diagnostics == ()
    assert [Path(source.name).name for source in found.sources] == ["main.mind", "all.mind", "body.mind", "more.mind"]
    assert found.graph == changed().graph


def test_a_loop_of_use_is_printed_whole(tmp_path: Path) -> None:
    main = written(tmp_path / "a.mind", f'use "deep/b.mind"\n{TEXT}')
    written(tmp_path / "deep" / "b.mind", 'use "c.mind"\n')
    written(tmp_path / "deep" / "c.mind", 'use "../a.mind"\n')
    message = the_only_message(load(main))
    assert message == "Files use one another in a circle: a.mind → deep/b.mind → deep/c.mind → a.mind."


def test_files_agree_on_the_tick(tmp_path: Path) -> None:
    main = written(tmp_path / "a.mind", f'use "b.mind"\n{TEXT}')
    written(tmp_path / "b.mind", "tick 2/120 s\n")
    assert load(main).diagnostics == ()
    written(tmp_path / "b.mind", "tick 1/50 s\n")
    assert codes(load(main)) == ["tick-differs"]


def test_no_link_leads_out_of_the_project(tmp_path: Path) -> None:
    secret = written(tmp_path / "secret.mind", TICK)
    main = written(tmp_path / "project" / "a.mind", f'use "link.mind"\n{TEXT}')
    (main.parent / "link.mind").symlink_to(secret)
    assert codes(load(main)) == ["outside-project"]
    (main.parent / "link.mind").unlink()
    (main.parent / "link.mind").symlink_to("link.mind")
    assert codes(load(main)) == ["outside-project"]


def test_mistakes_in_a_used_file_are_reported_there(tmp_path: Path) -> None:
    main = written(tmp_path / "a.mind", f'use "b.mind"\n{TEXT}')
    written(tmp_path / "b.mind", "\nsensor eyes is inertial\n")
    first = load(main).diagnostics[0]
    assert first.span is not None
    assert (first.code, first.span.source.name, first.span.line) == ("duplicate-name", f"{tmp_path}/b.mind", 2)


def test_a_long_chain_of_use_has_an_end(tmp_path: Path) -> None:
    for number in range(100):
        written(tmp_path / f"f{number}.mind", f'use "f{number + 1}.mind"\n')
    assert codes(load(tmp_path / "f0.mind")) == ["use-too-deep"]


@pytest.mark.parametrize(
    "value",
    ["(" * 5000, "(" * 5000 + "1" + ")" * 5000, "-" * 5000 + "1", "-(" * 64 + "1" + ")" * 64, "1" + " - -" * 70 + "1"],
)
def test_nesting_has_an_end(value: str) -> None:
    assert changed(("1 - holding", value)).graph is None


@pytest.mark.parametrize("operator", ["-", "/"])
def test_a_long_sum_needs_no_deep_stack(operator: str) -> None:
    graph = changed(("1 - holding", operator.join(["holding"] * 5_000))).graph
    assert graph is not None
    assert len(graph.skills[0].edges[0].value) == 9_999


def test_sixty_four_parentheses_are_fine() -> None:
    assert changed(("1 - holding", "(" * 64 + "1" + ")" * 64)).diagnostics == ()


def test_nothing_in_a_source_reaches_the_terminal_raw() -> None:
    found = compiled('reads \x1b[2J\u202e\u2066evil\x07\r\u2028\x85\nuse "\x1b]0;x\x07"\nlasts \ud7ff\n')
    for diagnostic in found.diagnostics:
        said = plain(diagnostic)
        assert not set(said) & set("\x1b\u202e\u2066\x07\r\u2028\x85")
    assert "\\u001b" in plain(found.diagnostics[0])


def test_the_caret_stands_below_its_place_after_tabs_and_wide_characters() -> None:
    said = plain(compiled("sensor 目\x1b\tis sine !\n").diagnostics[0]).splitlines()
    assert said[1].index("\\u001b") + 1 == said[2].index("^")  # the character before takes two columns


def test_a_long_line_is_shown_around_its_mistake() -> None:
    said = plain(compiled("sensor x is sine " + "a 1 " * 5000 + "!").diagnostics[0]).splitlines()
    assert len(said[1]) < 120
    assert said[1].strip().startswith("1 | …")
    assert said[2].index("^") == said[1].index("!")


def test_a_diagnostic_as_data() -> None:
    data = as_data(changed(("reads holding", "reads holdin")).diagnostics[0])
    assert data == {
        "code": "unknown-sensor",
        "severity": "error",
        "message": "There is no sensor or memory called holdin.",
        "hint": "Did you mean holding?",
        "file": "text.mind",
        "line": 18,
        "column": 9,
        "end_line": 18,
        "end_column": 15,
        "labels": [],
    }
