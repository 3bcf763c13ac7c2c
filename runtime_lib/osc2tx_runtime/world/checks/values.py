"""Checks of values from user code: the annotated types, finite numbers."""

from __future__ import annotations

import types
from collections.abc import Callable, Hashable, Mapping
from dataclasses import is_dataclass
from functools import cache
from numbers import Real
from typing import (
    Any,
    ClassVar,
    Literal,
    NoReturn,
    TypeVar,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from osc2tx_runtime.errors import OwnCode, ScenarioError, SimulatorError, is_own, name_of

LARGEST = 1e12
"""Upper limit of all quantities of a world, in SI units: a step could make larger ones infinite."""

Check = Callable[[Any], str]


def in_words(name: str, problem: str) -> str:
    """Return a problem with the name of the value: `target is nan, ...`, `at.s is inf, ...`."""
    return f"{name} {problem}" if problem.startswith(("is ", "has ", "a ")) else f"{name}.{problem}"


def problem_of(value: object, wanted: Any) -> str:
    """Return why a value is not of a type, as `target is nan, no number ...`; empty if it is.

    Args:
        value: The given value.
        wanted: A class, or a type as in annotations. All fields of data classes and named tuples
            are checked as well.
    """
    return _check_for(wanted)(value)


@cache
def _check_for(wanted: Hashable) -> Check:
    """Return the check for a type, built once."""
    if wanted is Any or wanted is object:
        return lambda value: ""
    if get_origin(wanted) in (Union, types.UnionType):
        kinds = get_args(wanted)
        checks = [_check_for(each) for each in kinds if each is not type(None)]
        return _any_of(checks, may_be_none=len(checks) < len(kinds))
    if get_origin(wanted) is Literal:
        allowed = get_args(wanted)
        names = "one of " + ", ".join(map(str, allowed))
        return lambda value: _unless(isinstance(value, str) and value in allowed, value, names)
    if wanted is float:
        return _number_problem
    if wanted is int:
        return lambda value: _unless(
            isinstance(value, int) and not isinstance(value, bool) and abs(value) <= LARGEST,
            value,
            "whole number",
        )
    if get_origin(wanted) is Callable:
        return lambda value: _unless(callable(value), value, "function")
    kind: Any = get_origin(wanted) or wanted
    if getattr(kind, "_is_protocol", False):
        return lambda value: _unless(all(hasattr(value, n) for n in _members(kind)), value, kind)
    inner = [_check_for(each) for each in get_args(wanted) if each is not Ellipsis]
    return lambda value: (
        _unless(isinstance(value, kind), value, kind)
        or (_problem_inside(value, inner) if inner else _problem_in(value))
    )


def _any_of(checks: list[Check], *, may_be_none: bool) -> Check:
    def check(value: Any) -> str:
        if value is None and may_be_none:
            return ""
        found = [each(value) for each in checks]
        return "" if "" in found else max(found, key=len)  # the deepest one

    return check


def _number_problem(value: Any) -> str:
    if isinstance(value, bool) or not isinstance(value, Real):
        return f"is {_shown(value)}, not a number"
    number: Any = value
    if not abs(number) <= LARGEST:  # nan is not either
        return f"is {_shown(number)}, which is not a number that a world can have"
    return ""


def _problem_in(value: Any) -> str:
    """Return the error in the fields of a data class or a named tuple."""
    kind: Any = type(value)
    for name, check in _fields(kind):
        problem = check(getattr(value, name))
        if problem:
            return in_words(name, problem)
    return ""


def _problem_inside(value: Any, checks: list[Check]) -> str:
    """Return the error in a mapping, a tuple of fixed length, or a sequence."""
    rows = value.items() if isinstance(value, Mapping) else [value]
    if len(checks) == 1:
        rows = [(each,) for each in value]
    for row in rows:
        if len(row) != len(checks):
            return f"has {len(row)} members, not {len(checks)}"
        for each, check in zip(row, checks, strict=True):
            if problem := check(each):
                return f"a member {problem}"
    return ""


@cache
def _fields(kind: Any) -> tuple[tuple[str, Check], ...]:
    if not (is_dataclass(kind) or hasattr(kind, "_fields")):
        return ()
    hints = get_type_hints(kind)
    return tuple(
        (name, _check_for(hint))
        for name, hint in hints.items()
        if get_origin(hint) is not ClassVar and not name.startswith("_")
    )


@cache
def _members(protocol: type) -> tuple[str, ...]:
    return tuple(name for name in vars(protocol) if not name.startswith("_"))


def _unless(is_fine: bool, value: object, wanted: object) -> str:
    name = wanted.__name__ if isinstance(wanted, type) else wanted
    return "" if is_fine else f"is {_shown(value)}, no {name}"


def _shown(value: object) -> str:
    """Return a value in a few characters, without its own `repr`."""
    if type(value) in (bool, float, type(None)) or (type(value) is int and abs(value) < 10**30):
        return str(value)
    return repr(value[:40]) if type(value) is str else f"a {type(value).__name__}"


T = TypeVar("T")
_SIMULATORS = "osc2tx_runtime.simulators."


class CheckedCalls:
    """Calls an object; errors name it when it fails or returns a value of the wrong type.

    Args:
        part: Its role in the run: `plant`, `world`.
        object_: The object. Exceptions of the embedded world are passed on unchanged; a world with
            a simulator usually fails because of its responses.
    """

    def __init__(self, part: str, object_: object) -> None:
        self._told = f"the {part} {name_of(type(object_))}"
        self._error = self._translated(type(object_))

    @staticmethod
    def _translated(factory: type) -> type[ScenarioError] | None:
        """The class of translated exceptions; None for internal errors of the embedded world."""
        if is_own(factory):
            return ScenarioError
        return SimulatorError if factory.__module__.startswith(_SIMULATORS) else None

    def ask(self, name: str, call: Callable[[], T], wanted: Any) -> T:
        """Return the result of a call.

        Args:
            name: Of the method, for messages.
            call: Calls it.
            wanted: Type of the result, as in annotations.

        Raises:
            ScenarioError: The result has another type, or user code raised an exception.
        """
        if self._error is None:
            found = call()
            problem = problem_of(found, wanted)
        else:
            with OwnCode(f"{self._told} raised", error=self._error):
                found = call()
                problem = problem_of(found, wanted)  # its numbers may be own classes
        if problem:
            self.refuse(name, problem)
        return found

    def refuse(self, name: str, problem: str) -> NoReturn:
        """Raises the error in the result of a method, as a `ScenarioError`."""
        raise ScenarioError(f"{self._told}: {name}: {problem}")
