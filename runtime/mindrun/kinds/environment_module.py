"""The module beside a mind that an environment's name begins with: found, not run."""

from pathlib import Path


def module_beside(name: str, folder: Path | None) -> Path | None:
    """The file of the module that an environment's name begins with, where it stands in a folder."""
    module, colon, _ = name.partition(":")
    if folder is None or not colon:
        return None
    top = folder / module.partition(".")[0]
    return next((path for path in (top.with_suffix(".py"), top / "__init__.py") if path.is_file()), None)
