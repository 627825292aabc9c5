"""The settings of docs/editors.md in a real Neovim and a real Emacs: what they show of a mistake, and what they run."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.calling import RULES
from tests.pages.blocks import blocks

MINDC = f'#!/bin/sh\nexec "{sys.executable}" -c "from mindlang.cli import main; main()" "$@"\n'
NVIM_TRIES = """
local function say(...) io.stdout:write(table.concat({...}, " "), "\\n") end
vim.wait(600000, function() return #vim.diagnostic.get(0) > 0 end, 100)
for _, each in ipairs(vim.diagnostic.get(0)) do say("line", each.lnum + 1, each.message) end
vim.lsp.codelens.refresh()
vim.wait(600000, function() return #vim.lsp.codelens.get(0) > 0 end, 100)
local command = vim.lsp.codelens.get(0)[1].command
vim.bo.modified = false
vim.lsp.commands[command.command](command, {})
local function shown() return table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), "\\n") end
vim.wait(600000, function() return shown():match("Process exited") end, 100)
say(shown())
vim.cmd("qa!")
"""
EMACS_TRIES = """
(find-file "rules.mind")
(unless (eglot-current-server) (run-hooks 'post-command-hook))
(let ((tries 0))
  (while (and (< tries 6000) (not (flymake-diagnostics)))
    (accept-process-output nil 0.1)
    (when (eglot-current-server) (flymake-start))
    (setq tries (1+ tries))))
(dolist (each (flymake-diagnostics))
  (princ (format "line %s %s\\n" (line-number-at-pos (flymake-diagnostic-beg each)) (flymake-diagnostic-text each))))
"""
WRONG = RULES.replace("drives left_wheel", "drives left_whel", 1)
LINE = WRONG[: WRONG.index("left_whel")].count("\n") + 1

pytestmark = pytest.mark.slow


def neovim() -> str:
    """A Neovim for which the settings are: vim.lsp.config came with 0.11."""
    return program("nvim", "--headless", "-u", "NONE", "+lua os.exit(vim.fn.has('nvim-0.11') == 1 and 0 or 1)")


def emacs() -> str:
    """An Emacs that has Eglot, its own or a package."""
    return program("emacs", "--batch", "-f", "package-initialize", "--eval", "(require 'eglot)")


def program(name: str, *has: str) -> str:
    """The path of a program with which these words succeed; the test is skipped where there is none."""
    found = shutil.which(name)
    if not found or subprocess.run([found, *has], capture_output=True, check=False).returncode:
        pytest.skip(f"there is no {name} that is new enough")
    return found


def settings(language: str) -> str:
    """What the page says."""
    return next(each.text for each in blocks("docs/editors.md") if each.language == language)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a mistake in a mind; mindc is in PATH, and settings of whoever tests are elsewhere."""
    (tmp_path / "rules.mind").write_text(WRONG, encoding="utf-8")
    (tmp_path / ".git").mkdir()
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "mindc").write_text(MINDC)
    (tmp_path / "bin" / "mindc").chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}:{os.environ['PATH']}")
    for name in ("HOME", "XDG_CONFIG_HOME", "XDG_STATE_HOME", "XDG_CACHE_HOME", "XDG_DATA_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    return tmp_path


def test_neovim_shows_a_mistake_and_carries_out_the_words_above_a_line(folder: Path) -> None:
    (folder / "init.lua").write_text(settings("lua"), encoding="utf-8")
    (folder / "tries.lua").write_text(NVIM_TRIES, encoding="utf-8")
    words = [neovim(), "--headless", "-u", "init.lua", "rules.mind", "-c", "luafile tries.lua"]
    said = said_by(words, folder)
    assert f"line {LINE} There is no actuator or memory called left_whel" in said
    assert f"rules.mind:{LINE}:" in said, "what mindc says in the terminal"


def test_emacs_shows_a_mistake(folder: Path) -> None:
    (folder / "tries.el").write_text(f"(package-initialize)\n{settings('elisp')}\n(require 'eglot)\n{EMACS_TRIES}")
    said = said_by([emacs(), "--batch", "-l", "tries.el"], folder)
    assert f"line {LINE} mindc [" in said
    assert "There is no actuator or memory called left_whel" in said


def said_by(words: list[str], folder: Path) -> str:
    """What an editor prints, on either stream."""
    done = subprocess.run(words, capture_output=True, text=True, cwd=folder, timeout=900, check=False)
    return done.stdout + done.stderr
