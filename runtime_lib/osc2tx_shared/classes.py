"""`dataclass` as of the standard library, but cheaper to declare and faster to construct.

The decorator of the standard library inspects each class, and writes and compiles six methods for
it when its module is imported: a third of a millisecond each. osc2tx has three hundred classes and
its runtime two hundred, of which a run uses a few. Here a constructor is created on its first call,
from code shared by all classes with fields of the same kinds, and all classes share the other
methods. Constructors of frozen classes fill the slots directly, in half the time.

All else is as in `dataclasses`: `field`, `fields`, `replace`, inheritance from classes of either
kind, pickling, `FrozenInstanceError`. Type checkers see the decorator of the standard library.
Supported options are those in the signature; `field(init=…, repr=…, hash=…, compare=…)` is,
`InitVar` and `KW_ONLY` are not.
"""

from __future__ import annotations

import dataclasses
from dataclasses import MISSING, Field, FrozenInstanceError
from inspect import get_annotations
from operator import attrgetter
from types import CodeType, FunctionType, GetSetDescriptorType, MemberDescriptorType
from typing import TYPE_CHECKING, Any

__all__ = ["dataclass", "replace"]

if TYPE_CHECKING:
    from dataclasses import dataclass, replace
else:

    def dataclass(cls=None, /, *, frozen=False, slots=False, kw_only=False, eq=True, repr=True):
        """Return a class decorator, or the decorated class."""

        def decorate(cls):
            if cls.__doc__ is None:
                cls.__doc__ = cls.__qualname__  # the default is the signature, which is slow
            fields = _fields(cls, frozen, slots, kw_only)
            content = _content(cls, fields, frozen, slots, eq, repr)
            if slots:
                return _with_slots(cls, content)
            for name, each in content.items():
                setattr(cls, name, each)
            return cls

        return decorate if cls is None else decorate(cls)

    def replace(instance, /, **changes):
        """Return a copy with other values: `dataclasses.replace` in a third of the time."""
        cls = type(instance)
        read = _READERS.get(cls) or _reader(cls)
        return cls(**{**read(instance), **changes})


def complete(
    cls: Any,
    declared: dict[str, tuple[str, dict[str, Any]]],
    *,
    frozen: bool,
    eq: bool,
    repr: bool,
) -> None:
    """Add what the decorator adds to a compiled class whose constructor is written out.

    Args:
        cls: The class.
        declared: The annotation of each field, and the arguments of `field`.
        frozen: As for the decorator, like the next ones.
        eq: Whether instances are compared by their fields; the class has the methods.
        repr: Whether to add a `__repr__`.
    """
    fields: dict[str, Any] = {}
    for name, (annotation, settings) in declared.items():
        field: Any = dataclasses.field(**settings)
        field.name, field.type, field._field_type = name, annotation, _FIELD
        fields[name] = field
    content = _content(cls, fields, frozen, True, eq, repr)
    for name, each in (content | {"__getstate__": _get_state, "__setstate__": _set_state}).items():
        setattr(cls, name, each)


def _content(
    cls: Any, fields: dict[str, Any], frozen: bool, slots: bool, eq: bool, repr: bool
) -> dict[str, Any]:
    """Return what the decorator adds to a class, by name."""
    own = list(fields.values())
    methods: dict[str, Any] = {
        "__init__": _init_first,
        "__signature__": _SIGNATURE,
        "__match_args__": tuple([f.name for f in own if f.init and not f.kw_only]),
    }
    if repr:
        methods["__repr__"] = _repr
    if eq:
        methods["__eq__"] = _eq
        methods["__hash__"] = _hash if frozen else None
    if frozen:
        methods["__setattr__"] = methods["__delattr__"] = _refuse
        if slots:
            methods |= {"__getstate__": _get_state, "__setstate__": _set_state}
    content = {name: each for name, each in methods.items() if name not in cls.__dict__}
    content["__dataclass_fields__"] = fields
    content["__dataclass_params__"] = _FROZEN if frozen else _NOT_FROZEN
    if eq:
        compared = [f.name for f in own if f.compare]
        content["_compared"] = attrgetter(*compared) if compared else staticmethod(_nothing)
    return content


