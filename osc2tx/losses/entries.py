"""The grade of a construct, with what could express it."""

from __future__ import annotations

from enum import Enum

from osc2tx.diagnostics import Span
from osc2tx.losses.bounds import Bound
from osc2tx.xosc.element import Unwritable
from osc2tx.xosc.profiles import ToolProfile
from osc2tx_shared.classes import dataclass, replace


class Grade(Enum):
    """How exactly XML expresses a construct."""

    EXACT = "exact"
    APPROXIMATED = "approximated"
    INEXPRESSIBLE = "inexpressible"


@dataclass(frozen=True, slots=True, kw_only=True)
class Remedy:
    """What could express a construct; empty if nothing can.

    Attributes:
        version: The lowest version of OpenSCENARIO XML that could.
        profile: A profile of a tool that could; with a version it takes both.
        instead: What else to write in the scenario, which the XML says exactly; a clause.
        asks: What that asks of a tool, as in `ToolProfile.unsupported` and `deviates`.
    """

    version: str | None = None
    profile: str | None = None
    instead: str = ""
    asks: tuple[str, ...] = ()

    def __str__(self) -> str:
        parts = []
        if self.version is not None:
            parts.append(f"OpenSCENARIO XML {self.version}")
        if self.profile is not None:
            parts.append(f"profile {self.profile}")
        return " in ".join(parts)

    def with_tool(self, tool: ToolProfile) -> Remedy:
        """Return what of it helps who writes for a tool: another one may read other versions."""
        is_read = self.version is None or self.version in tool.versions
        is_exact = not any(what in tool.unsupported or what in tool.deviates for what in self.asks)
        return replace(
            self,
            profile=self.profile if is_read else "generic",
            instead=self.instead if is_exact else "",
        )


NOTHING = Remedy()
GENERIC = Remedy(profile="generic")


class Inexpressible(Unwritable):
    """A construct that cannot be written down.

    Attributes:
        span: Where it stands; `None`: the construct that is being looked at.
        reason: A sentence without full stop.
        remedy: What could.
    """

    def __init__(self, reason: str, span: Span | None = None, remedy: Remedy = NOTHING) -> None:
        super().__init__(reason)
        self.span = span
        self.remedy = remedy


class NoPlace(Inexpressible):
    """There is no place for an actor at the start: the embedded world has none, either."""


@dataclass(frozen=True, slots=True, eq=False)
class Entry:
    """The grade of one construct.

    Attributes:
        construct: What it is, as in the tables of `docs/coverage.md`.
        span: Where it stands.
        grade: How exactly XML expresses it.
        reason: Why it is not exact, or what is worth knowing about an exact one.
        bound: How far an approximation is from the original: metres, or in words what differs.
        remedy: What could express it.
        is_open: It is not exact if the played document deviates; else it is.
        note: What is then worth knowing about the exact one.
    """

    construct: str
    span: Span
    grade: Grade
    reason: str = ""
    bound: Bound = ""
    remedy: Remedy = NOTHING
    is_open: bool = False
    note: str = ""

    @property
    def code(self) -> str:
        """The diagnostic that reports it where XML is asked for."""
        return "OSC514" if self.grade is Grade.INEXPRESSIBLE else "OSC515"

    @property
    def message(self) -> str:
        """Why it stands in the way of XML."""
        bound = f"; {self.bound}" if self.bound else ""
        return f"{self.construct}: {self.reason}{bound}"

    @property
    def help(self) -> str | None:
        """What to do about it, if there is something to do."""
        is_approximated = self.grade is Grade.APPROXIMATED
        better = f"{self.remedy} can say this" if str(self.remedy) else ""
        parts = (
            "`--allow-approx` accepts this" if is_approximated else "",
            f"{better} exactly" if better and is_approximated else better,
            self.remedy.instead,
        )
        return "; ".join(filter(None, parts)) or None
