"""Name resolution in a module's text, each name in its own scope: which modules, files and random numbers it uses."""

import ast
import builtins
import symtable
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

Key = tuple[symtable.SymbolTable, str]  # the scope that a name belongs to, and the name
Scopes = tuple[symtable.SymbolTable, ...]  # of a module, and of what is in it around a place, the inmost last
DEFINITIONS = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef
UNNAMED: dict[type[ast.AST], str] = {
    ast.Lambda: "lambda",
    ast.ListComp: "listcomp",
    ast.SetComp: "setcomp",
    ast.DictComp: "dictcomp",
    ast.GeneratorExp: "genexpr",
}  # and what symtable calls their scopes
MAX_DOTS = 6  # in what a name is found to stand for: x = x.next has no end
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
}  # functions that read a file given by name, and prefixes of the modules or classes that have them
OF_PATHS = {"read_text", "read_bytes"}  # methods that nothing but a file has
STREAMED = "json.", "marshal.", "pickle.", "tomllib.", "yaml."  # modules whose `load` is given what is open
IN_MEMORY = {"io.BytesIO", "io.StringIO"}
IMPORTING = {"importlib.import_module", "__import__", "builtins.__import__"}


@dataclass(slots=True)
class ModuleNames:
    """The names of a module's text; which of them are whose says Python's own table of symbols."""

    tree: ast.Module
    table: symtable.SymbolTable
    _scopes: dict[ast.AST, Scopes] = field(default_factory=dict)
    _bound: dict[Key, list[str | ast.expr]] = field(default_factory=lambda: defaultdict(list))
    _paths: dict[Key, set[str]] = field(default_factory=lambda: defaultdict(set))
    _everything_of: list[str] = field(default_factory=list)  # modules after from … import *

    def __post_init__(self) -> None:
        left: list[tuple[ast.AST, Scopes]] = [(self.tree, (self.table,))]
        used: set[int] = set()
        while left:
            node, scopes = left.pop()
            self._scopes[node] = scopes
            inner = (*scopes, *_begun(node, scopes[-1], used))
            self._bind(node, scopes, inner)
            own = {id(part) for part in _own_parts(node)}
            parts = [(part, inner if id(part) in own else scopes) for part in ast.iter_child_nodes(node)]
            left.extend(reversed(parts))
        self._spread()

    def paths(self, node: ast.AST) -> frozenset[str]:
        """The dotted names of what an expression may stand for; none of what is the text's own, or cannot be seen."""
        found = (f"{path}{rest}" for name, rest in _names(node) for path in self._known(self._key(name)))
        return frozenset(found)

    def _spread(self) -> None:
        """Give each name all that the names assigned to it stand for, until nothing new is found."""
        given_to: dict[Key, list[tuple[Key, str]]] = defaultdict(list)
        left: list[tuple[Key, str]] = []
        for key, each in ((key, each) for key, given in self._bound.items() for each in given):
            if isinstance(each, str):
                left.append((key, each))
                continue
            for name, rest in _names(each):
                given_to[self._key(name)].append((key, rest))
                left += [(key, f"{path}{rest}") for path in self._of_python(self._key(name))]
        while left:
            key, path = left.pop()
            if path not in self._paths[key]:
                self._paths[key].add(path)
                left += [(to, f"{path}{rest}") for to, rest in given_to[key] if path.count(".") < MAX_DOTS or not rest]

    def _key(self, name: ast.Name) -> Key:
        return _home(name.id, self._scopes[name]), name.id

    def _known(self, key: Key) -> Iterable[str]:
        return self._paths.get(key) or self._of_python(key)

    def _of_python(self, key: Key) -> list[str]:
        """The dotted names of a name that the text never binds: a builtin, `__file__`, or one from a star import."""
        home, name = key
        if key in self._bound or _is_bound(name, home):
            return []
        is_known = hasattr(builtins, name) or name == "__file__"
        return [*(f"{module}.{name}" for module in self._everything_of), *[name] * is_known]

    def _bind(self, node: ast.AST, scopes: Scopes, inner: Scopes) -> None:
        """Record the names that a node binds, and to what."""
        match node:
            case ast.Import(names=aliases):
                for alias in aliases:
                    top = alias.name.partition(".")[0]
                    self._give(alias.asname or top, scopes, alias.name if alias.asname else top)
            case ast.ImportFrom(module=str(module), names=aliases, level=0):
                for alias in aliases:
                    if alias.name == "*":
                        self._everything_of.append(module)
                    self._give(alias.asname or alias.name, scopes, f"{module}.{alias.name}")
            case ast.Assign(targets=targets, value=value):
                for target in targets:
                    self._assign(target, value, scopes)
            case ast.AnnAssign(target=target, value=ast.expr() as value) | ast.NamedExpr(target=target, value=value):
                self._assign(target, value, scopes)
            case ast.FunctionDef(args=given) | ast.AsyncFunctionDef(args=given) | ast.Lambda(args=given):
                plain = [*given.posonlyargs, *given.args, *given.kwonlyargs]
                defaults = [*given.defaults, *given.kw_defaults]
                for argument, default in zip(reversed(plain), reversed(defaults), strict=False):
                    if default is not None:
                        self._give(argument.arg, inner, default)

    def _assign(self, target: ast.expr, value: ast.expr, scopes: Scopes) -> None:
        match target, value:
            case ast.Name(id=name), _:
                self._give(name, scopes, value)
            case ((ast.Tuple(elts=targets) | ast.List(elts=targets)), (ast.Tuple(elts=parts) | ast.List(elts=parts))):
                if len(targets) == len(parts):
                    for each, part in zip(targets, parts, strict=True):
                        self._assign(each, part, scopes)

    def _give(self, name: str, scopes: Scopes, what: str | ast.expr) -> None:
        self._bound[_home(name, scopes), name].append(what)


