"""Streets in towns."""

from __future__ import annotations

import math

from own_maps.specs import (
    DRIVING,
    LANE,
    SIDEWALK,
    Bend,
    JunctionSpec,
    LaneSpec,
    MapSpec,
    RoadSpec,
    SignalSpec,
    cross_section,
)


def left_hand() -> MapSpec:
    """Left-hand traffic: two lanes each way, a straight and a right curve."""
    k = -1.0 / 150.0
    bends = (Bend(300), Bend(60, 0.0, k), Bend(100, k, k), Bend(60, k, 0.0), Bend(100))
    lanes = cross_section([DRIVING] * 2 + [SIDEWALK], [DRIVING] * 2 + [SIDEWALK])
    road = RoadSpec("1", "left-hand", (0.0, 0.0, 0.0), bends, ((0.0, lanes),), rule="LHT")
    return MapSpec("left_hand", (road,))


def crossing() -> MapSpec:
    """Straight street of 500 m with sidewalks and a crosswalk in the middle."""
    lanes = cross_section([DRIVING, SIDEWALK], [DRIVING, SIDEWALK])
    road = RoadSpec(
        "1",
        "street",
        (0.0, 0.0, 0.0),
        (Bend(500),),
        ((0.0, lanes),),
        crosswalk=(250.0, 2 * LANE),
        signals=(SignalSpec("1", "pedestrian crossing", 245.0, -4.5, "+", "350"),),
    )
    return MapSpec("crossing", (road,))


ARM, HALF = 150.0, 20.0  # m: length of an arm, distance of its end from the centre


def urban_crossing() -> MapSpec:
    """Crossing of two streets with two lanes each way, turn roads, lights and controllers."""
    arms = tuple(_arm(i) for i in range(4))
    turns: list[RoadSpec] = []
    connections: list[tuple[str, str, tuple[tuple[int, int], ...]]] = []
    for i in range(4):
        for j, (name, offset) in enumerate((("right", 1), ("straight", 2), ("left", 3))):
            road, links = _turn(i, (i + offset) % 4, name, str(10 * (i + 1) + j))
            turns.append(road)
            connections.append((str(i + 1), road.id, links))
    controllers = (("1", "east-west", ("101", "103")), ("2", "north-south", ("102", "104")))
    junction = JunctionSpec("9", "crossing", tuple(connections), ("1", "2"))
    return MapSpec("urban_crossing", arms + tuple(turns), (junction,), controllers)


def _arm(i: int) -> RoadSpec:
    """Arm i lies at i x 90 degrees; s runs towards the crossing."""
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[i]
    far = ARM + HALF
    lanes = cross_section([DRIVING] * 2 + [SIDEWALK], [DRIVING] * 2 + [SIDEWALK])
    light = SignalSpec(f"{101 + i}", f"light {i + 1}", ARM - 1.0, -8.0, "+", "1000001", True)
    return RoadSpec(
        str(i + 1),
        ("east", "north", "west", "south")[i],
        (c * far, s * far, math.pi / 2 * i - math.pi if i else math.pi),
        (Bend(ARM),),
        ((0.0, lanes),),
        successor=("junction", "9", ""),
        crosswalk=(ARM - 6.0, 4 * LANE),
        signals=(
            light,
            SignalSpec(
                f"{201 + i}", "speed limit", 10.0, -8.0, "+", "274", value="50", unit="km/h"
            ),
        ),
    )


def _turn(
    i: int, target: int, name: str, identity: str
) -> tuple[RoadSpec, tuple[tuple[int, int], ...]]:
    """Connecting road from arm i; its reference line is the left edge of its lanes."""
    c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[i]
    h = math.pi / 2 * i - math.pi if i else math.pi
    aside = LANE if name == "right" else 0.0
    # Inbound heading is (-c, -s), so its right-hand side is (-s, c).
    start = (c * HALF - s * aside, s * HALF + c * aside, h)
    radius = {"right": -(HALF - LANE), "left": HALF}.get(name)
    bend = Bend(2 * HALF)
    if radius is not None:
        bend = Bend(abs(radius) * math.pi / 2, 1.0 / radius, 1.0 / radius)
    links: tuple[tuple[int, int], ...]
    if name == "straight":
        links, exits = ((-1, -1), (-2, -2)), {-1: 1, -2: 2}
    elif name == "right":
        links, exits = ((-2, -1),), {-1: 2}
    else:
        links, exits = ((-1, -1),), {-1: 1}
    lanes = tuple(LaneSpec(to, "driving", LANE, "none", source, exits[to]) for source, to in links)
    road = RoadSpec(
        identity,
        f"{name} from {i + 1}",
        start,
        (bend,),
        ((0.0, lanes),),
        junction="9",
        predecessor=("road", str(i + 1), "end"),
        successor=("road", str(target + 1), "end"),
    )
    return road, links
