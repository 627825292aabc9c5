"""The edits of a hierarchy, one a file: a function of a project that says what to splice.

What the signatures say of the command line is read from them here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from inspect import Parameter, getdoc, signature
from pkgutil import iter_modules
from typing import Any, get_args, get_origin, get_type_hints

Function = Callable[..., Any]


@dataclass(frozen=True, slots=True)
class EditOption:
    """An option of an edit; `many` may be said several times."""

    name: str
    many: bool
    default: Any
    help: str


@dataclass(frozen=True, slots=True)
class Edit:
    """An edit as a command: its arguments in their order (`many`: one or more), its options, its explanation."""

    name: str
    function: Function
    arguments: tuple[tuple[str, bool], ...]
    options: tuple[EditOption, ...]
    text: str
    example: str


def names() -> list[str]:
    return sorted(module.name for module in iter_modules(__path__))


def edit(name: str) -> Edit:
    """The edit of that name: the function `NAME` in the module `mindlang.editing.edits.NAME`."""
    function = getattr(import_module(f"{__name__}.{name}"), name)
    hints = get_type_hints(function, include_extras=True)
    text, _, example = (getdoc(function) or "").partition("Example: ")
    arguments, options = list[tuple[str, bool]](), list[EditOption]()
    for parameter in [*signature(function).parameters.values()][1:]:  # the first is the project
        hint, key = hints[parameter.name], parameter.name
        if parameter.kind is Parameter.KEYWORD_ONLY:
            plain, about = get_args(hint)
            options.append(EditOption(key, get_origin(plain) is tuple, parameter.default, about))
        else:
            arguments.append((key, get_origin(hint) is tuple))
    return Edit(name, function, tuple(arguments), tuple(options), text.strip(), f"Example: {example.strip()}")
