"""What the tests of the capabilities ask of a recorded run, and where they find the scenarios."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from tests.end_to_end.harness import SCENARIOS, Trace

CAPABILITIES = SCENARIOS / "capabilities"

DT = 0.05  # s, the step of all these runs
ROUNDED = 2e-6  # states have six decimals; a difference of two of them is off by one in the last
G = 9.80665  # m/s^2, standard gravity

Line = dict[str, Any]


@dataclass(frozen=True)
class Span:
    """From the start of an action to its end."""

    start: float
    end: float
    line: Line

    @property
    def length(self) -> float:
        return round(self.end - self.start, 6)


class Performance:
    """A run of a scenario of a capability."""

    def __init__(self, trace: Trace) -> None:
        self.trace = trace

    @cached_property
    def lines(self) -> list[Line]:
        return self.trace.lines

    @property
    def result(self) -> Line:
        return self.lines[-1]

    @property
    def status(self) -> str:
        return self.trace.status

    def of_kind(self, kind: str) -> list[Line]:
        return [line for line in self.lines if line["kind"] == kind]

    @cached_property
    def _states(self) -> dict[str, list[Line]]:
        states: dict[str, list[Line]] = {}
        for line in self.of_kind("state"):
            states.setdefault(line["actor"], []).append(line)
        return states

    def states(self, actor: str) -> list[Line]:
        return self._states[actor]

    def at(self, actor: str, t: float) -> Line:
        """State of an actor at the step nearest to a time."""
        states = self._states[actor]
        return states[min(round(t / DT), len(states) - 1)]

    def last(self, actor: str) -> Line:
        return self._states[actor][-1]

    def during(self, actor: str, span: Span) -> list[Line]:
        """States from the start of an action to its end, both included."""
        return [e for e in self._states[actor] if span.start - 1e-9 <= e["t"] <= span.end + 1e-9]

    def spans(self, name: str) -> list[Span]:
        """Runs of an action (`ego drive`), by their starts."""
        found: list[Span] = []
        for line in self.of_kind("action"):
            if line["name"] != name:
                continue
            if line["status"] == "start":
                found.append(Span(line["t"], math.inf, line))
                continue
            # An end belongs to the earliest run of the same invocation that has none yet.
            place = next(
                i
                for i, span in enumerate(found)
                if math.isinf(span.end) and span.line["source"] == line["source"]
            )
            found[place] = Span(found[place].start, line["t"], line)
        return found

    def span(self, name: str) -> Span:
        """The only run of an action."""
        (found,) = self.spans(name)
        return found

    def event(self, name: str) -> float:
        """Time of an event that occurs once."""
        (time,) = [line["t"] for line in self.of_kind("event") if line["name"] == name]
        return float(time)

    def box(self, actor: str) -> Line:
        """Length, width, height of an actor and metres from its rear end to its reference point."""
        box: Line = self.lines[0]["actors"][actor]
        return box

    def rear(self, actor: str, t: float) -> float:
        """Place of its rear end along the road (m)."""
        return float(self.at(actor, t)["s"] - self.box(actor)["rear"])

    def front(self, actor: str, t: float) -> float:
        """Place of its front end along the road (m)."""
        return self.rear(actor, t) + float(self.box(actor)["length"])


Perform = Callable[..., Performance]


def next_step(t: float) -> float:
    """The first instant of the run not before a time."""
    return round(math.ceil(t / DT - 1e-6) * DT, 6)


# --- Motion in closed form, written down anew -----------------------------------------------------


def cosine(start: float, end: float, duration: float, t: float) -> float:
    """Course along half a cosine."""
    x = min(max(t / duration, 0.0), 1.0)
    return start + (end - start) * 0.5 * (1.0 - math.cos(math.pi * x))


def cosine_duration(change: float, peak: float) -> float:
    """Duration of half a cosine whose rate peaks at its middle, with pi/2 of its mean."""
    return 0.5 * math.pi * change / peak


@dataclass(frozen=True)
class Trapezoid:
    """Change of speed with limited acceleration and jerk, as fast as can be."""

    change: float
    acceleration: float
    jerk: float

    @property
    def duration(self) -> float:
        # The area under the trapezoid of the acceleration is the change.
        return self.change / self.acceleration + self.acceleration / self.jerk
