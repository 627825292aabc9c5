"""What the text of a procedure's module uses that is not in it: modules, numbers drawn at random, files."""

import ast
from collections.abc import Iterator

DRAWN = "random.", "secrets.", "numpy.random."  # of modules whose numbers are other ones in every run
SEEDED = {"Random", "default_rng", "SeedSequence", "PCG64", "MT19937", "Philox", "SFC64", "Generator", "RandomState"}
READING = {
    *("CDLL", "CascadeClassifier", "InferenceSession", "ZipFile", "fromfile", "from_pretrained", "genfromtxt"),
    *("get_data", "imread", "load", "load_file", "load_model", "loadmat", "loadtxt", "memmap", "open", "open_code"),
    *("read_csv", "run_path", "safe_open"),
}  # functions of modules that read the file they are given the name of
OF_PATHS = {"read_text", "read_bytes"}  # methods that nothing but a file has
STREAMED = "json.", "marshal.", "pickle.", "tomllib.", "yaml."  # modules whose `load` is given what is open
IN_MEMORY = "io.BytesIO", "io.StringIO"
IMPORTING = "importlib.import_module", "__import__"


def imports(tree: ast.Module) -> Iterator[tuple[int, str, bool]]:
    """Each line that imports, the module (what is relative begins with a dot), and whether it may be missing."""
    tried = {inner for node in ast.walk(tree) if isinstance(node, ast.Try) for inner in ast.walk(node)}
    known = imported(tree) | {"__import__": "__import__"}
    for node in ast.walk(tree):
        match node:
            case ast.Import(names=names):
                yield from ((node.lineno, alias.name, node in tried) for alias in names)
            case ast.ImportFrom(module=module, level=level):
                yield node.lineno, "." * level + (module or ""), node in tried
            case ast.Call(func=func, args=[ast.Constant(value=str(module)), *_]) if path(func, known) in IMPORTING:
                yield node.lineno, module, node in tried


def drawn(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Lines that use numbers drawn at random, from no generator with a seed, and what they use."""
    known = imported(tree)
    for node in ast.walk(tree):
        match node:
            case ast.Attribute() | ast.Name(ctx=ast.Load()):
                used = path(node, known)
                if used.startswith(DRAWN) and used.rpartition(".")[2] not in SEEDED:
                    yield node.lineno, used
            case ast.Call(func=func, args=[], keywords=[]):
                used = path(func, known)
                if used.startswith(DRAWN) and used.rpartition(".")[2] in SEEDED:
                    yield node.lineno, f"{used} without a seed"


def opened(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Lines that read a file, and by what; one that only writes is none."""
    known = {"open": "open", "__file__": "__file__"} | imported(tree)
    for name in _given(tree) & known.keys():
        del known[name]
    is_streaming = any(path(node, known) in IN_MEMORY for node in ast.walk(tree))
    for node in ast.walk(tree):
        match node:
            case ast.Name(id="__file__") if "__file__" in known:
                yield node.lineno, "__file__"
            case ast.Call(func=func):
                used = path(func, known)
                if used and _reads(used, node, is_streaming):
                    yield node.lineno, used
                elif not used and isinstance(func, ast.Attribute) and _is_of_a_path(func.attr, node, known):
                    yield node.lineno, func.attr


def texts(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """The texts in a module and their lines, without docstrings and what is only written to."""
    known = {"open": "open"} | imported(tree)
    passed: set[ast.expr] = set()
    for node in ast.walk(tree):  # whoever has a node in it comes first
        match node:
            case ast.Expr(value=ast.Constant() as docstring):
                passed.add(docstring)
            case ast.Call(func=func, args=[name, mode, *_]) if path(func, known).endswith("open") and _writes([mode]):
                passed.add(name)
            case ast.Constant(value=str(text)) if node not in passed:
                yield node.lineno, text


def imported(tree: ast.Module) -> dict[str, str]:
    """Names in the text, and the modules, or what of them, that they stand for."""
    known: dict[str, str] = {}
    for node in ast.walk(tree):
        match node:
            case ast.Import(names=aliases):
                for alias in aliases:
                    top = alias.name.split(".")[0]
                    known[alias.asname or top] = alias.name if alias.asname else top
            case ast.ImportFrom(module=str(module), names=aliases, level=0):
                known |= {alias.asname or alias.name: f"{module}.{alias.name}" for alias in aliases}
    return known


def path(node: ast.AST, known: dict[str, str]) -> str:
    """The dotted name of what an expression stands for, where it is a module's."""
    parts = []
    while isinstance(node, ast.Attribute):
        parts.append(node.attr)
        node = node.value
    if isinstance(node, ast.Name) and node.id in known:
        return ".".join([known[node.id], *reversed(parts)])
    return ""


def _given(tree: ast.Module) -> set[str]:
    """Names that the text itself gives a value."""
    given: set[str] = set()
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name) | ast.arg(arg=name):
                given.add(name)
            case ast.Name(id=name, ctx=ast.Store()):
                given.add(name)
    return given


def _reads(used: str, call: ast.Call, is_streaming: bool) -> bool:
    """Whether a function of a module reads a file; one that may be given what is in memory is believed to be."""
    last = used.rpartition(".")[2]
    if last == "open":
        return not _writes([*call.args[1:2], *_mode_of(call)])
    is_named = not is_streaming or any(isinstance(each, ast.Constant | ast.JoinedStr) for each in call.args[:1])
    return last in READING and is_named and not (last == "load" and used.startswith(STREAMED))


def _is_of_a_path(method: str, call: ast.Call, known: dict[str, str]) -> bool:
    """Whether a method of something reads a file: what has an `open` is a path where the module knows any."""
    knows_paths = any(each.startswith("pathlib") for each in known.values())
    return method in OF_PATHS or (method == "open" and knows_paths and not _writes([*call.args[:1], *_mode_of(call)]))


def _mode_of(call: ast.Call) -> list[ast.expr]:
    return [each.value for each in call.keywords if each.arg == "mode"]


def _writes(modes: list[ast.expr]) -> bool:
    """Whether the mode of an `open` says that nothing is read."""
    said = [each.value for each in modes if isinstance(each, ast.Constant) and isinstance(each.value, str)]
    return any(mode.strip("bt")[:1] in {"w", "a", "x"} and "+" not in mode for mode in said)
