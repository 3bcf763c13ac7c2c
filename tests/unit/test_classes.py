"""The cheap `dataclass` behaves like that of the standard library."""

import copy
import dataclasses
import pickle
from collections.abc import Callable
from dataclasses import FrozenInstanceError, field, fields, replace
from inspect import signature
from typing import Any

import pytest

from osc2tx_shared.classes import dataclass as light
from osc2tx_shared.classes import replace as quick_replace

Decorator = Callable[..., Any]


def family(dataclass: Decorator, frozen: bool, slots: bool, eq: bool) -> Any:
    """A class with all kinds of fields, and its base."""

    @dataclass(frozen=frozen, slots=slots, eq=eq)
    class Base:
        first: int
        second: str = "b"

    @dataclass(frozen=frozen, slots=slots, eq=eq)
    class Derived(Base):
        listed: list[int] = field(default_factory=list)
        silent: int = field(default=3, repr=False, compare=False)
        fixed: tuple[int, ...] = field(default=(1,), init=False)
        made: list[str] = field(init=False, default_factory=list)
        later: int = field(init=False, repr=False, compare=False)
        named: int = field(default=7, kw_only=True)

        def __post_init__(self) -> None:
            object.__setattr__(self, "later", self.first + 1)

    return Derived


def outcome(work: Callable[[], Any]) -> Any:
    try:
        return work()
    except Exception as error:
        return type(error)


@pytest.mark.parametrize("eq", [True, False])
@pytest.mark.parametrize("slots", [True, False])
@pytest.mark.parametrize("frozen", [True, False])
def test_like_the_standard_library(frozen: bool, slots: bool, eq: bool) -> None:
    results = []
    for dataclass in (dataclasses.dataclass, light):
        kind = family(dataclass, frozen, slots, eq)
        one = kind(1, "x", [2], 9, named=4)
        found = [
            list(signature(kind).parameters),
            [(f.name, getattr(one, f.name)) for f in fields(one)],
            kind.__match_args__,
            [(f.name, getattr(kind(first=5), f.name)) for f in fields(one)],
            repr(one) if eq else None,
            one == kind(1, "x", [2], 8, named=4),
            one == kind(1, "x", [3], 9, named=4),
            one == 3,
            kind(1).listed is kind(1).listed,
            replace(one, first=4).later,
            copy.deepcopy(one) == one,
            outcome(lambda kind=kind: kind()),
            outcome(lambda kind=kind: kind(1, wrong=2)),
            outcome(lambda kind=kind: kind(1, "x", [], 3, 4)),
            outcome(lambda one=one: setattr(one, "first", 2)),
            outcome(lambda one=one: delattr(one, "second")),
            outcome(lambda one=one: setattr(one, "unknown", 2)) if not frozen else None,
            outcome(lambda kind=kind: type(hash(kind(1)))) if not (eq and frozen) else None,
        ]
        results.append(found)
    assert results[0] == results[1]


@light(frozen=True, slots=True)
class Point:
    x: int
    y: int = 0


@light(frozen=True, slots=True)
class Place(Point):
    name: str = ""


@light(frozen=True)
class Nothing:
    pass


@light(slots=True)
class Own:
    x: int

    def __init__(self) -> None:
        self.x = 3

    def __repr__(self) -> str:
        return "mine"


def test_values() -> None:
    assert {Point(1), Point(1, 0)} == {Point(1)} and Point(1) != Place(1)
    assert {Nothing(), Nothing()} == {Nothing()} and repr(Nothing()) == "Nothing()"
    assert repr(Place(1, 2, "here")) == "Place(x=1, y=2, name='here')"
    with pytest.raises(FrozenInstanceError):
        Place(1).x = 2  # type: ignore[misc]
    assert Own().x == 3 and repr(Own()) == "mine"


def test_a_base_constructed_first_and_last() -> None:
    assert Place(1, 2, "c").name == "c"
    assert Point(3, 4).y == 4
    assert Place(5, 6, "d").y == 6


def test_pickling() -> None:
    assert pickle.loads(pickle.dumps(Place(1, 2, "here"))) == Place(1, 2, "here")


def test_patterns() -> None:
    match Place(1, 2, "here"):
        case Point(x, y=2):
            assert x == 1
        case _:
            pytest.fail("no match")


def test_what_is_not_supported_is_refused() -> None:
    with pytest.raises(TypeError):
        light(order=True)


KINDS = (dataclasses.dataclass, light)


@pytest.mark.parametrize("base_frozen", [True, False])
@pytest.mark.parametrize("frozen", [True, False])
@pytest.mark.parametrize("outer", KINDS)
@pytest.mark.parametrize("inner", KINDS)
def test_one_kind_inherits_from_the_other(
    inner: Decorator, outer: Decorator, frozen: bool, base_frozen: bool
) -> None:
    """As within the standard library: frozen classes inherit from frozen ones only."""

    @inner(frozen=base_frozen, slots=True)
    class Base:
        x: int

    def derive() -> Any:
        @outer(frozen=frozen, slots=True)
        class Derived(Base):
            y: int = 2

        return Derived

    if frozen != base_frozen:
        with pytest.raises(TypeError, match="cannot inherit"):
            derive()
        return
    made = derive()(1)
    assert made == type(made)(1, 2) and (made.x, made.y) == (1, 2)
    changed = outcome(lambda: setattr(made, "x", 5))
    assert changed is (FrozenInstanceError if frozen else None)
    assert Base.__dataclass_params__.frozen is base_frozen  # type: ignore[attr-defined]


def test_signatures_before_anything_is_constructed() -> None:
    @light(frozen=True, slots=True)
    class Base:
        x: int
        y: int = 0

    @light(frozen=True, slots=True)
    class Derived(Base):
        z: int = 1

    class Written(Base):
        def __init__(self, whole: int) -> None:
            super().__init__(whole, whole)

    assert [list(signature(each).parameters) for each in (Derived, Base, Written)] == [
        ["x", "y", "z"],
        ["x", "y"],
        ["whole"],
    ]
    assert (Derived(1), Base(2), Written(3).y) == (Derived(1, 0, 1), Base(2), 3)


def test_replace_is_that_of_the_standard_library() -> None:
    made = Place(1, 2, "here")
    assert quick_replace(made, x=5) == replace(made, x=5) == Place(5, 2, "here")
    with pytest.raises(TypeError):
        quick_replace(made, unknown=1)


def test_replace_makes_anew_what_the_constructor_does_not_take() -> None:
    @light
    class Made:
        x: int
        y: list[int] = field(default_factory=list, init=False)

    made = Made(1)
    made.y.append(1)
    assert quick_replace(made, x=2).y == replace(made, x=2).y == []