_READERS: dict[type, Any] = {}
"""Functions that return the keyword arguments of an instance, by replaced class."""


def _reader(cls: Any) -> Any:
    given = [field.name for field in dataclasses.fields(cls) if field.init]
    names = ", ".join(f"{name!r}: instance.{name}" for name in given)
    _READERS[cls] = eval(f"lambda instance: {{{names}}}")
    return _READERS[cls]


@dataclasses.dataclass
class _Sample:
    x: int


_FIELD: Any = _Sample.__dataclass_fields__["x"]._field_type  # type: ignore[attr-defined]
"""The mark of a field, as opposed to a class variable."""


class _Parameters:
    """The attribute of base classes that the decorator of the standard library reads."""

    __slots__ = ("frozen",)

    def __init__(self, frozen: bool) -> None:
        self.frozen = frozen


_FROZEN, _NOT_FROZEN = _Parameters(True), _Parameters(False)


def _fields(cls: Any, frozen: bool, slots: bool, kw_only: bool) -> dict[str, Any]:
    """Return the fields of a class; without slots, their defaults become its attributes."""
    found: dict[str, Any] = {}
    for base in cls.__mro__[-1:0:-1]:
        if "__dataclass_params__" in base.__dict__:
            if base.__dataclass_params__.frozen != frozen:
                kinds = ("frozen", "non-frozen") if frozen else ("non-frozen", "frozen")
                raise TypeError("cannot inherit {} dataclass from a {} one".format(*kinds))
            found.update(base.__dataclass_fields__)
    own = {
        name: _field(cls, name, annotation, kw_only)
        for name, annotation in get_annotations(cls).items()
        if not (isinstance(annotation, str) and annotation.startswith("ClassVar"))
    }
    for name, field in () if slots else own.items():
        if field.default is not MISSING:
            setattr(cls, name, field.default)
        elif name in cls.__dict__:
            delattr(cls, name)
    return found | own


def _field(cls: Any, name: str, annotation: object, kw_only: bool) -> Any:
    default = cls.__dict__.get(name, MISSING)
    field: Any = default if isinstance(default, Field) else dataclasses.field(default=default)
    if field.default.__class__.__hash__ is None:
        raise ValueError(f"mutable default {type(field.default)} for field {name} is not allowed")
    field.name, field.type, field._field_type = name, annotation, _FIELD
    if field.kw_only is MISSING:
        field.kw_only = kw_only
    return field


_PLACES = MemberDescriptorType, GetSetDescriptorType
"""What reads and writes a slot, and a field of a compiled class."""


def _with_slots(cls: Any, methods: dict[str, Any]) -> Any:
    """Return a class like another one, with slots instead of a `__dict__`, and with methods."""
    fields = methods["__dataclass_fields__"]
    inherited = {
        name
        for base in cls.__mro__[1:-1]
        for name, each in base.__dict__.items()
        if isinstance(each, _PLACES)
    }
    content = {name: value for name, value in cls.__dict__.items() if name not in fields}
    content.pop("__dict__", None)
    content.pop("__weakref__", None)
    content |= methods
    content["__slots__"] = tuple([name for name in fields if name not in inherited])
    made = type(cls)(cls.__name__, cls.__bases__, content)
    made.__qualname__ = cls.__qualname__
    return made


class _Signature:
    """The attribute that `inspect.signature` of a class reads."""

    def __get__(self, instance: object, cls: Any) -> Any:
        from inspect import signature  # rarely used

        if cls.__init__ is _init_first:
            owner = _owner(cls)
            owner.__init__ = _constructor(owner)
        found = signature(cls.__init__)
        return found.replace(parameters=list(found.parameters.values())[1:])


_SIGNATURE = _Signature()


def _owner(cls: Any) -> Any:
    """Return the class whose constructor is not compiled yet."""
    return next(each for each in cls.__mro__ if each.__dict__.get("__init__") is _init_first)


def _init_first(self: Any, /, *positional: object, **named: object) -> None:
    """Compile the constructor of a class, and use it from then."""
    cls = _owner(type(self))
    constructor = cls.__init__ = _constructor(cls)
    constructor(self, *positional, **named)


_CODES: dict[tuple[object, ...], CodeType] = {}
"""The code of constructors, by the kinds of their fields; field number 3 is called `_3` in it."""


