"""The edits of a mind by subject: each public function of a module here, which takes a project and says what to splice.

What the signatures say of the command line is read from them here.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from inspect import Parameter, getdoc, isfunction, signature
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


@cache
def _functions() -> dict[str, Function]:
    """The functions of all edits by their names."""
    modules = [import_module(f"{__name__}.{each.name}") for each in iter_modules(__path__)]
    own = (each for module in modules for each in vars(module).values() if isfunction(each))
    return {each.__name__: each for each in own if each.__module__.startswith(__name__) and each.__name__[0] != "_"}


def names() -> list[str]:
    return sorted(_functions())


def edit(name: str) -> Edit:
    """The edit of that name."""
    function = _functions()[name]
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
