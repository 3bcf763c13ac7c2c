"""`dataclass` as of the standard library, but cheap to declare and quicker to construct.

The decorator of the standard library writes and compiles six methods for each class when its module
is imported: a third of a millisecond each. osc2tx has three hundred classes and its runtime two
hundred, of which a run needs a few. Here a constructor is compiled when it is first called, and the
others are shared by all classes. Constructors of frozen classes fill the slots directly, in half
the time.

Everything else is as with `dataclasses`: `field`, `fields`, `replace`, inheritance from classes of
either kind, pickling, `FrozenInstanceError`. Type checkers see the decorator of the standard
library. Supported options are those in the signature; `field(init=…, repr=…, hash=…, compare=…)`
is, `InitVar` is not.
"""

from __future__ import annotations

import dataclasses
from dataclasses import MISSING, FrozenInstanceError
from operator import attrgetter
from typing import TYPE_CHECKING, Any

__all__ = ["dataclass", "replace"]

if TYPE_CHECKING:
    from dataclasses import dataclass, replace
else:

    def dataclass(cls=None, /, *, frozen=False, slots=False, kw_only=False, eq=True, repr=True):
        """Return a class decorator, or the decorated class."""

        def decorate(cls):
            if cls.__doc__ is None:
                cls.__doc__ = cls.__qualname__  # else it would be the signature, which is slow
            made = _bare(cls, frozen, slots, kw_only)
            methods = {"__init__": _init_first, "__signature__": _Signature()}
            if repr:
                methods["__repr__"] = _repr
            if eq:
                compared = [f.name for f in dataclasses.fields(made) if f.compare]
                made._compared = attrgetter(*compared) if compared else staticmethod(_nothing)
                methods["__eq__"] = _eq
                if "__hash__" not in cls.__dict__:
                    made.__hash__ = _hash if frozen else None
            if frozen:
                methods["__setattr__"] = methods["__delattr__"] = _refuse
                if slots:
                    methods |= {"__getstate__": _get_state, "__setstate__": _set_state}
            for name, method in methods.items():
                if name not in cls.__dict__:
                    setattr(made, name, method)
            return made

        return decorate if cls is None else decorate(cls)

    def replace(instance, /, **changes):
        """Return a copy with other values: `dataclasses.replace` in a third of the time."""
        cls = type(instance)
        read = _READERS.get(cls) or _reader(cls)
        return cls(**{**read(instance), **changes})


_READERS: dict[type, Any] = {}
"""What makes keyword arguments of an instance, for each class of which one was replaced."""


def _reader(cls: Any) -> Any:
    given = [field.name for field in dataclasses.fields(cls) if field.init]
    names = ", ".join(f"{name!r}: instance.{name}" for name in given)
    _READERS[cls] = eval(f"lambda instance: {{{names}}}")
    return _READERS[cls]


def _bare(cls: Any, frozen: bool, slots: bool, kw_only: bool) -> Any:
    """Return the class with its fields and slots, and without methods.

    Asked for a frozen class, the standard library would compile two methods. So it is asked for
    another, and meanwhile the bases must not be frozen either.
    """
    bases = [base for base in cls.__mro__[1:] if "__dataclass_params__" in base.__dict__]
    states = [base.__dataclass_params__.frozen for base in bases]
    if bases and any(states) != frozen:
        kinds = ("frozen", "non-frozen") if frozen else ("non-frozen", "frozen")
        raise TypeError("cannot inherit {} dataclass from a {} one".format(*kinds))
    try:
        for base in bases:
            base.__dataclass_params__.frozen = False
        made: Any = dataclasses.dataclass(
            cls, init=False, repr=False, eq=False, slots=slots, kw_only=kw_only
        )
    finally:
        for base, state in zip(bases, states, strict=True):
            base.__dataclass_params__.frozen = state
    made.__dataclass_params__.frozen = frozen
    return made


class _Signature:
    """What `inspect.signature` of a class reads."""

    def __get__(self, instance: object, cls: Any) -> Any:
        from inspect import signature  # loaded by few

        if cls.__init__ is _init_first:
            owner = _owner(cls)
            owner.__init__ = _constructor(owner)
        found = signature(cls.__init__)
        return found.replace(parameters=list(found.parameters.values())[1:])


def _owner(cls: Any) -> Any:
    """Return the class of which one has the constructor that is not compiled yet."""
    return next(each for each in cls.__mro__ if each.__dict__.get("__init__") is _init_first)


def _init_first(self: Any, /, *positional: object, **named: object) -> None:
    """Compile the constructor of a class, and from then on use it."""
    cls = _owner(type(self))
    constructor = cls.__init__ = _constructor(cls)
    constructor(self, *positional, **named)


def _constructor(cls: Any) -> Any:
    scope: dict[str, Any] = {"_MISSING": MISSING}
    positional, named, lines = ["self"], ["*"], ["pass"]
    is_frozen = cls.__setattr__ is _refuse
    for field in dataclasses.fields(cls):
        name = value = field.name
        parameter = name
        if field.default_factory is not MISSING:
            scope[f"_make_{name}"] = field.default_factory
            value = f"_make_{name}()"
            if field.init:
                parameter += "=_MISSING"
                value = f"{value} if {name} is _MISSING else {name}"
        elif field.default is not MISSING:
            scope[f"_default_{name}"] = field.default
            parameter += f"=_default_{name}"
            value = name if field.init else f"_default_{name}"
        elif not field.init:
            continue  # left to `__post_init__`
        if field.init:
            (named if field.kw_only else positional).append(parameter)
        if is_frozen:
            scope[f"_set_{name}"] = _setter(cls, name)
            lines.append(f"_set_{name}(self, {value})")
        else:
            lines.append(f"self.{name} = {value}")
    if hasattr(cls, "__post_init__"):
        lines.append("self.__post_init__()")
    parameters = ", ".join(positional + (named if len(named) > 1 else []))
    exec(f"def __init__({parameters}):\n " + "\n ".join(lines), scope)
    scope["__init__"].__qualname__ = f"{cls.__qualname__}.__init__"
    return scope["__init__"]


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
