"""The phase of one action: its conditions and findings."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Literal

from osc2tx_runtime.domain.modifiers import PhysicalMovement
from osc2tx_runtime.domain.monitoring.conditions import Condition, Reading
from osc2tx_runtime.domain.monitoring.tolerances import QUANTITIES
from osc2tx_runtime.errors import NOT_MET, PARTLY_MET, ScenarioError, SourcePlace
from osc2tx_runtime.opendrive import MapError
from osc2tx_runtime.world.measuring.projected_motion import projected
from osc2tx_runtime.world.protocol import EXACT, EXTERNAL
from osc2tx_shared.classes import dataclass

if TYPE_CHECKING:
    from osc2tx_runtime.language.actions.action import Action
    from osc2tx_runtime.world.protocol import World
    from osc2tx_runtime.world.state import ActorState

UNMEASURABLE = (ScenarioError, MapError)
"""Errors that prevent a measurement."""

Severity = Literal["failure", "warning"]


@dataclass(frozen=True, slots=True)
class Violation:
    """A condition that does not hold at some states of its phase.

    Attributes:
        severity: Whether it fails the phase (ADR 6).
        actor: The actor.
        action: Name of the action in the trace.
        modifier: Name of its origin.
        at: The time at which it has to hold.
        source: Position of the modifier in the scenario, or of the action that implies it.
        first: Time of the first state at which it does not hold (s).
        last: Time of the last one (s).
        worst: Time of the greatest deviation (s).
        deviation: That deviation, beyond what is allowed; positive: too much, ahead, left.
        unit: Of it.
        x: Position of the actor then (m).
        y: Likewise.
        what: The finding, for messages.
    """

    severity: Severity
    actor: str
    action: str
    modifier: str
    at: str
    source: str
    first: float
    last: float
    worst: float
    deviation: float
    unit: str
    x: float
    y: float
    what: str

    def words(self) -> dict[str, str | float]:
        """Return its fields in the trace, besides its source."""
        return {
            "severity": self.severity,
            "code": self.code,
            "actor": self.actor,
            "name": self.action,
            "modifier": self.modifier,
            "at": self.at,
            **{name: round(getattr(self, name), 6) for name in ("first", "last", "worst")},
            "deviation": round(self.deviation, 6),
            **({"unit": self.unit} if self.unit else {}),
            "x": round(self.x, 6),
            "y": round(self.y, 6),
            "what": self.what,
            **({"column": self.source.column} if isinstance(self.source, SourcePlace) else {}),
        }

    @property
    def code(self) -> str:
        """Code of the diagnostic."""
        return NOT_MET if self.severity == "failure" else PARTLY_MET

    def fails(self, place: str) -> bool:
        """Whether it is the reason of the failure at a source position."""
        return self.severity == "failure" and self.source == place

    def __str__(self) -> str:
        since = f"from {self.first:.2f} to {self.last:.2f} s"
        when = f"at {self.first:.2f} s" if self.first == self.last else since
        return (
            f"{self.action}: `{self.modifier}` does not hold {when}: {self.what} at"
            f" {self.worst:.2f} s, at ({self.x:.1f}, {self.y:.1f})"
        )


@dataclass(slots=True)
class _Found:
    """Findings on a condition: the states at which it does not hold."""

    first: float
    last: float
    worst: float
    deviation: float
    x: float
    y: float
    what: str


class Phase:
    """Checks the conditions of one action at each state of its phase.

    Args:
        action: The action.
        world: Holds the states; the present one is the first of the phase.
        time: Present time (s).
        dt: Length of a step (s).

    Attributes:
        first: State of the actor at the start.
        elapsed: Seconds since the start.
        dt: Length of a step (s).
    """

    def __init__(self, action: Action, world: World, time: float, dt: float) -> None:
        self.action = action
        self.world = world
        self.actor = action.actor.id
        self.modifiers = action.modifiers
        self.first = world.state(self.actor)
        self.elapsed = 0.0
        self._start = time
        self.dt = dt
        self._steps = False  # whether a condition constrains the states in between
        self._path = 0.0  # m since the start
        self._here = self._before = self.first
        self._found: dict[Condition, _Found] = {}
        physical = next((m for m in self.modifiers if isinstance(m, PhysicalMovement)), None)
        self._option = "prefer_non_physical" if getattr(action, "replays", False) else None
        if physical is not None:
            self._option = physical.option
        self._control = world.control(self.actor)
        self._is_steady = self._holds = False
        self._lasting: list[tuple[Condition, float]] = []
        self._last: list[tuple[Condition, float]] = []

    def begin(self, conditions: Iterable[Condition]) -> bool:
        """Check the conditions on the first state.

        Returns:
            Whether the states in between have to be observed.
        """
        now = self._start
        for condition in conditions:
            entry = condition, self._tolerance(condition)
            match condition.at:
                case "start" if not condition.is_late:
                    self._check(*entry, now)
                case "end":
                    self._last.append(entry)
                case _:
                    self._lasting.append(entry)
        self._is_steady = not self._steps and all(c.is_steady for c, _ in self._lasting)
        if (
            self._option != "prefer_non_physical"
        ):  # an instant change: the instant belongs to both phases
            self.observe(now)
        return bool(self._lasting) or self._steps

    @property
    def rests(self) -> bool:
        """Whether all conditions hold, and continue to while the actor's motion does not change."""
        return self._is_steady and self._holds

    # --- read by monitors ---------------------------------------------------------------------

    def me(self) -> ActorState:
        """State of the actor."""
        return self.world.state(self.actor)

    def track(self, actor: str, is_projected: bool) -> Callable[[], ActorState]:
        """Return a reader of the actual or projected state of a reference (DSL 8.9.21)."""
        state = self.world.state
        if not is_projected:
            return lambda: state(actor)
        first, road_map = state(actor), self.world.map
        return lambda: projected(road_map, first, self.elapsed)

    def covered(self) -> Callable[[], float]:
        """Return a reader of the distance (m) covered since the start."""
        self._steps = True
        return lambda: self._path

    def state_before(self) -> Callable[[], ActorState]:
        """Return a reader of the state of the actor one step ago."""
        self._steps = True
        return lambda: self._before

    def _step(self) -> None:
        """Add the step up to now."""
        here = self.me()
        self._before, self._here = self._here, here
        self._path += math.dist(self._before[:2], here[:2])

    # --- findings -----------------------------------------------------------------------------

    def observe(self, time: float) -> None:
        """Check the conditions on all states."""
        self._go_to(time)
        holds = True
        for condition, tolerance in self._lasting:
            holds = self._check(condition, tolerance, time) and holds
        self._holds = holds

    def end(self, time: float) -> None:
        """Check the conditions on the last state.

        The exact end is within the last step, so a change of one step is allowed.
        """
        self._go_to(time)
        for condition, tolerance in (*self._lasting, *self._last):
            rate = abs(QUANTITIES[condition.quantity].rate(self.me()))
            self._check(condition, tolerance + rate * self.dt, time)

    def _go_to(self, time: float) -> None:
        self.elapsed = time - self._start
        if self._steps:
            self._step()

    def violations(self) -> list[Violation]:
        """Return the conditions that do not hold, in the order in which they are stated."""
        return [self._violation(condition, found) for condition, found in self._found.items()]

    def _tolerance(self, condition: Condition) -> float:
        quantity = QUANTITIES[condition.quantity]
        return quantity.exact if self._control in EXACT else quantity.measured

    def _check(self, condition: Condition, tolerance: float, time: float) -> bool:
        """Return whether a condition holds, and note it if it does not."""
        try:
            reading = condition.measure()
        except UNMEASURABLE:  # the planning reports it
            return True
        if reading is None:
            return True
        value, low, high = reading
        if low - tolerance <= value <= high + tolerance:
            return True
        self._note(condition, reading, time)
        return False

    def _note(self, condition: Condition, reading: Reading, time: float) -> None:
        value, low, high = reading
        off = value - high if value > high else value - low
        found = self._found.get(condition)
        if found is not None:
            found.last = time
            if abs(off) <= abs(found.deviation):
                return
        here = self.me()
        what = _words(condition, reading) if condition.text is None else condition.text(reading)
        first = time if found is None else found.first
        self._found[condition] = _Found(first, time, time, off, here.x, here.y, what)

    def _violation(self, condition: Condition, found: _Found) -> Violation:
        return Violation(
            self._severity(condition),
            self.actor,
            self.action.action_name,
            condition.modifier,
            condition.at,
            condition.source or self.action.source,
            found.first,
            found.last,
            found.worst,
            found.deviation,
            QUANTITIES[condition.quantity].unit,
            found.x,
            found.y,
            found.what,
        )

    def _severity(self, condition: Condition) -> Severity:
        """Whether the phase fails: ADR 6 has the reasons."""
        if self._control in EXTERNAL:
            return "warning"
        if self._option == "must_be_physical":
            return "failure"
        if self._option == "prefer_non_physical":
            return "failure" if self._control in EXACT else "warning"
        return "warning" if condition.is_target or condition.at == "all" else "failure"


def _words(condition: Condition, reading: Reading) -> str:
    value, low, high = reading
    unit = QUANTITIES[condition.quantity].unit
    wanted = f"{low:.2f}" if low == high else f"from {low:.2f} to {high:.2f}"
    return f"{condition.what} is {value:.2f}, not {wanted} {unit}"
