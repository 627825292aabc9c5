"""Where `mindc view` shows what it has made ready: a page served until Ctrl-C, or one file."""

from __future__ import annotations

import asyncio
import sys
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TextIO

import click
from mindrun.errors import MindError
from mindrun.terminal.tick_count import ticks as in_words

from mindlang.cli._run_session import RunSession
from mindlang.cli._terminal import MISUSE, fail, procedures_talk, talk, write_file
from mindlang.view.export import exported, exported_images, refuse_too_long
from mindlang.view.server import PortError, ViewServer, open_browser
from mindlang.view.session import Session
from mindlang.view.viewed import Viewed

if TYPE_CHECKING:
    from mindlang.view.learning import Learning


@dataclass(frozen=True, slots=True)
class ViewOutput:
    """In the file `export`, or at a `port` of this machine, None for any that is free."""

    port: int | None
    opens_browser: bool
    export: Path | None
    quiet: bool

    def show(self, viewed: Viewed, learning: Learning | None = None) -> None:
        """Write the file, or serve until Ctrl-C."""
        if self.export:
            self._write(viewed, self.export)
            return
        if not viewed.is_live:
            viewed.grow()  # what the page shows first
        ready = partial(self._ready, sys.stdout)
        try:
            with procedures_talk():
                asyncio.run(ViewServer(Session(viewed, learning), self.port or 0).serve(ready))
        except PortError as error:
            fail(str(error), error.hint, MISUSE)

    def _ready(self, out: TextIO, address: str) -> None:
        click.echo(address, file=out)
        if not self.quiet:
            talk.print("Ctrl-C ends this; a browser that is closed does not.")
        if self.opens_browser:
            open_browser(address)

    def _write(self, viewed: Viewed, path: Path) -> None:
        session = RunSession(self.quiet)
        with session.progress() as progress, procedures_talk():
            bar = progress.add_task(path.name, total=viewed.about["of_ticks"])
            while not viewed.over:
                viewed.grow()
                progress.update(bar, completed=viewed.known)
            if viewed.failed:
                fail(f"{viewed.failed}: nothing is written")
            try:
                refuse_too_long(viewed)
            except MindError as error:
                fail(str(error), error.hint, MISUSE)
            progress.reset(bar, description="images", total=viewed.known)
            images = exported_images(viewed, lambda tick: progress.update(bar, completed=tick))
        seen = Session(viewed)
        everything = seen.ticks(0) | {"happened": viewed.happened, "stops": viewed.stops}
        page = exported(seen.about(edits=False), everything, viewed, images)
        write_file(path, page.encode())
        session.say(f"{path}: {in_words(viewed.known)}, {len(page) / 1e6:.1f} MB, opens in any browser")
        if images and images.note:
            session.say(f"note: {images.note}")
