"""Values that satisfy constraints, found by narrowing instead of rejection.

Each variable has a domain: an interval of numbers, or a set. A relation narrows its
variables: `a < b + 2m` their bounds, an `or` whose other parts cannot hold the one that is left.
Values are chosen one variable at a time, each at a given fraction of the domain that the others
leave. So orders, sums with a given value and clauses are solved without rejection. Relations of
another kind narrow nothing; the caller has to test them.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from math import ceil, floor, inf, isfinite
from typing import TypeAlias

from osc2tx_shared.classes import dataclass

MOST_STEPS = 20_000
"""Narrowings for one set of values: bounds that creep towards each other are given up."""

CREEP = 1e-9
"""The share of an interval by which bounds have to move, to be a narrowing."""


@dataclass(frozen=True, slots=True)
class Interval:
    """Numbers from `low` to `high`.

    Attributes:
        low: The least.
        high: The greatest.
        is_whole: They have no fractions.
    """

    low: float
    high: float
    is_whole: bool = False

    def at(self, share: float) -> float | int:
        """Return the number at a place between the ends (0 to 1)."""
        if self.is_whole:
            return min(int(self.low + share * (self.high - self.low + 1.0)), int(self.high))
        return self.low + share * (self.high - self.low)


Choices: TypeAlias = tuple[object, ...]
Domain: TypeAlias = Interval | Choices
Key: TypeAlias = str


class Contradiction(Exception):
    """Nothing is left for a variable."""


class Store:
    """The domains of variables.

    Args:
        domains: By variable.
    """

    def __init__(self, domains: Mapping[Key, Domain]) -> None:
        self.domains = dict(domains)
        self.changed: deque[Key] = deque()

    def bounds(self, key: Key) -> tuple[float, float]:
        """Return the least and the greatest number of a variable."""
        domain = self.domains[key]
        if isinstance(domain, Interval):
            return domain.low, domain.high
        numbers = [value for value in domain if isinstance(value, (int, float))]
        return min(numbers), max(numbers)

    def narrow(self, key: Key, low: float, high: float) -> None:
        """Leave numbers between bounds.

        Raises:
            Contradiction: There are none.
        """
        domain = self.domains[key]
        if not isinstance(domain, Interval):
            slack = CREEP * max(1.0, abs(low) if isfinite(low) else abs(high))
            self.keep(
                key, lambda v: isinstance(v, (int, float)) and low - slack <= v <= high + slack
            )
            return
        if domain.is_whole:
            low = ceil(low - CREEP) if isfinite(low) else low
            high = floor(high + CREEP) if isfinite(high) else high
        low, high = max(low, domain.low), min(high, domain.high)
        width = domain.high - domain.low
        if low > high + CREEP * max(1.0, abs(high)):
            raise Contradiction
        least = CREEP * width if isfinite(width) else 0.0
        if low > domain.low + least or high < domain.high - least:
            self.domains[key] = Interval(low, max(low, high), domain.is_whole)
            self.changed.append(key)

    def keep(self, key: Key, allows: Callable[[object], bool]) -> None:
        """Leave the values of a set that pass a test.

        Raises:
            Contradiction: There are none.
        """
        domain = self.domains[key]
        if isinstance(domain, Interval):
            return
        left = tuple(filter(allows, domain))
        if not left:
            raise Contradiction
        if len(left) < len(domain):
            self.domains[key] = left
            self.changed.append(key)

    def fix(self, key: Key, share: float) -> None:
        """Choose the value of a variable at a place within its domain."""
        domain = self.domains[key]
        if isinstance(domain, Interval):
            value = domain.at(share)
            self.domains[key] = Interval(value, value, domain.is_whole)
        else:
            self.domains[key] = (domain[min(int(share * len(domain)), len(domain) - 1)],)
        self.changed.append(key)

    def value(self, key: Key) -> object:
        """Return the value of a variable that has only one."""
        domain = self.domains[key]
        if isinstance(domain, Interval):
            return int(domain.low) if domain.is_whole else domain.low
        return domain[0]


class Relation:
    """A relation between variables; this one holds always.

    Attributes:
        keys: The variables.
    """

    keys: tuple[Key, ...] = ()

    def can_hold(self, store: Store) -> bool:
        """Return whether some values that are left may keep it."""
        return True

    def demand(self, store: Store) -> None:
        """Leave only values that may keep it.

        Raises:
            Contradiction: There are none.
        """


class Linear(Relation):
    """A weighted sum of numbers that is not above zero.

    Args:
        weights: By variable.
        rest: The constant term.
        is_strict: It is below zero.
    """

    def __init__(self, weights: Mapping[Key, float], rest: float, *, is_strict: bool) -> None:
        self.keys = tuple(weights)
        self._weights = [(weight, abs(weight)) for weight in weights.values()]
        self._rest, self._is_strict = rest, is_strict
        self._slack = CREEP * max(1.0, abs(rest))

    def _least(self, bounds: Sequence[tuple[float, float]]) -> float:
        total = 0.0
        for (weight, _), (low, high) in zip(self._weights, bounds, strict=True):
            total += weight * (high if weight < 0.0 else low)
        return self._rest + total

    def can_hold(self, store: Store) -> bool:
        """Return whether its least value is low enough."""
        least = self._least([store.bounds(key) for key in self.keys])
        return least < 0.0 or (not self._is_strict and least <= self._slack)

    def demand(self, store: Store) -> None:
        """Narrow each variable to the values that the minima of the others leave."""
        bounds = [store.bounds(key) for key in self.keys]  # the hot path of sums of many
        least = self._least(bounds)
        if least > self._slack:
            raise Contradiction
        for key, (weight, size), (low, high) in zip(self.keys, self._weights, bounds, strict=True):
            if size * (high - low) < -least:  # also its other end is possible
                continue
            others = least - weight * (low if weight > 0.0 else high)
            if not isfinite(others):
                continue
            end = -others / weight
            if self._is_strict:
                is_whole = _is_whole(store.domains[key])
                gap = CREEP * max(1.0, abs(end)) if not is_whole else float(end == floor(end))
                end -= gap if weight > 0.0 else -gap
            store.narrow(key, *((-inf, end) if weight > 0.0 else (end, inf)))


def _is_whole(domain: Domain) -> bool:
    if isinstance(domain, Interval):
        return domain.is_whole
    return all(isinstance(value, int) for value in domain)


class Among(Relation):
    """A variable whose value passes a test.

    Args:
        key: The variable; its domain is a set.
        allows: The test.
    """

    def __init__(self, key: Key, allows: Callable[[object], bool]) -> None:
        self.keys = (key,)
        self._allows = allows

    def can_hold(self, store: Store) -> bool:
        """Return whether a value that is left passes."""
        domain = store.domains[self.keys[0]]
        return isinstance(domain, Interval) or any(map(self._allows, domain))

    def demand(self, store: Store) -> None:
        """Leave the values that pass."""
        store.keep(self.keys[0], self._allows)


class All(Relation):
    """Relations that hold together."""

    def __init__(self, parts: Sequence[Relation]) -> None:
        self._parts = parts
        self.keys = _keys_of(parts)

    def can_hold(self, store: Store) -> bool:
        """Return whether each of them may hold."""
        return all(part.can_hold(store) for part in self._parts)

    def demand(self, store: Store) -> None:
        """Demand each of them."""
        for part in self._parts:
            part.demand(store)


class Any(Relation):
    """Relations of which one holds."""

    def __init__(self, parts: Sequence[Relation]) -> None:
        self._parts = parts
        self.keys = _keys_of(parts)

    def can_hold(self, store: Store) -> bool:
        """Return whether one of them may hold."""
        return any(part.can_hold(store) for part in self._parts)

    def demand(self, store: Store) -> None:
        """Demand the one that may hold, if it is the only one."""
        left = [part for part in self._parts if part.can_hold(store)]
        if not left:
            raise Contradiction
        if len(left) == 1:
            left[0].demand(store)


def _keys_of(parts: Iterable[Relation]) -> tuple[Key, ...]:
    return tuple(dict.fromkeys(key for part in parts for key in part.keys))


class Solver:
    """Chooses values of variables that satisfy relations.

    Args:
        domains: The domain of each variable; bounds may be infinite if relations make them finite.
        relations: The relations.
    """

    def __init__(self, domains: Mapping[Key, Domain], relations: Sequence[Relation]) -> None:
        self._relations = relations
        self._at: dict[Key, list[int]] = {key: [] for key in domains}
        for index, relation in enumerate(relations):
            for key in relation.keys:
                self._at[key].append(index)
        self._order = _spread(list(domains))
        self._start: Mapping[Key, Domain] | None = None
        store = Store(domains)
        try:
            self._settle(store, range(len(relations)))
        except Contradiction:
            return
        if all(map(_is_finite, store.domains.values())):
            self._start = store.domains

    def choose(self, shares: Mapping[Key, float]) -> dict[Key, object] | None:
        """Return values for fractions of the remaining domains of the variables, between 0 and 1.

        None if a domain becomes empty.
        """
        if self._start is None:
            return None
        store = Store(self._start)
        try:
            for key in self._order:
                store.fix(key, shares[key])
                self._settle(store, ())
        except Contradiction:
            return None
        return {key: store.value(key) for key in shares}

    def _settle(self, store: Store, first: Iterable[int]) -> None:
        """Demand relations until none narrows anything."""
        pending = dict.fromkeys(first)
        for _ in range(MOST_STEPS):
            while store.changed:
                pending |= dict.fromkeys(self._at[store.changed.popleft()])
            if not pending:
                return
            index = next(iter(pending))
            del pending[index]
            self._relations[index].demand(store)
            store.changed = deque(dict.fromkeys(store.changed))
        raise Contradiction


def _is_finite(domain: Domain) -> bool:
    return not isinstance(domain, Interval) or (isfinite(domain.low) and isfinite(domain.high))


def _spread(keys: Sequence[Key]) -> list[Key]:
    """Return variables from the middle outwards: an order of them is halved again and again."""
    found: list[Key] = []
    pending = deque([(0, len(keys))])
    while pending:
        low, high = pending.popleft()
        if low < high:
            middle = (low + high) // 2
            found.append(keys[middle])
            pending += ((low, middle), (middle + 1, high))
    return found
