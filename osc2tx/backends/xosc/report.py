"""The loss report: the grade of each construct of the scenario.

Every construct is exact, approximated or inexpressible. One inexpressible construct, or one that
is approximated though nobody allowed it, and the scenario has no XML.
"""

from __future__ import annotations

from collections import Counter
from enum import Enum
from math import ceil, floor, inf, log10

from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.options import XmlOptions
from osc2tx.xosc.element import Unwritable
from osc2tx.xosc.profiles import PROFILES, ToolProfile
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


@dataclass(frozen=True, slots=True)
class Metres:
    """How far an actor is from its place, at most.

    Attributes:
        most: Metres.
        where: When that is, or what it depends on; empty if it is always so.
    """

    most: float
    where: str = ""

    def __str__(self) -> str:
        return " ".join(filter(None, (f"at most {self.rounded:g} m", self.where)))

    @property
    def rounded(self) -> float:
        """Metres with two digits, never less than they are."""
        return rounded_up(self.most)


class UpToTool(str):
    """A bound in words where each tool has a law of its own, which no played document measures."""

    __slots__ = ()


UNMEASURED = "not measured"
"""The bound of what no played document has shown."""

ROUNDING = 1e-6


def rounded_up(value: float) -> float:
    """Return a number with two digits, never less than it is."""
    if value <= 0.0:
        return 0.0
    digit = 10.0 ** (floor(log10(value)) - 1)
    return round(ceil(value / digit - ROUNDING) * digit, 6)


@dataclass(frozen=True, slots=True)
class Measured:
    """How far a document is off in runs, at most.

    Attributes:
        place: Between an actor in the document and in the world (m).
        speed: Between their speeds (m/s).
        time: Between the times of an event, or of the end (s).
        events: Events that are missing, too late or in another order.
        runs: Number of runs.
    """

    place: float
    speed: float
    time: float
    events: int = 0
    runs: int = 1

    def __str__(self) -> str:
        events = f", with {self.events} other event{'s' * (self.events > 1)}" * bool(self.events)
        values = self.values()
        if not any((*values.values(), events)):
            return "measured: no deviation"
        return (
            f"measured: at most {values['place']:g} m, {values['speed']:g} m/s and"
            f" {values['time']:g} s{events}"
        )

    def values(self) -> dict[str, float]:
        """Return the largest deviations, rounded up; noise of the computation counts as none."""
        found = {"place": self.place, "speed": self.speed, "time": self.time}
        return {name: rounded_up(value) if value > NOISE else 0.0 for name, value in found.items()}


