"""The extension in a real VS Code, whose server a browser shows: what it underlines, says above a line, and runs."""

import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.calling import write_rules
from tests.server.test_extension import packaged
from tests.view.browser import chromium

SERVER = shutil.which("code-server")
WAIT_MILLISECONDS = 120_000
SETTINGS = '{"security.workspace.trust.enabled": false, "workbench.startupEditor": "none"}'
MINDC = f'#!/bin/sh\nexec "{sys.executable}" -c "from mindlang.cli import main; main()" "$@"\n'

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(not SERVER or not shutil.which("npm"), reason="there is no code-server, which npm has"),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a mind, and an environment in which mindc is."""
    folder = tmp_path_factory.mktemp("robot")
    write_rules(folder)
    program = folder / ".venv" / "bin" / "mindc"
    program.parent.mkdir(parents=True)
    program.write_text(MINDC)
    program.chmod(0o755)
    return folder


@pytest.fixture(scope="module")
def page(folder: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Any]:
    """VS Code with the extension, and the mind open in it."""
    own = tmp_path_factory.mktemp("code")
    (own / "User").mkdir()
    (own / "User" / "settings.json").write_text(SETTINGS)
    assert SERVER
    command = [SERVER, "--config", own / "config.yaml", "--user-data-dir", own, "--extensions-dir", own / "extensions"]
    subprocess.run([*command, "--install-extension", packaged(own / "built")], check=True)
    with chromium() as browser, serving(command, folder, own / "log") as address:
        page = browser.new_page(viewport={"width": 1280, "height": 860})
        page.set_default_timeout(WAIT_MILLISECONDS)
        page.goto(f"{address}/?folder={folder}")
        page.locator(".monaco-list-row", has_text=".mind").first.dblclick()
        page.wait_for_selector(".codelens-decoration a", state="attached")
        yield page


@contextmanager
def serving(command: list[Any], folder: Path, log: Path) -> Iterator[str]:
    """The address at which a VS Code is served, of a port that is free."""
    options = ["--auth", "none", "--bind-addr", "127.0.0.1:0", "--disable-telemetry", "--disable-update-check"]
    with log.open("w") as said, subprocess.Popen([*command, *options, folder], stdout=said, stderr=said) as process:
        try:
            yield address(process, log)
        finally:
            process.terminate()


def address(process: subprocess.Popen[Any], log: Path) -> str:
    """What the server says of where it is."""
    marker = "HTTP server listening on "
    while process.poll() is None:
        if found := [line.partition(marker)[2] for line in log.read_text().splitlines() if marker in line]:
            return found[0].strip().rstrip("/")
        time.sleep(0.1)
    raise AssertionError(log.read_text())


def test_words_stand_above_the_lines(page: Any) -> None:
    found = page.locator(".codelens-decoration").first.inner_text().split()
    assert [word for word in found if word.strip("|")] == ["Run", "Bench", "View"]


def test_what_is_wrong_is_underlined(page: Any) -> None:
    line = page.locator(".view-line", has_text="ball_bearing").first
    line.click()
    page.keyboard.press("End")
    page.keyboard.type("x")
    page.wait_for_selector(".squiggly-error", state="attached")
    page.keyboard.press("Backspace")
    page.wait_for_selector(".squiggly-error", state="detached")


def test_a_word_runs_in_a_terminal(page: Any) -> None:
    page.locator(".codelens-decoration a", has_text="Run").first.click()
    page.wait_for_selector(".xterm")
    page.wait_for_function(
        "document.querySelector('.terminal-tab, .single-terminal-tab')?.innerText.includes('mindc run')"
    )


def test_an_edit_is_asked_for_and_made(page: Any) -> None:
    """From the palette, with its questions one after the other."""
    page.locator(".view-line", has_text="skill").first.click()
    page.keyboard.press("F1")
    page.keyboard.type("mind: Edit the hierarchy")
    page.locator(".quick-input-widget .monaco-list-row.focused", has_text="Edit the hierarchy").click()
    answer(page, "Edit the hierarchy", "rename", ".monaco-list-row.focused")
    for argument, text in (("old", "Turn"), ("new", "Spin"), ("noun", "")):
        answer(page, f"rename: {argument}", text)
    page.locator(".view-line", has_text="Spin").nth(1).wait_for()
    assert page.locator(".view-line", has_text="Turn").count() == 0


def answer(page: Any, title: str, text: str, row: str = "") -> None:
    """Type what a question is answered with, once the question is there, and where there are rows, that one."""
    question = page.locator(".quick-input-widget")
    question.locator(".quick-input-title", has_text=title).wait_for()
    page.keyboard.type(text)
    if row:
        question.locator(row, has_text=text).wait_for()
    page.keyboard.press("Enter")