def _constructor(cls: Any) -> Any:
    scope: dict[str, Any] = {"_MISSING": MISSING}
    is_frozen, has_post_init = cls.__setattr__ is _refuse, hasattr(cls, "__post_init__")
    kinds: list[tuple[bool, bool]] = []
    names: dict[str, str] = {}
    defaults: dict[Any, dict[str, Any]] = {False: {}, True: {}}
    fields = sorted(dataclasses.fields(cls), key=_is_named)
    for field in fields:
        number = len(kinds)
        has_default, is_made = field.default is not MISSING, field.default_factory is not MISSING
        if not (field.init or has_default or is_made):
            continue  # left to `__post_init__`
        if is_made:
            scope[f"_make_{number}"] = field.default_factory
        elif has_default:
            scope[f"_default_{number}"] = field.default
        if field.init and (has_default or is_made):
            defaults[field.kw_only][field.name] = field.default
        if is_frozen:
            scope[f"_set_{number}"] = _setter(cls, field.name)
        names[f"_{number}"] = field.name
        kinds.append((field.init, is_made))
    key = (is_frozen, has_post_init, *kinds)
    code = _CODES.get(key) or _CODES.setdefault(key, _code(is_frozen, has_post_init, *kinds))
    named = sum(1 for field in fields if field.init and field.kw_only)
    own = code.replace(
        co_argcount=code.co_argcount - named,
        co_kwonlyargcount=named,
        co_varnames=tuple([names.get(name, name) for name in code.co_varnames]),
        co_names=tuple([names.get(name, name) for name in code.co_names]),
        co_qualname=f"{cls.__qualname__}.__init__",
    )
    made = FunctionType(own, scope, "__init__", tuple(defaults[False].values()))
    made.__kwdefaults__ = defaults[True]
    return made


_is_named = attrgetter("kw_only")


def _code(is_frozen: bool, has_post_init: bool, *kinds: tuple[bool, bool]) -> CodeType:
    """Return the code of the constructors of all classes with fields of these kinds.

    All its parameters are positional: a constructor has as many of the last ones by name as it has
    fields for keywords alone.
    """
    parameters, lines = ["self"], ["pass"]
    for number, (is_parameter, is_made) in enumerate(kinds):
        name = f"_{number}"
        value = name if is_parameter else f"_default{name}"
        if is_made:
            value = f"_make{name}()"
            if is_parameter:
                value += f" if {name} is _MISSING else {name}"
        if is_parameter:
            parameters.append(name)
        lines.append(f"_set{name}(self, {value})" if is_frozen else f"self.{name} = {value}")
    if has_post_init:
        lines.append("self.__post_init__()")
    scope: dict[str, Any] = {}
    exec(f"def __init__({', '.join(parameters)}):\n " + "\n ".join(lines), scope)
    code: CodeType = scope["__init__"].__code__
    return code


def _setter(cls: type, name: str) -> Any:
    """Return what writes a field past the guard of a frozen class."""
    slot: Any = getattr(cls, name, None)
    if hasattr(slot, "__set__"):
        return slot.__set__
    return lambda self, value: object.__setattr__(self, name, value)


def _repr(self: Any) -> str:
    shown = [f"{f.name}={getattr(self, f.name)!r}" for f in dataclasses.fields(self) if f.repr]
    return f"{type(self).__qualname__}({', '.join(shown)})"


def _eq(self: Any, other: Any) -> Any:
    if other is self:
        return True
    kind = type(other)
    if kind is not type(self):  # another class of ours would not know better
        return False if kind.__eq__ is type(self).__eq__ else NotImplemented
    return self._compared(self) == self._compared(other)


def _hash(self: Any) -> int:
    return hash(self._compared(self))


def _nothing(self: object) -> tuple[()]:
    return ()


def _refuse(self: object, name: str, value: object = None) -> None:
    raise FrozenInstanceError(f"cannot assign to field {name!r}")


def _get_state(self: Any) -> list[object]:
    return [getattr(self, field.name) for field in dataclasses.fields(self)]


def _set_state(self: Any, state: list[object]) -> None:
    for field, value in zip(dataclasses.fields(self), state, strict=True):
        object.__setattr__(self, field.name, value)
