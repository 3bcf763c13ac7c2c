"""Conversion of a map to plain data and back, for snapshots of maps.

The data only consist of tuples, lists, dictionaries, strings and numbers, one column for each field
of each class of objects. Columns are filled in by loops that run in C, so unpacking takes a
fraction of the time that reading takes. Unpacking does not execute code from the data.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache, partial
from types import GetSetDescriptorType, MemberDescriptorType
from typing import Any

from . import cross_sections, crosswalks, geodesy, geometry, model, polynomials, signals
from .reader import MapContent

Column = tuple[str, list[Any]]
Group = tuple[str, int, list[Column]]  # name of the class, number of objects, columns of its fields
Packed = list[Group]

_NUMBERS = 0.0, 0.0, 0.0, 1.0
BLANK: dict[type, Callable[[], Any]] = {
    **{
        kind: partial(kind.__new__, kind)
        for kind in (
            MapContent,
            *(model.Road, model.LaneSection, model.Lane, model.LaneKey, model.Link),
            *(model.Junction, model.JunctionConnection),
            *(cross_sections.Shapes, cross_sections.SurfaceStrips, cross_sections.Strip),
            *(signals.Signal, signals.SignalReference, signals.Controller),
            *(crosswalks.Crosswalk, geodesy.GeoReference),
        )
    },
    # where they are compiled there is none without a call of the constructor
    polynomials.Piecewise: partial(polynomials.Piecewise, (), ()),
    geometry.ReferenceLine: partial(geometry.ReferenceLine, (), ()),
    geometry.Line: partial(geometry.Line, *_NUMBERS),
    geometry.Arc: partial(geometry.Arc, *_NUMBERS, 0.0),
    geometry.Spiral: partial(geometry.Spiral, *_NUMBERS, 0.0, 0.0),
    geometry.ParamPoly: partial(geometry.ParamPoly, *_NUMBERS, _NUMBERS, _NUMBERS, 1.0, True),
}
"""Constructor of an empty object, for each class of a map."""

CLASSES: dict[str, Any] = {kind.__name__: kind for kind in BLANK}
_NONE = -1  # the index of `None`


class PackingError(ValueError):
    """The data are not the data of a map."""


def pack(content: MapContent) -> Packed:
    """Return the content of a map as plain data; the `MapContent` comes first.

    Raises:
        PackingError: It contains an object that is not part of a map.
    """
    groups: dict[str, list[Any]] = {}
    for found in _objects(content):
        groups.setdefault(type(found).__name__, []).append(found)
    everything = (each for group in groups.values() for each in group)
    indexes = {id(each): i for i, each in enumerate(everything)}
    return [
        (name, len(group), [_column(group, field, indexes) for field in _fields(name)])
        for name, group in groups.items()
    ]


@cache
def _fields(name: str) -> tuple[str, ...]:
    """Return the fields of a class, which has slots or is compiled."""
    if name not in CLASSES:
        raise PackingError(f"`{name}` is not a part of a map")
    descriptors = (MemberDescriptorType, GetSetDescriptorType)
    members = vars(CLASSES[name]).items()
    return tuple(field for field, found in members if isinstance(found, descriptors))


def _objects(content: MapContent) -> Iterator[Any]:
    """Yield objects before their members, each once, without recursion."""
    seen = {id(content)}
    pending: list[Any] = [content]
    while pending:
        each = pending.pop()
        yield each
        for field in _fields(type(each).__name__):
            for part in _objects_in(getattr(each, field)):
                if id(part) not in seen:
                    seen.add(id(part))
                    pending.append(part)


def _objects_in(value: Any) -> Iterator[Any]:
    kind = type(value)
    for part in value.values() if kind is dict else value if kind in (tuple, list) else (value,):
        if type(part).__module__ != "builtins":
            yield part


def _column(group: list[Any], field: str, indexes: Mapping[int, int]) -> Column:
    """Return the values of a field in the simplest form for all of them."""
    values = [getattr(each, field) for each in group]
    if not any(True for value in values for _ in _objects_in(value)):
        return "plain", values
    kinds = {type(value) for value in values if value is not None}
    if kinds <= BLANK.keys():
        return "objects", [_NONE if value is None else indexes[id(value)] for value in values]
    if kinds == {dict}:
        return "dicts", [{key: indexes[id(each)] for key, each in v.items()} for v in values]
    (kind,) = kinds
    return f"{kind.__name__}s", [
        None if value is None else [indexes[id(each)] for each in value] for value in values
    ]


def unpack(data: Packed) -> MapContent:
    """Return the content of a map from its data.

    Raises:
        PackingError: The data are not those of `pack`; not all errors are detected.
    """
    try:
        return _unpack(data)
    except (AttributeError, IndexError, KeyError, TypeError, ValueError) as error:
        raise PackingError(f"{type(error).__name__}: {error}") from error


def _unpack(data: Packed) -> MapContent:
    objects: list[Any] = []
    for name, count, _ in data:
        make = BLANK[CLASSES[name]]
        objects += [make() for _ in range(count)]
    content = objects[0]
    objects.append(None)  # at `_NONE`
    position = 0
    for name, count, columns in data:
        group = objects[position : position + count]
        position += count
        for field, column in zip(_fields(name), columns, strict=True):
            values = _values(column, objects.__getitem__)
            deque(map(getattr(CLASSES[name], field).__set__, group, values), maxlen=0)
    if not isinstance(content, MapContent):
        raise PackingError("no map")
    return content


def _values(column: Column, object_at: Callable[[int], Any]) -> Iterable[Any]:
    shape, values = column
    match shape:
        case "plain":
            return values
        case "objects":
            return map(object_at, values)
        case "tuples":
            return (None if each is None else tuple(map(object_at, each)) for each in values)
        case "lists":
            return (list(map(object_at, each)) for each in values)
        case "dicts":
            return (dict(zip(each, map(object_at, each.values()), strict=True)) for each in values)
    raise PackingError(f"no shape {shape!r}")
