"""The base of actions that change a quantity with a rate profile and a peak rate."""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Unpack

from osc2tx_runtime.domain.modifiers import Modifier, Value, value_of
from osc2tx_runtime.domain.modifiers.groups import SIDE_FREE
from osc2tx_runtime.domain.planning.feasibility import check_peak
from osc2tx_runtime.enums import DynamicProfile
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.language.actions.action import ActionOptions
from osc2tx_runtime.world.geometry.profiles import PROFILES
from osc2tx_shared.rules import above

from .modifiable import ModifiableAction

if TYPE_CHECKING:
    from osc2tx_runtime.domain.actors import MovableObject


def check_profile(name: str, profile: str) -> None:
    """Rejects a profile that does not exist."""
    if profile not in PROFILES:
        raise ScenarioError(f"{name}: rate_profile `{profile}` is not one of {', '.join(PROFILES)}")


def peak_of(value: Value | None, unit: str) -> float | None:
    """The peak of a rate now, with its unit for messages; None if none is given.

    Raises:
        Refused: It is not positive.
    """
    peak = None if value is None else value_of(value)
    check_peak(peak, unit)
    return peak


class RatedChange(ModifiableAction):
    """Reaches a target in the speed slot.

    Args:
        actor: The actor.
        *modifiers: Modifiers of the lane.
        target: The target value, in SI units.
        rate_profile: Profile of the first derivative.
        rate_peak: Its peak; default: the duration, else the limits of the actor.
        **options: Duration and label.
    """

    rules = (above(0, "rate_peak"),)
    unit: ClassVar[str]  # of the rate
    accepts: ClassVar[tuple[type, ...]] = SIDE_FREE

    def __init__(
        self,
        actor: MovableObject,
        *modifiers: Modifier,
        target: Value,
        rate_profile: DynamicProfile = "none",
        rate_peak: Value | None = None,
        **options: Unpack[ActionOptions],
    ) -> None:
        super().__init__(actor, *modifiers, **options)
        check_profile(self.action_name, rate_profile)
        self.target = target
        self.rate_profile: DynamicProfile = rate_profile
        self._rate_peak = rate_peak

    @property
    def rate_peak(self) -> float | None:
        """The peak of the rate now; None if none is given.

        Raises:
            Refused: It is not positive.
        """
        return peak_of(self._rate_peak, self.unit)

    def takes_too_long(self, peak: str, own: float) -> str | None:
        """Why peak and duration contradict each other.

        None if they are compatible, or without a duration.

        Args:
            peak: The peak with its unit.
            own: Seconds that the change takes with this peak.
        """
        duration = self.fixed_duration()
        if duration is None or abs(own - duration) <= self.context.dt:
            return None
        return f"with rate_peak {peak} it takes {own:.2f} s, not {duration:g} s"
