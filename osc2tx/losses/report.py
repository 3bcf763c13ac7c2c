"""The loss report: the grade of each construct of the scenario.

Every construct is exact, approximated or inexpressible. One inexpressible construct, or one that
is approximated though nobody allowed it, and the scenario has no XML.
"""

from __future__ import annotations

from collections import Counter
from math import inf

from osc2tx import ir
from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.losses.bounds import UNMEASURED, Bound, Measured, Metres
from osc2tx.losses.entries import NOTHING, Entry, Grade, Inexpressible, Remedy
from osc2tx.options import XmlOptions
from osc2tx.xosc.element import Unwritable
from osc2tx.xosc.profiles import PROFILES
from osc2tx_shared.classes import replace


class LossReport:
    """Collects the grades of the constructs of one scenario.

    Attributes:
        options: Version and tool, and whether approximations are accepted.
        scenario: The scenario.
        module: Where it stands.
        measured: How far the document is off when it is played; `None` if it was not.
        unmeasured: Why it could not be played; empty if it was, or was not to be.
    """

    def __init__(self, options: XmlOptions, scenario: ir.Scenario, module: ir.Module) -> None:
        self.options = options
        self.scenario = scenario
        self.module = module
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
        bound: Bound,
        remedy: Remedy = NOTHING,
    ) -> None:
        """Note that a construct means nearly the same in the XML."""
        remedy = remedy.with_tool(self._tool)
        self._add(Entry(construct, span, Grade.APPROXIMATED, reason, bound, remedy))

    def doubt(
        self, construct: str, span: Span, reason: str, remedy: Remedy = NOTHING, note: str = ""
    ) -> None:
        """Note why a construct may differ: whether it does, and how far, is measured.

        The note stays with one that does not.
        """
        entry = Entry(
            construct,
            span,
            Grade.APPROXIMATED,
            reason,
            UNMEASURED,
            remedy.with_tool(self._tool),
            is_open=True,
            note=note,
        )
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
                same.append(Entry(each.construct, each.span, Grade.EXACT, each.note))
        return bool(causes)

    def _bound_by(self, text: str) -> None:
        """Add to approximations that say in words alone how far off they are."""
        for of_span in self._entries.values():
            for same in of_span.values():
                for i, each in enumerate(same):
                    if each.grade is Grade.APPROXIMATED and isinstance(each.bound, str):
                        said = "" if each.is_open else each.bound
                        bound = "; ".join(filter(None, (said, text)))
                        same[i] = replace(each, bound=bound, is_open=False)

    def _add(self, entry: Entry) -> None:
        """Add an entry; what is not exact stands instead of what is, a remark instead of none."""
        same = self._entries.setdefault(entry.span, {}).setdefault(entry.construct, [])
        if entry.grade is Grade.EXACT:
            if not any(each.reason or each.grade is not Grade.EXACT for each in same):
                same[:] = [entry]
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
