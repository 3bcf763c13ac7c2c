"""Names of the runtime library that a module uses, collected while it is written."""

from __future__ import annotations

from collections.abc import Iterable

from osc2tx import ir
from osc2tx.backends.py_trees.code import Level, PyExpr, PyName, literal
from osc2tx.backends.py_trees.naming import NameTable, identifier
from osc2tx.backends.py_trees.view import EnumMemberView, EnumView, ImportView, UnitView

RUNTIME = "osc2tx_runtime"

# The name of all of it, in modules that have classes of the same names.
LIBRARY = "library"


class Uses:
    """Collects names to import and units to define.

    Args:
        names: Names of the module.
    """

    def __init__(self, names: NameTable) -> None:
        """Start with the imports of every module."""
        self._own_names = names
        self.needs_library = False
        self._names = {"require_api"}
        self._modifiers: set[str] = set()
        self._fields: set[str] = set()
        self._standard: dict[str, set[str]] = {}
        self._standard_units: set[str] = set()
        self._own_units: dict[str, ir.Unit] = {}
        self._standard_enums: set[str] = set()
        self._own_enums: dict[str, ir.ValueType] = {}

    def name(self, name: str) -> PyName:
        """Use a public name of the runtime library."""
        self._names.add(name)
        return PyName(name)

    def bounded(self, body: ir.Expression) -> bool:
        """Return whether a method has a budget of calls, and use its decorator if so.

        Calls multiply where a method calls several others.

        Args:
            body: Of the method.
        """
        calls = [part for part in ir.walk(body) if isinstance(part, ir.MethodCall)]
        several = sum(isinstance(call.base, ir.ScenarioSelf) for call in calls) > 1
        if several:
            self.name("bounded")
        return several

    def library(self, name: str) -> PyExpr:
        """Use a class of the runtime library whose name is that of a class of the module."""
        self.needs_library = True
        return PyExpr(f"{LIBRARY}.{PyName(name)}", Level.ATOM)

    def standard(self, module: str, name: str) -> None:
        """Use a name of Python's standard library."""
        self._standard.setdefault(module, set()).add(name)

    def modifier(self, name: str) -> PyName:
        """Use a modifier function."""
        self._modifiers.add(name)
        return PyName(name)

    def fields(self, name: str) -> PyName:
        """Use the type of the keywords of an actor."""
        self._fields.add(name)
        self.standard("typing", "Unpack")
        return PyName(name)

    def physical_type(self, name: str) -> PyName:
        """Use the name of a physical type."""
        self._standard_units.add(name)
        return PyName(name)

    def unit(self, unit: ir.Unit) -> PyName:
        """Use a unit: the runtime's constant, or one that the module defines itself."""
        if unit.is_standard:
            return self.physical_type(identifier(unit.name))
        name = self._name_of_unit(unit)
        self._own_units[name.text] = unit
        return name

    def _name_of_unit(self, unit: ir.Unit) -> PyName:
        """Name a unit that the module defines: after all others, so that no other depends on it."""
        key = f"unit {unit.name}"
        if key in self._own_names:
            return self._own_names[key]
        return self._own_names.add(key, identifier(unit.name), "_unit")

    def enum(self, type_: ir.ValueType, name: PyName) -> PyName:
        """Use an enum by a name: the runtime's type, or one that the module defines itself."""
        if type_.members:
            self._own_enums[name.text] = type_
            self.standard("typing", "Literal")
            self.standard("typing", "TypeAlias")
        else:
            self._standard_enums.add(name.text)
        return name

    def standard_imports(self) -> tuple[ImportView, ...]:
        """Return the import lines for Python's standard library."""
        return tuple(_import(module, names) for module, names in sorted(self._standard.items()))

    def imports(self) -> tuple[ImportView, ...]:
        """Return the import lines, sorted as isort sorts them."""
        groups = (
            (RUNTIME, self._names),
            (f"{RUNTIME}.enums", self._standard_enums),
            (f"{RUNTIME}.fields", self._fields),
            (f"{RUNTIME}.modifiers", self._modifiers),
            (f"{RUNTIME}.units", self._standard_units),
        )
        return tuple(_import(module, names, module == RUNTIME) for module, names in groups if names)

    def units(self) -> tuple[UnitView, ...]:
        """Return the units that the module defines, by name."""
        return tuple(
            UnitView(PyName(name), literal(unit.factor))
            for name, unit in sorted(self._own_units.items())
        )

    def enums(self) -> tuple[EnumView, ...]:
        """Return the enums that the module defines, by name."""
        return tuple(
            EnumView(PyName(name), tuple(EnumMemberView(literal(each)) for each in type_.members))
            for name, type_ in sorted(self._own_enums.items())
        )


def _import(module: str, names: Iterable[str], is_long: bool = False) -> ImportView:
    return ImportView(module, tuple(map(PyName, sorted(names, key=isort_key))), is_long)


def isort_key(name: str) -> tuple[int, str]:
    """Constants, then classes, then the rest: the order of isort and ruff."""
    if name.isupper() and len(name) > 1:
        return 0, name
    return (1 if name[:1].isupper() else 2), name
