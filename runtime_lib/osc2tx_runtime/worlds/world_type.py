"""What describes a world: its name, its options, and how it is made."""

from __future__ import annotations

from collections.abc import Callable, Iterable

from osc2tx_runtime.world.protocol import ControlMode, World
from osc2tx_shared.classes import dataclass

from .check import CheckRequest, CheckResult
from .option import Option
from .request import WorldRequest


@dataclass(frozen=True, slots=True)
class WorldType:
    """A world that runs can choose.

    Attributes:
        name: As in `--world NAME`.
        make: Makes it for a run. Exceptions other than ScenarioError are its internal errors.
        controls: Control modes of its actors; the first one is the default.
        options: Its own options, besides those of every run.
        check: Checks its simulator against the requirements of runs, line by line; None without
            one.
    """

    name: str
    make: Callable[[WorldRequest], World]
    controls: tuple[ControlMode, ...] = ("exact",)
    options: tuple[Option, ...] = ()
    check: Callable[[CheckRequest], Iterable[CheckResult]] | None = None
