"""OpenDRIVE lane types in terms of the domain model (DSL 8.12.6, 8.12.12, 8.12.13)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

from osc2tx_runtime.enums import Directionality, LaneType, LaneUse


class LaneKind(NamedTuple):
    """The type of a lane.

    Attributes:
        type: Its users, roughly.
        use: Its use, in more detail.
        directionality: The allowed directions of motion.
    """

    type: LaneType
    use: LaneUse
    directionality: Directionality


_DRIVING: Mapping[str, LaneUse] = {
    "driving": "normal",
    "entry": "entry",
    "mwyEntry": "entry",
    "exit": "exit",
    "mwyExit": "exit",
    "onRamp": "on_ramp",
    "offRamp": "off_ramp",
    "connectingRamp": "connecting_ramp",
    "slipLane": "other",
    "HOV": "hov",
    "bus": "bus",
    "taxi": "other",
}
_NON_DRIVING: Mapping[str, LaneUse] = {
    "parking": "parking",
    "stop": "stop",
    "restricted": "restricted",
    "border": "border",
    "shoulder": "shoulder",
    "curb": "curb",
    "median": "median",
    "none": "none",
}
_KINDS: Mapping[str, LaneKind] = {
    **{name: LaneKind("driving", use, "uni_direction") for name, use in _DRIVING.items()},
    **{name: LaneKind("non_driving", use, "none") for name, use in _NON_DRIVING.items()},
    "bidirectional": LaneKind("driving", "normal", "bi_direction"),
    "biking": LaneKind("vru_vehicles", "bicycle", "uni_direction"),
    "sidewalk": LaneKind("pedestrian", "sidewalk", "free"),
    "walking": LaneKind("pedestrian", "sidewalk", "free"),
}


LANE_TYPES = frozenset(_KINDS) - {"none"}
"""OpenDRIVE types of lanes, for vehicles and others."""


def kind_of_lane(type_: str) -> LaneKind:
    """The meaning of an OpenDRIVE lane type."""
    return _KINDS.get(type_, LaneKind("other", "other", "other"))
