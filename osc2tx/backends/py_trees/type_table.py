"""The types that a module knows: its own classes, and those of the runtime."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence

from osc2tx import ir
from osc2tx.backends.py_trees.code import Level, PyExpr, PyName, literal, name_expression
from osc2tx.backends.py_trees.naming import NameTable, class_name, identifier
from osc2tx.backends.py_trees.runtime_api import (
    ABSTRACT_TYPES,
    ACTOR_FIELDS,
    ANNOTATIONS,
    PHYSICAL_TYPES,
)
from osc2tx.backends.py_trees.uses import Uses
from osc2tx.catalogue import object_tables
from osc2tx.catalogue.constructors import (
    ACTOR_CLASSES,
    ROOT,
    STRUCT_CLASSES,
)

_CONCRETE = {**ACTOR_CLASSES, **STRUCT_CLASSES}
CLASSES = {**_CONCRETE, **{name: _CONCRETE[above] for name, above in ABSTRACT_TYPES.items()}}

# The type that all actors derive from.


def class_key(type_: str) -> str:
    """Return the key of a type in the table of the module's classes."""
    return f"type {type_}"


def enum_key(name: str, members: Sequence[str]) -> str:
    """Return the key of an enum in the same table: extended, it is another one."""
    return f"enum {name}: {', '.join(members)}"


