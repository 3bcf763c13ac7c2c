"""Motorways and country roads."""

from __future__ import annotations

from own_maps.shapes import ending_at
from own_maps.specs import (
    DRIVING,
    LANE,
    SHOULDER,
    Bend,
    Cubic,
    JunctionSpec,
    LaneSpec,
    MapSpec,
    Place,
    RoadSpec,
    SignalSpec,
    cross_section,
    hermite,
)


def highway() -> MapSpec:
    """Motorway of 2 km: 4 lanes one way, 3 the other; straight for 1300 m, then a gentle left."""
    k = 1.0 / 800.0
    bends = (Bend(1300), Bend(120, 0.0, k), Bend(260, k, k), Bend(120, k, 0.0), Bend(200))
    lanes = cross_section([DRIVING] * 4 + [SHOULDER], [DRIVING] * 3 + [SHOULDER])
    sign = SignalSpec("1", "speed limit", 50.0, -18.5, "+", "274", value="120", unit="km/h")
    road = RoadSpec(
        "1",
        "highway",
        (0.0, 0.0, 0.0),
        bends,
        ((0.0, lanes),),
        speed=120,
        type="motorway",
        signals=(sign,),
    )
    return MapSpec("highway", (road,))


def curve() -> MapSpec:
    """S-curve of clothoids and arcs with elevation and superelevation."""
    k = 1.0 / 120.0
    bends = (
        Bend(100),
        Bend(50, 0.0, k),
        Bend(120, k, k),
        Bend(50, k, 0.0),
        Bend(50, 0.0, -k),
        Bend(120, -k, -k),
        Bend(50, -k, 0.0),
        Bend(100),
    )
    lanes = cross_section([DRIVING] * 2 + [SHOULDER], [DRIVING] * 2 + [SHOULDER])
    # The road leans into the curve: left curve, left side down.
    roll = hermite(
        [(0, 0), (100, 0), (150, -0.05), (270, -0.05), (370, 0.05), (490, 0.05), (540, 0)]
    )
    road = RoadSpec(
        "1",
        "s-curve",
        (0.0, 0.0, 0.0),
        bends,
        ((0.0, lanes),),
        speed=70,
        type="rural",
        elevation=hermite([(0, 0), (80, 0), (300, 6), (400, 6), (600, 1)]),
        superelevation=roll,
    )
    return MapSpec("curve", (road,))


MERGE = 340.0  # m, x at which the ramp has joined the motorway
TWO_LANES = (DRIVING, DRIVING, ("shoulder", 2.5))
THREE_LANES = (DRIVING, DRIVING, ("entry", LANE), ("shoulder", 2.5))


def merge() -> MapSpec:
    """Motorway with an on-ramp: junction, acceleration lane, taper."""
    to_junction = ("junction", "5", "")
    joint = (Bend(40, -0.00375, -0.00375),)
    joint_start = ending_at((MERGE, -2 * LANE, 0.0), joint)
    ramp = (Bend(150), Bend(50, -0.003, -0.003))
    ramp_lanes = cross_section([DRIVING, ("shoulder", 1.5)], [])
    before = RoadSpec(
        "1",
        "before",
        (0.0, 0.0, 0.0),
        (Bend(300),),
        ((0.0, cross_section(TWO_LANES, [])),),
        speed=120,
        type="motorway",
        successor=to_junction,
    )
    after = RoadSpec(
        "2",
        "after",
        (MERGE, 0.0, 0.0),
        (Bend(600),),
        _sections_after_merge(),
        speed=120,
        type="motorway",
        predecessor=to_junction,
    )
    ramp_road = RoadSpec(
        "3",
        "ramp",
        ending_at(joint_start, ramp),
        ramp,
        ((0.0, ramp_lanes),),
        speed=80,
        type="motorway",
        successor=to_junction,
    )
    # The shoulder ends at the ramp.
    through = tuple(
        _linked(x, x.id, None if x.id == -3 else x.id) for x in cross_section(TWO_LANES, [])
    )
    entry = (LaneSpec(-1, mark="solid", before=-1, after=-3),)
    connectors = (
        _merge_connector("10", "through", (300.0, 0.0, 0.0), (Bend(40),), through, "1"),
        _merge_connector("11", "entry", joint_start, joint, entry, "3"),
    )
    connections = (("1", "10", ((-1, -1), (-2, -2), (-3, -3))), ("3", "11", ((-1, -1),)))
    junction = JunctionSpec("5", "merge", connections)
    return MapSpec("merge", (before, after, ramp_road, *connectors), (junction,))


def _sections_after_merge() -> tuple[tuple[float, tuple[LaneSpec, ...]], ...]:
    """Acceleration lane of 200 m, then 100 m in which it closes, then two lanes."""
    taper = 100.0
    closing = ((0.0, LANE, 0.0, -3.0 * LANE / taper**2, 2.0 * LANE / taper**3),)
    wide = cross_section(THREE_LANES, [])
    beside = tuple(_linked(x, None if x.id == -4 else x.id, x.id) for x in wide)
    narrowing = tuple(
        _linked(x, x.id, {-3: None, -4: -3}.get(x.id, x.id), closing if x.id == -3 else None)
        for x in wide
    )
    two = tuple(_linked(x, {-3: -4}.get(x.id, x.id), None) for x in cross_section(TWO_LANES, []))
    return (0.0, beside), (200.0, narrowing), (300.0, two)


def _merge_connector(
    identity: str,
    name: str,
    start: Place,
    bends: tuple[Bend, ...],
    lanes: tuple[LaneSpec, ...],
    source: str,
) -> RoadSpec:
    """Connecting road of the merge, from the end of `source` to the motorway after it."""
    return RoadSpec(
        identity,
        name,
        start,
        bends,
        ((0.0, lanes),),
        speed=120 if source == "1" else 80,
        type="motorway",
        junction="5",
        predecessor=("road", source, "end"),
        successor=("road", "2", "start"),
    )


def _linked(
    lane: LaneSpec, before: int | None, after: int | None, width: tuple[Cubic, ...] | None = None
) -> LaneSpec:
    """A lane with links, and with another width if one is given."""
    return LaneSpec(lane.id, lane.type, width or lane.width, lane.mark, before, after)
