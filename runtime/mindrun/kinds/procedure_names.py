"""What the names in the text of a module stand for: other modules and what is in them, each name in its own scope."""

import ast
import builtins
import symtable
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

Key = tuple[symtable.SymbolTable, str]  # the scope that a name belongs to, and the name
Scopes = tuple[symtable.SymbolTable, ...]  # of a module, and of what is in it around a place, the inmost last
DEFINITIONS = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef
COMPREHENSIONS: dict[type[ast.AST], str] = {
    ast.ListComp: "listcomp",
    ast.SetComp: "setcomp",
    ast.DictComp: "dictcomp",
    ast.GeneratorExp: "genexpr",
}  # and what symtable calls their scopes
MAX_DOTS = 6  # in what a name is found to stand for: x = x.next has no end


@dataclass(slots=True)
class Names:
    """The names of a module's text; which of them are whose says Python's own table of symbols."""

    tree: ast.Module
    table: symtable.SymbolTable
    imported: set[str] = field(default_factory=set)  # dotted names of all that is imported
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
        """Let each name stand for what the names stand for that it is given."""
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
        """What a name is to which the text gives nothing."""
        home, name = key
        if key in self._bound or _is_bound(name, home):
            return []
        is_known = hasattr(builtins, name) or name == "__file__"
        return [*(f"{module}.{name}" for module in self._everything_of), *[name] * is_known]

    def _bind(self, node: ast.AST, scopes: Scopes, inner: Scopes) -> None:
        """Remember what a node makes names stand for."""
        match node:
            case ast.Import(names=aliases):
                for alias in aliases:
                    top = alias.name.partition(".")[0]
                    self._give(alias.asname or top, scopes, alias.name if alias.asname else top)
                    self.imported.add(alias.name)
            case ast.ImportFrom(module=str(module), names=aliases, level=0):
                for alias in aliases:
                    if alias.name == "*":
                        self._everything_of.append(module)
                    self._give(alias.asname or alias.name, scopes, f"{module}.{alias.name}")
                    self.imported.add(f"{module}.{alias.name}")
            case ast.Assign(targets=targets, value=value):
                for target in targets:
                    self._assign(target, value, scopes)
            case ast.AnnAssign(target=target, value=ast.expr() as value) | ast.NamedExpr(target=target, value=value):
                self._assign(target, value, scopes)
            case ast.FunctionDef(args=given) | ast.AsyncFunctionDef(args=given) | ast.Lambda(args=given):
                plain = [*given.posonlyargs, *given.args][-len(given.defaults) :] if given.defaults else []
                pairs = [
                    *zip(plain, given.defaults, strict=True),
                    *zip(given.kwonlyargs, given.kw_defaults, strict=True),
                ]
                for argument, default in pairs:
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
    """The names of which an expression is one, each with the attributes that are taken of it."""
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
    """Whether the text itself gives the name a value in a scope."""
    symbol = _symbol(name, scope)
    return symbol is not None and (symbol.is_local() or symbol.is_assigned() or symbol.is_imported())


def _symbol(name: str, scope: symtable.SymbolTable) -> symtable.Symbol | None:
    try:
        return scope.lookup(name)
    except KeyError:
        return None


def _begun(node: ast.AST, scope: symtable.SymbolTable, used: set[int]) -> Iterator[symtable.SymbolTable]:
    """The scope that a node begins, with that of its type parameters; none where Python makes it part of another."""
    name = "lambda" if isinstance(node, ast.Lambda) else COMPREHENSIONS.get(type(node), "")
    name = node.name if isinstance(node, DEFINITIONS) else name
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
        case _ if type(node) in COMPREHENSIONS:
            yield from ast.iter_child_nodes(node)