class TypeTable:
    """Names classes and annotations, and knows the fields of the module's own types.

    Args:
        own: The module's own types, bases first.
        classes: Names of the module's classes.
        uses: Collects the imports of the module.
        imported: Keys of its imports from other modules.
    """

    def __init__(
        self,
        own: Sequence[ir.UserType],
        classes: NameTable,
        uses: Uses,
        imported: Container[str] = (),
    ) -> None:
        self._imported = imported
        self._own = {each.name: each for each in own}
        self._lineages = ir.lineages(own)
        self._classes = classes
        self._uses = uses
        self._taken = {each.name: self._members_taken(each) for each in own}

    def class_of(self, lineage: Sequence[str]) -> PyName:
        """Name the class of an object, the first type of its lineage that has one."""
        if class_key(lineage[0]) in self._classes:
            return self._classes[class_key(lineage[0])]
        return self._uses.name(next(CLASSES[name] for name in lineage if name in CLASSES))

    def runtime_class(self, name: str) -> PyName:
        """Name a class of the runtime."""
        return self._uses.name(name)

    def class_or_object(self, type_: str) -> PyName:
        """Name the class of a type; `object` if the module has none of it."""
        lineage = self.lineage(type_)
        if lineage[-1] == ROOT and not self._is_known(lineage):
            return self._uses.name("Actor")
        return self.class_of(lineage) if self._is_known(lineage) else PyName("object")

    def is_object(self, own: ir.UserType) -> bool:
        """Whether an own type is one of objects that are declared, not of values."""
        return own.is_actor or self._of_library(own) in object_tables().declared

    def _members_taken(self, own: ir.UserType) -> frozenset[str]:
        if not self.is_object(own):
            return _seen_by_class(own)
        tables = object_tables()
        members = tables.reserved if own.is_actor else tables.declared[self._of_library(own)]
        return members | {"fields", "self"}

    def _of_library(self, own: ir.UserType) -> str:
        """Name the type of the library from which an own type derives; empty if there is none."""
        names = [name for name in self.lineage(own.name) if name in CLASSES]
        return ABSTRACT_TYPES.get(names[0], names[0]) if names else ""

    def bases_of(self, own: ir.UserType) -> tuple[PyName | PyExpr, ...]:
        """Name the base classes of an own type; an actor of no special kind is an `Actor`."""
        if own.is_of_library:
            inherited = tuple(self.class_of((base,)) for base in own.bases)
            return (*inherited, self._uses.library(CLASSES[own.name]))
        if own.is_actor and own.bases in ((), (ROOT,)):
            return (self._uses.name("Actor"),)
        lineages = map(self.lineage, own.bases)
        return tuple(self.class_of(lineage) for lineage in lineages if self._is_known(lineage))

    def _is_known(self, lineage: Sequence[str]) -> bool:
        return class_key(lineage[0]) in self._classes or any(name in CLASSES for name in lineage)

    def kinds_of(self, own: ir.UserType) -> tuple[tuple[str, ...], PyName | PyExpr | None]:
        """Return the kinds that an own type adds, and the class whose kinds follow."""
        bases = self.bases_of(own)
        if own.is_of_library:
            return (), None
        if len(bases) < 2:
            return (own.name,), next(iter(bases), None)
        lineages = [self.lineage(base) for base in own.bases]
        above = next(name for name in lineages[0] if all(name in each for each in lineages))
        names = self.lineage(own.name)
        return names[: names.index(above)], self.class_or_object(above)

    def member(self, owner: str, name: str) -> PyName:
        """Name a member of an object.

        A member of an own actor must not hide one of the runtime, a member of a struct not a name
        that the body of its class reads: the fields below a field `m` would take it for the unit.
        """
        wanted = identifier(name)
        own = self._own.get(owner)
        if own is None or (own.is_of_library and not own.has(name)):
            return PyName(wanted)
        return PyName(f"{wanted}_" if wanted in self._taken[owner] else wanted)

    def annotation(self, type_: ir.ValueType | None, later: frozenset[str] = frozenset()) -> PyExpr:
        """Write a type; `None` is the type of a call without a result.

        Args:
            type_: The type.
            later: Own types whose classes are defined below it.
        """
        if type_ is None:
            return PyExpr("object", Level.ATOM)
        if type_.element is not None:
            is_list = type_.kind is ir.Kind.LIST
            outer = "list" if is_list else str(self._uses.name("Range"))
            return PyExpr(f"{outer}[{self.annotation(type_.element, later)}]", Level.ATOM)
        if type_.kind is ir.Kind.ENUM:
            name = self._enum_name(type_)
            if enum_key(type_.name, type_.members) in self._imported:
                return name_expression(name)
            return name_expression(self._uses.enum(type_, name))
        if type_.name in PHYSICAL_TYPES:
            return name_expression(self._uses.physical_type(PHYSICAL_TYPES[type_.name]))
        plain = ANNOTATIONS.get(type_.kind.value)
        if plain is not None:
            return name_expression(PyName(plain))
        name = self.class_or_object(type_.name)
        return literal(str(name)) if type_.name in later else name_expression(name)

    def _enum_name(self, type_: ir.ValueType) -> PyName:
        """Name an enum: as the runtime does, or as is free in the module."""
        wanted = class_name(type_.name)
        if not type_.members:
            return PyName(wanted)
        key = enum_key(type_.name, type_.members)
        if key not in self._classes:
            self._classes.add(key, wanted, "Enum")
        return self._classes[key]

    def field(self, lineage: Sequence[str], name: str) -> ir.UserField | None:
        """Return a field that an own type of a lineage declares."""
        return next((field for field in self.fields(lineage) if field.name == name), None)

    def fields(self, lineage: Sequence[str]) -> Iterator[ir.UserField]:
        """Yield the fields that own types of a lineage declare, bases first."""
        return (field for _, field in self.owned_fields(lineage))

    def owned_fields(self, lineage: Sequence[str]) -> Iterator[tuple[str, ir.UserField]]:
        """Yield the same, each with the type that declares it."""
        for type_ in reversed(lineage):
            if type_ in self._own:
                yield from ((type_, field) for field in self._own[type_].fields)

    def fields_type(self, lineage: Sequence[str]) -> PyName | None:
        """Name the type of the keywords that the runtime takes for an actor; `None` if none."""
        own = {each.name for each in self._own.values() if not each.is_of_library}
        above = (CLASSES[name] for name in lineage if name in CLASSES and name not in own)
        library = next(above, "Actor")
        if not self._own[lineage[0]].is_actor or library not in ACTOR_FIELDS:
            return None
        return self._uses.fields(ACTOR_FIELDS[library])

    def all_fields_above(self, lineage: Sequence[str]) -> Iterator[tuple[str, ir.UserField]]:
        """Yield the fields of the own bases of a type, each with the type that declares it."""
        for base in reversed(lineage[1:]):
            if base in self._own:
                yield from ((base, field) for field in self._own[base].all_fields)

    def lineage(self, type_: str) -> tuple[str, ...]:
        """Return a type and its bases, up to the first one of the library."""
        return self._lineages.get(type_, (type_,))


def _seen_by_class(own: ir.UserType) -> frozenset[str]:
    """Return the names that annotations and defaults in the class of a struct use."""
    names = {
        *ANNOTATIONS.values(),
        "list",
        "dataclass",
        *CLASSES.values(),
        "Range",
        "not_given",
        "bounded",
    }
    fields = own.all_fields
    names.update(class_name(f.type.name) for f in fields if f.type.kind is ir.Kind.ENUM)
    parameters = [each for method in own.methods for each in method.parameters]
    defaults = [*(each.default for each in fields), *(each.default for each in parameters)]
    for part in (part for each in defaults if each is not None for part in ir.walk(each)):
        if isinstance(part, ir.Quantity):
            names.add(identifier(part.unit.name))
    return frozenset(names)
