"""Minds that share files with the one that is edited: those that use one of its files, and its files by themselves."""

from collections.abc import Collection, Iterable, Iterator
from os.path import realpath
from pathlib import Path

from mindlang.compiler.compile import Compiled, load
from mindlang.files import files_beside, folders_above, name_from_here, readable_text, within_read_limits


def neighbours(files: Collection[Path]) -> Iterator[Compiled]:
    """Every other mind that compiles and has one of these files among its own; the first of them is its main file.

    A file is used from its own folder or one above, so it is there that they can be.
    """
    main, *_ = files
    folders = dict.fromkeys(folder for file in files for folder in folders_above(file))
    paths = (path for folder in folders for path in files_beside(folder) if path != main)
    for path, text in sorted(within_read_limits((path, readable_text(path)) for path in paths)):
        if path in files or 'use "' in text:  # most of those that lie about need not be compiled
            compiled = load(name_from_here(path))
            if compiled.graph and not {source.path for source in compiled.sources}.isdisjoint(files):
                yield compiled


def minds(files: Iterable[str]) -> dict[str, Compiled]:
    """Files compiled, each once, without those that are no minds by themselves and of which a mind makes use."""
    names = {realpath(file) if file != "-" else file: file for file in reversed(list(files))}
    found = {file: load(file) for file in reversed(names.values())}
    used = {source.path for each in found.values() for source in each.sources[1:]}
    parts = {
        file
        for file, each in found.items()
        if not each.graph and each.sources and (each.sources[0].path in used or any(neighbours([each.sources[0].path])))
    }
    return {file: each for file, each in found.items() if file not in parts}
