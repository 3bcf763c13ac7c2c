"""Refuses objects, actors and values of structs, that no world can make as they are declared."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from osc2tx import ir
from osc2tx.catalogue import object_tables
from osc2tx.catalogue.constructors import (
    ACTOR_CLASSES,
    ROOT,
    STRUCT_CLASSES,
    constructor_path,
    is_completed,
    list_element,
    nested_object,
)
from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx_shared.classes import dataclass, replace


@dataclass(frozen=True, slots=True)
class _Object:
    """An object, or a member that is an object itself; `name` is its path."""

    name: str
    span: Span
    lineage: tuple[str, ...]
    values: tuple[ir.FieldValue, ...]

    def member(self, field: str, lineage: tuple[str, ...]) -> _Object:
        below = tuple(
            replace(v, path=v.path[1:]) for v in self.values if v.path[0] == field and v.path[1:]
        )
        return _Object(f"{self.name}.{field}", self.span, lineage, below)


class ObjectCheck:
    """Checks objects against the constructors of the runtime.

    Args:
        own: The module's own types.
        sink: Receives reports.
    """

    def __init__(self, own: Mapping[str, ir.UserType], sink: DiagnosticSink) -> None:
        self._own = own
        self._tables = object_tables()
        self._sink = sink

    def check(self, declaration: ir.Declaration) -> None:
        """Check a declared object that is no other value as a whole."""
        match declaration:
            case ir.Actor(is_given=False) | ir.Struct(value=None):
                pass
            case _:
                return
        is_actor = isinstance(declaration, ir.Actor)
        known: Mapping[str, str] = ACTOR_CLASSES if is_actor else STRUCT_CLASSES
        self._object(
            _Object(
                declaration.name, declaration.span, declaration.lineage, tuple(declaration.values)
            ),
            known,
        )

    def _object(self, object_: _Object, classes: Mapping[str, str]) -> None:
        kind = next((name for name in object_.lineage if name in classes), None)
        is_own = object_.lineage[0] in self._own and object_.lineage[-1] in {*self._own, ROOT}
        is_own = is_own and kind is None
        if not is_own and (kind is None or kind not in self._tables.objects):
            self._sink.report(
                "OSC501",
                object_.span,
                f"the runtime has no objects of type `{object_.lineage[0]}`",
            )
            return
        objects = {field.name: field for field in self._object_fields(object_.lineage)}
        for field in objects.values():
            is_whole = any(value.path == (field.name,) for value in object_.values)
            if not is_whole:
                member = object_.member(field.name, ir.lineage(field.type.name, self._own))
                self._object(member, STRUCT_CLASSES)
        for value in object_.values:
            if value.path[0] in objects or self._is_own(object_.lineage, value.path):
                continue
            if kind is None or not self._can_fix(kind, object_.lineage, value.path):
                self._sink.report(
                    "OSC502",
                    value.span,
                    f"the runtime cannot fix `{'.'.join(value.path)}` of a `{object_.lineage[0]}`",
                    help="the runtime determines it: read it, or omit the constraint",
                )
        for name in dict.fromkeys(value.path[0] for value in object_.values if value.path[1:]):
            inner = nested_object(object_.lineage, name)
            if inner is not None and not is_completed(object_.lineage, name):
                self._needed(object_.member(name, (inner,)), inner)
        if kind is not None and classes is STRUCT_CLASSES:
            self._needed(object_, kind)

    def _object_fields(self, lineage: Sequence[str]) -> Iterator[ir.UserField]:
        for type_ in lineage:
            if type_ in self._own:
                fields = self._own[type_].fields
                yield from (field for field in fields if field.type.kind is ir.Kind.STRUCT)

    def _is_own(self, lineage: Sequence[str], path: tuple[str, ...]) -> bool:
        types = [self._own[name] for name in lineage if name in self._own]
        names = {field.name for type_ in types for field in type_.fields}
        return len(path) == 1 and path[0] in names

    def _can_fix(self, kind: str, lineage: Sequence[str], path: tuple[str, ...]) -> bool:
        """Whether a constructor takes a member."""
        member, *below = constructor_path(lineage, path)
        element = list_element(lineage, member) if below else None
        if element is not None:
            inside = tuple(below[1:])  # behind the number
            return not inside or (bool(element) and self._can_fix(element[0], element, inside))
        inner = nested_object(lineage, member)
        if inner is not None and below:
            return self._can_fix(inner, (inner,), tuple(below))
        return not below and member in self._tables.objects[kind]

    def _needed(self, object_: _Object, kind: str) -> None:
        """Report members that a value cannot do without."""
        given = {constructor_path(object_.lineage, value.path)[0] for value in object_.values}
        missing = ", ".join(f"`{name}`" for name in sorted(self._tables.needed[kind] - given))
        if missing:
            self._sink.report(
                "OSC501",
                object_.span,
                f"`{object_.name}` does not state its {missing}",
                help="give it a whole value, or `keep(it.member == value)` for each member",
            )
