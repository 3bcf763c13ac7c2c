"""The map actor: the road network (DSL 8.12.2)."""

from __future__ import annotations

from collections.abc import Sequence

from osc2tx_runtime.domain.actors.road_network import RoadNetwork
from osc2tx_runtime.domain.methods import TrafficLightControllerMethods
from osc2tx_runtime.domain.objects.base import Actor
from osc2tx_runtime.domain.signals.traffic_lights import TrafficLightControl, TrafficLightCycle
from osc2tx_runtime.enums import DrivingRule


class Map(Actor, RoadNetwork, TrafficLightControl):
    """The road network.

    Args:
        name: Role name.
        map_file: File name with or without `.xodr`, found in the folders of `--map-path`, then
            among the maps of the runtime.
        driving_rule: The required rule of the map: `left_hand_traffic` or `right_hand_traffic`.
        traffic_light_control: Cycles from which `sync` of the traffic light actions takes the
            states of synchronized lights; they are not played automatically.
    """

    kinds = ("map", *Actor.kinds)
    one_per_run = True

    def __init__(
        self,
        *,
        name: str | None = None,
        map_file: str | None = None,
        driving_rule: DrivingRule | None = None,
        traffic_light_control: Sequence[TrafficLightCycle] = (),
    ) -> None:
        super().__init__(name=name)
        self.named_file = map_file
        self.required_rule = driving_rule
        self.traffic_light_control = list(traffic_light_control)

    @property
    def driving_rule(self) -> DrivingRule:
        """The side on which its roads are driven."""
        return "right_hand_traffic" if self.outer_side() == "right" else "left_hand_traffic"


class TrafficLightController(Actor, TrafficLightControllerMethods):
    """Switches traffic lights."""

    kinds = ("traffic_light_controller", *Actor.kinds)