def _names(node: ast.AST) -> Iterator[tuple[ast.Name, str]]:
    """The names that an expression may be, each with the attributes that are taken of it."""
    left = [(node, "")]
    while left:
        match left.pop():
            case ast.Name() as name, rest:
                yield name, rest
            case ast.Attribute(value=value, attr=attribute), rest:
                left.append((value, f".{attribute}{rest}"))
            case ast.IfExp(body=one, orelse=other), rest:
                left += [(one, rest), (other, rest)]
            case ast.NamedExpr(value=value), rest:
                left.append((value, rest))


def _home(name: str, scopes: Scopes) -> symtable.SymbolTable:
    """The scope that a name belongs to: the module's where none around it has one of its own."""
    for scope in reversed(scopes[1:]):
        symbol = _symbol(name, scope)
        if symbol and symbol.is_global():
            break
        if symbol and symbol.is_local() and (scope is scopes[-1] or scope.get_type() != "class"):
            return scope
    return scopes[0]


def _is_bound(name: str, scope: symtable.SymbolTable) -> bool:
    """True if the text itself binds the name in a scope."""
    symbol = _symbol(name, scope)
    return symbol is not None and (symbol.is_local() or symbol.is_assigned() or symbol.is_imported())


def _symbol(name: str, scope: symtable.SymbolTable) -> symtable.Symbol | None:
    try:
        return scope.lookup(name)
    except KeyError:
        return None


def _begun(node: ast.AST, scope: symtable.SymbolTable, used: set[int]) -> Iterator[symtable.SymbolTable]:
    """The scope that a node begins, with that of its type parameters; none where Python makes it part of another."""
    name = node.name if isinstance(node, DEFINITIONS) else UNNAMED.get(type(node), "")
    for child in scope.get_children() if name else ():
        is_its = (child.get_name(), child.get_lineno()) == (name, getattr(node, "lineno", 0))
        if is_its and child.get_id() not in used:
            used.add(child.get_id())
            yield child
            if "type param" in str(child.get_type()).lower():
                yield from _begun(node, child, used)
            return


def _own_parts(node: ast.AST) -> Iterator[ast.AST]:
    """The parts of a node that stand in the scope which it begins; the others stand in that around it."""
    match node:
        case ast.FunctionDef(body=body) | ast.AsyncFunctionDef(body=body) | ast.ClassDef(body=body):
            yield from body
        case ast.Lambda(body=body):
            yield body
        case _ if type(node) in UNNAMED:
            yield from ast.iter_child_nodes(node)


def imports(names: ModuleNames) -> Iterator[tuple[int, str, str, bool]]:
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


def drawn(names: ModuleNames) -> Iterator[tuple[int, str]]:
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


def opened(names: ModuleNames) -> Iterator[tuple[int, str]]:
    """Lines that read a file, and the name that does so; one that only writes is none."""
    is_streaming = any(names.paths(node) & IN_MEMORY for node in ast.walk(names.tree))
    knows_paths = any(module.startswith("pathlib") for _, module, _, _ in imports(names))
    for node in ast.walk(names.tree):
        match node:
            case ast.Name(id="__file__") if "__file__" in names.paths(node):
                yield node.lineno, "__file__"
            case ast.Call(func=func):
                paths = sorted(names.paths(func))
                yield from ((node.lineno, used) for used in paths if _reads(used, node, is_streaming))
                if not paths and isinstance(func, ast.Attribute) and _is_of_a_path(func.attr, node, knows_paths):
                    yield node.lineno, func.attr


def texts(names: ModuleNames) -> Iterator[tuple[int, str]]:
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
    """True if the call of a function named `used` reads a file; not where what it is given may be in memory."""
    last = used.rpartition(".")[2]
    if last == "open":
        return not _writes(_modes(call, 1))
    is_named = not is_streaming or any(isinstance(each, ast.Constant | ast.JoinedStr) for each in call.args[:1])
    is_reader = used.startswith(READERS.get(last, ()))
    return is_reader and is_named and not (last == "load" and used.startswith(STREAMED))


def _is_of_a_path(method: str, call: ast.Call, knows_paths: bool) -> bool:
    """True if a method of an unknown object reads a file; `open` is a path's where the module knows paths."""
    return method in OF_PATHS or (method == "open" and knows_paths and not _writes(_modes(call, 0)))


def _modes(call: ast.Call, place: int) -> list[ast.expr]:
    """The modes or flags that a call of an `open` is given, by keyword or as the argument at a place."""
    return [*call.args[place : place + 1], *(each.value for each in call.keywords if each.arg in ("mode", "flags"))]


def _writes(modes: list[ast.expr]) -> bool:
    """True if the modes or flags of an `open` say that nothing is read."""
    said = [each.value for each in modes if isinstance(each, ast.Constant) and isinstance(each.value, str)]
    flags = {each.attr for mode in modes for each in ast.walk(mode) if isinstance(each, ast.Attribute)}
    return "O_WRONLY" in flags or any(mode.strip("bt")[:1] in {"w", "a", "x"} and "+" not in mode for mode in said)
