"""How the benchmarks take times: CPU seconds, the least of a few runs, and ratios of them."""

from __future__ import annotations

import gc
import math
import time
from collections.abc import Callable, Iterator
from itertools import pairwise


def best(work: Callable[[], object], runs: int = 5) -> float:
    """Seconds of one call, the least of some rounds of at least 20 ms each."""
    calls = 1
    while (seconds := spent(work, calls)) < 0.02:
        calls = max(2 * calls, math.ceil(0.025 * calls / max(seconds, 1e-6)))
    return min([seconds, *(spent(work, calls) for _ in range(runs - 1))]) / calls


def spent(work: Callable[[], object], calls: int) -> float:
    gc.collect()
    begin = time.process_time()
    for _ in range(calls):
        work()
    return time.process_time() - begin


def unit() -> float:
    """Seconds of one `next()`."""

    def forever() -> Iterator[None]:
        while True:
            yield

    generators = [forever() for _ in range(1000)]

    def advance() -> None:
        for generator in generators:
            next(generator)

    return best(advance) / 1000


def upto(largest: int, sizes: tuple[int, ...]) -> tuple[int, ...]:
    return tuple(size for size in sizes if size <= largest)


def growth(sizes: tuple[int, ...], costs: list[float]) -> str:
    """Exponents between one size and the next: 1.00 is linear."""
    found = (
        f"{math.log(after / before) / math.log(large / small):.2f}"
        for (small, large), (before, after) in zip(pairwise(sizes), pairwise(costs), strict=True)
    )
    return " ".join(found)
