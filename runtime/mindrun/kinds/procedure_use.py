"""What the text of a procedure's module uses that is not in it: modules, numbers drawn at random, files."""

import ast
from collections.abc import Iterator

from mindrun.kinds.procedure_names import Names

DRAWN = "random.", "secrets.", "numpy.random."  # of modules whose numbers are other ones in every run
SEEDED = {"Random", "default_rng", "SeedSequence", "PCG64", "MT19937", "Philox", "SFC64", "Generator", "RandomState"}
ANYBODY = ("",)  # whichever module has a function of that name
RESOURCES = ("importlib.resources.", "importlib_resources.")
READERS = {
    **dict.fromkeys(("CDLL", "CascadeClassifier", "InferenceSession", "LoadLibrary", "ZipFile"), ANYBODY),
    **dict.fromkeys(("from_pretrained", "fromfile", "genfromtxt", "get_data", "imread", "load", "load_file"), ANYBODY),
    **dict.fromkeys(("load_model", "loadmat", "loadtxt", "memmap", "open", "open_code", "open_memmap"), ANYBODY),
    **dict.fromkeys(("run_path", "safe_open", "spec_from_file_location", "SourceFileLoader"), ANYBODY),
    **dict.fromkeys(("read_csv", "read_excel", "read_feather", "read_json", "read_parquet", "read_pickle"), ANYBODY),
    **dict.fromkeys(("as_file", "contents", "files", "open_binary", "open_text", "path", "read_binary"), RESOURCES),
    **dict.fromkeys(("read_bytes", "read_text"), ("pathlib.", *RESOURCES)),
    **dict.fromkeys(("getline", "getlines"), ("linecache.",)),
    **dict.fromkeys(("FileInput", "input"), ("fileinput.",)),
    "FileIO": ("io.", "_io."),
    "connect": ("sqlite3.",),
}  # functions that read the file they are given the name of, and how the names of those begin that have them
OF_PATHS = {"read_text", "read_bytes"}  # methods that nothing but a file has
STREAMED = "json.", "marshal.", "pickle.", "tomllib.", "yaml."  # modules whose `load` is given what is open
IN_MEMORY = {"io.BytesIO", "io.StringIO"}
IMPORTING = {"importlib.import_module", "__import__", "builtins.__import__"}


def imports(names: Names) -> Iterator[tuple[int, str, str, bool]]:
    """Each line that imports, the module (with a dot before what is relative), a name in it, whether it may be absent.

    The name is empty for the module alone, and where all of it is taken.
    """
    tried = {inner for node in ast.walk(names.tree) if isinstance(node, ast.Try) for inner in ast.walk(node)}
    for node in ast.walk(names.tree):
        match node:
            case ast.Import(names=aliases):
                yield from ((node.lineno, alias.name, "", node in tried) for alias in aliases)
            case ast.ImportFrom(module=module, names=aliases, level=level):
                for alias in aliases:
                    what = "" if alias.name == "*" else alias.name
                    yield node.lineno, "." * level + (module or ""), what, node in tried
            case ast.Call(func=func, args=[ast.Constant(value=str(module)), *_]) if names.paths(func) & IMPORTING:
                yield node.lineno, module, "", node in tried


def drawn(names: Names) -> Iterator[tuple[int, str]]:
    """Lines that use numbers drawn at random, from no generator with a seed, and what they use."""
    for node in ast.walk(names.tree):
        match node:
            case ast.Attribute() | ast.Name(ctx=ast.Load()):
                for used in names.paths(node):
                    if used.startswith(DRAWN) and used.rpartition(".")[2] not in SEEDED:
                        yield node.lineno, used
            case ast.Call(func=func, args=[], keywords=[]):
                for used in names.paths(func):
                    if used.startswith(DRAWN) and used.rpartition(".")[2] in SEEDED:
                        yield node.lineno, f"{used} without a seed"


def opened(names: Names) -> Iterator[tuple[int, str]]:
    """Lines that read a file, and by what; one that only writes is none."""
    is_streaming = any(names.paths(node) & IN_MEMORY for node in ast.walk(names.tree))
    for node in ast.walk(names.tree):
        match node:
            case ast.Name(id="__file__") if "__file__" in names.paths(node):
                yield node.lineno, "__file__"
            case ast.Call(func=func):
                paths = sorted(names.paths(func))
                yield from ((node.lineno, used) for used in paths if _reads(used, node, is_streaming))
                if not paths and isinstance(func, ast.Attribute) and _is_of_a_path(func.attr, node, names):
                    yield node.lineno, func.attr


def texts(names: Names) -> Iterator[tuple[int, str]]:
    """The texts in a module and their lines, without docstrings and what is only written to."""
    passed: set[ast.expr] = set()
    for node in ast.walk(names.tree):  # whoever has a node in it comes first
        match node:
            case ast.Expr(value=ast.Constant() as docstring):
                passed.add(docstring)
            case ast.Call(func=func, args=[name, *_]) if _opens(names.paths(func)) and _writes(_modes(node, 1)):
                passed.add(name)
            case ast.Constant(value=str(text)) if node not in passed:
                yield node.lineno, text


def _opens(paths: frozenset[str]) -> bool:
    return any(path.rpartition(".")[2] == "open" for path in paths)


def _reads(used: str, call: ast.Call, is_streaming: bool) -> bool:
    """Whether a function of a module reads a file; one that may be given what is in memory is believed to be."""
    last = used.rpartition(".")[2]
    if last == "open":
        return not _writes(_modes(call, 1))
    is_named = not is_streaming or any(isinstance(each, ast.Constant | ast.JoinedStr) for each in call.args[:1])
    is_reader = used.startswith(READERS.get(last, ()))
    return is_reader and is_named and not (last == "load" and used.startswith(STREAMED))


def _is_of_a_path(method: str, call: ast.Call, names: Names) -> bool:
    """Whether a method of something reads a file: what has an `open` is a path where the module knows any."""
    knows_paths = any(each.startswith("pathlib") for each in names.imported)
    return method in OF_PATHS or (method == "open" and knows_paths and not _writes(_modes(call, 0)))


def _modes(call: ast.Call, place: int) -> list[ast.expr]:
    """What a call of an `open` says of its mode, by a keyword or as the argument at a place."""
    return [*call.args[place : place + 1], *(each.value for each in call.keywords if each.arg in ("mode", "flags"))]


def _writes(modes: list[ast.expr]) -> bool:
    """Whether the mode of an `open` says that nothing is read."""
    said = [each.value for each in modes if isinstance(each, ast.Constant) and isinstance(each.value, str)]
    flags = {each.attr for mode in modes for each in ast.walk(mode) if isinstance(each, ast.Attribute)}
    return "O_WRONLY" in flags or any(mode.strip("bt")[:1] in {"w", "a", "x"} and "+" not in mode for mode in said)