NOISE = 1e-3
"""Below this, deviations in m, m/s and s are those of rounded numbers in documents."""


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
    """

    construct: str
    span: Span
    grade: Grade
    reason: str = ""
    bound: Metres | str = ""
    remedy: Remedy = NOTHING
    is_open: bool = False

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


class LossReport:
    """Collects the grades of the constructs of one scenario.

    Attributes:
        measured: How far the document is off when it is played; `None` if it was not.
        unmeasured: Why it could not be played; empty if it was, or was not to be.
    """

    def __init__(self, options: XmlOptions) -> None:
        self.options = options
        self._tool = PROFILES[options.profile]
        self._entries: dict[Span, dict[str, list[Entry]]] = {}
        self.measured: Measured | None = None
        self.unmeasured = ""

    def exact(self, construct: str, span: Span, note: str = "") -> None:
        """Note that a construct means the same in the XML."""
        self._add(Entry(construct, span, Grade.EXACT, note))

    def approximate(
        self,
        construct: str,
        span: Span,
        reason: str,
        bound: Metres | str,
        remedy: Remedy = NOTHING,
    ) -> None:
        """Note that a construct means nearly the same in the XML."""
        remedy = remedy.with_tool(self._tool)
        self._add(Entry(construct, span, Grade.APPROXIMATED, reason, bound, remedy))

    def doubt(self, construct: str, span: Span, reason: str, remedy: Remedy = NOTHING) -> None:
        """Note why a construct may differ: whether it does, and how far, is measured."""
        remedy = remedy.with_tool(self._tool)
        entry = Entry(construct, span, Grade.APPROXIMATED, reason, UNMEASURED, remedy, is_open=True)
        self._add(entry)

    def cannot(self, construct: str, span: Span, reason: str, remedy: Remedy = NOTHING) -> None:
        """Note that a construct cannot be written down."""
        remedy = remedy.with_tool(self._tool)
        self._add(Entry(construct, span, Grade.INEXPRESSIBLE, reason, remedy=remedy))

    def refuse(self, construct: str, span: Span, error: Unwritable) -> None:
        """Note that a construct cannot be written down, as an attempt has shown."""
        if isinstance(error, Inexpressible):
            self.cannot(construct, error.span or span, error.reason, error.remedy)
        else:
            self.cannot(construct, span, error.reason)

    def measure(self, measured: Measured, deviates_at: Span | None) -> bool:
        """Note how far the document is off; approximations without a number take that one.

        Return whether what was open explains why it deviates, if it does.
        """
        self.measured = measured
        is_explained = self.settle(deviates_at)
        self._bound_by(str(measured))
        return is_explained

    def leave_unmeasured(self, reason: str) -> None:
        """Note why nothing is known about how far the document is off."""
        self.unmeasured = reason
        self._bound_by(f"{UNMEASURED}: {reason}")

    def settle(self, deviates_at: Span | None) -> bool:
        """Decide what is open: it is exact, but for what stands where the document deviates.

        If nothing does, whatever is open may be the cause. Return whether there is a cause.
        """
        open_ = [each for each in self.entries if each.is_open]
        causes: list[Entry] = []
        if deviates_at is not None:
            causes = [each for each in open_ if deviates_at.holds(each.span)] or open_
        for each in open_:
            same = self._entries[each.span][each.construct]
            same.remove(each)
            if each in causes:
                same.append(replace(each, bound="", is_open=False))
            elif not same:
                same.append(Entry(each.construct, each.span, Grade.EXACT))
        return bool(causes)

    def _bound_by(self, text: str) -> None:
        """Add to approximations that say in words alone how far off they are."""
        for of_span in self._entries.values():
            for same in of_span.values():
                for i, each in enumerate(same):
                    if each.grade is Grade.APPROXIMATED and type(each.bound) is str:
                        said = "" if each.is_open else each.bound
                        bound = "; ".join(filter(None, (said, text)))
                        same[i] = replace(each, bound=bound, is_open=False)

    def _add(self, entry: Entry) -> None:
        """Add an entry; what is not exact stands instead of what is."""
        same = self._entries.setdefault(entry.span, {}).setdefault(entry.construct, [])
        if entry.grade is Grade.EXACT:
            if not same:
                same.append(entry)
            return
        same[:] = [e for e in same if e.grade is not Grade.EXACT and e.reason != entry.reason]
        same.append(entry)

    def construct_at(self, span: Span, kind: str) -> str:
        """Return what a construct of a kind at a place is called here."""
        names = (name for name in self._entries.get(span, ()) if name.startswith(kind))
        return next(names, kind.strip())

    @property
    def entries(self) -> tuple[Entry, ...]:
        """All of them, in order of place."""
        found = [e for at in self._entries.values() for same in at.values() for e in same]
        return tuple(sorted(found, key=lambda e: (e.span.source.name, e.span.start)))

    @property
    def losses(self) -> tuple[Entry, ...]:
        """Those that are not exact, the worst first: what cannot be said, then the farthest off."""
        return tuple(sorted((e for e in self.entries if e.grade is not Grade.EXACT), key=_goodness))

    @property
    def obstacles(self) -> tuple[Entry, ...]:
        """Those for which there is no XML."""
        accepted = {Grade.EXACT}
        if self.options.allow_approx:
            accepted.add(Grade.APPROXIMATED)
        return tuple(e for e in self.entries if e.grade not in accepted and not e.is_open)

    @property
    def approximations(self) -> tuple[Entry, ...]:
        """Those that are approximated, whatever the played document shows."""
        return tuple(e for e in self.entries if e.grade is Grade.APPROXIMATED and not e.is_open)

    def tell_obstacles(self, sink: DiagnosticSink) -> None:
        """Report why there is no XML."""
        for entry in self.obstacles:
            sink.report(entry.code, entry.span, entry.message, help=entry.help)

    @property
    def is_expressible(self) -> bool:
        """Whether there is XML."""
        return not self.obstacles

    def summary(self) -> str:
        """Return one line for people."""
        grades = ["unmeasured" if e.is_open else e.grade.value for e in self.entries]
        counts, order = Counter(grades), (*(grade.value for grade in Grade), "unmeasured")
        told = ", ".join(f"{counts[grade]} {grade}" for grade in order if counts[grade])
        asked = f"OpenSCENARIO XML {self.options.version}"
        if self.options.profile != "generic":
            asked += f" for {self.options.profile}"
        return f"{asked if self.is_expressible else f'no {asked}'}: {told or 'nothing to say'}"


def _goodness(entry: Entry) -> tuple[bool, float]:
    """Return what sorts entries, the worst first; a deviation in words counts as unbounded."""
    metres = entry.bound.most if isinstance(entry.bound, Metres) else inf
    return entry.grade is Grade.APPROXIMATED, -metres
