"""Actions of the actor type `traffic_light_controller`; made by tools/make_actor_methods.py."""

# The registry executes these declarations.
# mypy: disable-error-code="empty-body"

from __future__ import annotations

from typing import TYPE_CHECKING

from osc2tx_runtime.language.actions.registry import carried_out

if TYPE_CHECKING:
    from collections.abc import Sequence

    from osc2tx_runtime.domain.signals.traffic_lights import (
        Bulbs,
        TrafficLight,
        TrafficLightCycle,
        TrafficLightGroup,
    )
    from osc2tx_runtime.enums import BulbColor, BulbIcon, BulbState, SemanticTrafficLightState
    from osc2tx_runtime.language.tree.base import Behaviour
    from osc2tx_runtime.language.tree.duration_limits import Duration


@carried_out
class TrafficLightControllerMethods:
    """Actions of the actor type `traffic_light_controller`."""

    def play_cycles(
        self,
        label: str | None = None,
        /,
        *,
        cycles: Sequence[TrafficLightCycle],
        duration: Duration | None = None,
    ) -> Behaviour:
        """Repeat cycles until another action switches one of the lights (§8.15.9.7.1).

        Args:
            *modifiers: None are taken.
            cycles: At most one for each light.
        """

    def set_bulb_state(
        self,
        label: str | None = None,
        /,
        *,
        traffic_light: TrafficLight,
        bulb_color: BulbColor,
        bulb_kind: BulbIcon,
        bulb_state: BulbState,
        sync: bool = False,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Switch one lamp of a traffic light, chosen by its color and symbol (§8.15.9.1.1)."""

    def set_group_bulb_state(
        self,
        label: str | None = None,
        /,
        *,
        traffic_light: TrafficLight,
        bulb_color: BulbColor,
        bulb_kind: BulbIcon,
        bulb_state: BulbState,
        sync: bool = False,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Switch one lamp of each traffic light in the group of a light (§8.15.9.4.1)."""

    def set_group_semantic_state(
        self,
        label: str | None = None,
        /,
        *,
        traffic_light_group: TrafficLightGroup,
        state: SemanticTrafficLightState,
        sync: bool = False,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Set the semantic state of each traffic light in a group (§8.15.9.6.1).

        Lights without lamps for it ignore it.
        """

    def set_group_state(
        self,
        label: str | None = None,
        /,
        *,
        group: TrafficLightGroup,
        state: Bulbs,
        sync: bool = False,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Switch all lamps of each traffic light in a group (§8.15.9.5.1)."""

    def set_semantic_state(
        self,
        label: str | None = None,
        /,
        *,
        traffic_light: TrafficLight,
        state: SemanticTrafficLightState,
        sync: bool = False,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Set the semantic state of a traffic light; ignored if it has no lamps for it.

        Section §8.15.9.3.1.
        """

    def set_state(
        self,
        label: str | None = None,
        /,
        *,
        traffic_light: TrafficLight,
        state: Bulbs,
        sync: bool = False,
        duration: Duration | None = None,
    ) -> Behaviour:
        """Switch all lamps of a traffic light, in their order (§8.15.9.2.1)."""
