"""Classes that a module imports from the modules of imported files, instead of holding a copy.

A class is imported if the module of the file that declares it has the very same one: the IR of the
declaration is the same in both programs, and so is that of all it refers to. An `extend` in the
importing file, or constraints of an invocation that reach into the declaration, make another
class of it, which is a copy of the importing module. So no declaration is two classes in one run.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from osc2tx import ir
from osc2tx.backends.py_trees.code import Level, PyExpr
from osc2tx.backends.py_trees.modifier_calls import never_called
from osc2tx.backends.py_trees.naming import NameTable
from osc2tx.backends.py_trees.own_names import Declared, declarations, is_own, key_of, own_names
from osc2tx.backends.py_trees.type_methods import TypeMethods
from osc2tx.backends.py_trees.uses import isort_key
from osc2tx.backends.py_trees.view import ImportView
from osc2tx_shared.classes import dataclass, replace


@dataclass(frozen=True, slots=True)
class Home:
    """Where something that a module imports is defined.

    Attributes:
        source: The file that declares it.
        module: The module of that file, `lib.b`.
        name: Its name there.
    """

    source: str
    module: str
    name: str


@dataclass(frozen=True, slots=True)
class Sharing:
    """Where a module has its classes from.

    Attributes:
        homes: Key of each import, direct or indirect, to the module that defines it.
        copies: Key of each definition that another file declares, to the reason for the copy.
    """

    homes: Mapping[str, Home] = field(default_factory=dict)
    copies: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Sibling:
    """The module of an imported file, as that file alone makes it.

    Attributes:
        name: Its name in imports.
        declared: The declarations of its program.
        sharing: The origins of its classes.
    """

    name: str
    declared: Declarations
    sharing: Sharing


def share(ours: Declarations, siblings: Mapping[str, Sibling], apart: Mapping[str, str]) -> Sharing:
    """Return the imports of a module.

    Args:
        ours: The declarations of its program.
        siblings: The modules that it may import, by the names of their sources.
        apart: The reason why it cannot import the other sources.
    """
    foreign = [key for key, part in ours.parts.items() if not is_own(part, ours.module)]
    shared = {
        key: source
        for key in foreign
        if (source := _source(ours.parts[key])) in siblings
        and ours.is_same(key, siblings[source].declared)
        and not ours.references(key) & siblings[source].sharing.copies.keys()
    }
    while wrong := [key for key in shared if not ours.references(key) <= shared.keys()]:
        for key in wrong:
            del shared[key]
    names = {source: own_names(siblings[source].declared.module) for source in set(shared.values())}
    return Sharing(
        homes={k: Home(s, siblings[s].name, names[s][k].text) for k, s in shared.items()},
        copies={k: _reason(ours.parts[k], apart) for k in foreign if k not in shared},
    )


def _reason(part: Declared, apart: Mapping[str, str]) -> str:
    source = _source(part)
    why = apart.get(source)
    return f"A copy from {source}: " + (why or "here it is not as in that file alone")


def sibling_imports(sharing: Sharing, names: NameTable) -> tuple[ImportView, ...]:
    """Return the import lines for the references of a module to others.

    Args:
        sharing: Where it may have its classes from.
        names: All its names; those that were looked up are in its text.
    """
    found: dict[str, list[tuple[str, str]]] = {}
    for key, home in sharing.homes.items():
        if key in names.looked_up:
            found.setdefault(home.module, []).append((home.name, str(names[key])))
    return tuple(
        ImportView(
            module,
            tuple(_imported(*pair) for pair in sorted(found[module], key=_order)),
            is_long=True,
        )
        for module in sorted(found)
    )


def _order(pair: tuple[str, str]) -> tuple[int, str]:
    return isort_key(pair[0])


def _imported(name: str, alias: str) -> PyExpr:
    return PyExpr(name if name == alias else f"{name} as {alias}", Level.ATOM)


def _source(part: Declared) -> str:
    return part.span.source.name


class Declarations:
    """The declarations of a program, its own and those of imported files.

    Attributes:
        module: Its IR.
        parts: The declarations by key.
    """

    def __init__(self, module: ir.Module) -> None:
        self.module = module
        unwritten = never_called(module)
        parts = {key_of(each): each for each in declarations(module)}
        self.parts = {key: part for key, part in parts.items() if key not in unwritten}
        self._methods = TypeMethods(module.types, (*module.bases, *module.scenarios))
        self._references: dict[str, set[str]] = {}

    def is_same(self, key: str, other: Declarations) -> bool:
        """Whether another module has the same class, or the same function."""
        there = other.parts.get(key)
        return there is not None and ir.same(self._own(self.parts[key]), other._own(there))

    def references(self, key: str) -> set[str]:
        """Return the keys of the references of a class or function, itself left out."""
        if key not in self._references:
            words = set(ir.words(self._own(self.parts[key])))
            found = {other for other, part in self.parts.items() if _mention(part) <= words}
            self._references[key] = found - {key}
        return self._references[key]

    def _own(self, part: Declared) -> Declared:
        """Return a declaration as far as its own class holds it, however it is used."""
        match part:
            case ir.AbstractScenario():
                methods = tuple(each for each in part.methods if each.name not in self._methods)
                part = replace(part, is_imported=False, methods=methods)
                return replace(part, is_invoked=False) if isinstance(part, ir.Scenario) else part
            case ir.UserType():
                methods = tuple(method for _, method in self._methods.of(part.name))
                return replace(part, fields=part.all_fields, unused=(), methods=methods)
            case ir.UserEnum() | ir.UserAction() | ir.UserModifier():
                return part


def _mention(part: Declared) -> set[str]:
    """Return the names that are in every reference to a declaration."""
    match part:
        case ir.AbstractScenario() | ir.UserModifier():
            return {part.key}
        case ir.UserType() | ir.UserEnum():
            return {part.name}
        case ir.UserAction():
            return {part.name} if part.owner is None else {part.owner, part.name}
