"""The smallest scenarios in which esmini goes by laws of its own, each with what avoids it."""

from tests.xosc.case_texts import point, source


def _drive(actor: str, lane: int, place: str, deep: int = 1) -> str:
    left = "    " * deep
    return (
        f"{left}{actor}.drive(duration: 2s) with:\n{left}    lane({lane}, at: start)\n"
        f"{left}    position({place}, at: start)\n{left}    speed(10mps)\n"
    )


BESIDE_IN_A_BEND = source(
    [
        (
            "beside",
            "ego, other: vehicle\ndo parallel:\n"
            + _drive("ego", 2, "211m")
            + _drive("other", 1, "55m, ahead_of: ego"),
        )
    ],
    "curve",
)
"""esmini counts the 55 m along the middle of the road, which bends to the left."""

AFTER_AN_EVEN_CHANGE = source(
    [
        (
            "after",
            "ego: vehicle\ndo serial:\n"
            + _drive("ego", 2, "40m")
            + "    ego.change_speed(target: 20mps, rate_profile: constant, rate_peak: 2mpss)\n"
            "    ego.change_speed(target: 10mps)\n    ego.drive(duration: 2s)\n",
        )
    ]
)
"""esmini's profile of speeds begins with the 2 m/s² of the step before."""

PUT_AT_THE_START = source(
    [
        (
            "put",
            "ego: vehicle\ndo serial:\n    ego.assign_position(\n        odr_point: "
            'road.create_odr_point(road_id: "1", lane_id: "2", s: 350m, t: 0m)\n    )\n'
            "    ego.assign_speed(speed: 20mps)\n"
            "    ego.drive(duration: 2s) with:\n        speed(20mps)\n",
        )
    ],
    "curve",
)
"""esmini looks at each event once in a step, so that a chain of three is over after three steps."""

CHANGE_AT_A_FORK = source(
    [
        (
            "fork",
            "ego: vehicle\n"
            + point("begin", -40, -1.75)
            + "do serial:\n    ego.drive(duration: 1s) with:\n"
            "        position(at_point: begin, project_on_route: false, at: start)\n"
            "        speed(10mps)\n"
            "    ego.change_lane(side: right, duration: 4s)\n"
            "    ego.drive(duration: 2s) with:\n        speed(10mps)\n",
        )
    ],
    "urban_crossing",
)
"""esmini draws by lot which road of a junction is taken in the middle of a lane change."""

WAITS_FOR_THE_SAME_INSTANT = source(
    [
        (
            "waits",
            "ego, other: vehicle\nevent happened\ndo parallel:\n    serial:\n"
            + _drive("ego", 2, "40m", 2)
            + "        emit happened\n    serial:\n"
            + _drive("other", 1, "40m", 2)
            + "        wait @happened\n        other.drive(duration: 2s) with:\n"
            "            acceleration(2mpss)\n",
        )
    ]
)
"""esmini looks at no condition behind a false one, and takes no first look for a change."""

PULLS_OUT_FROM_STANDSTILL = source(
    [
        (
            "pulls_out",
            "ego, parked: vehicle\n" + point("spot", 220, -2.9) + """do parallel(overlap: start):
    serial:
        parked.remain_stationary(duration: 3s) with:
            position(at_point: spot, project_on_route: false, at: start)
        parallel:
            parked.change_speed(target: 6mps, rate_profile: constant, rate_peak: 1.5mpsps)
            parked.follow_lane(offset: 0m, duration: 4s)
    serial:
        ego.drive() with:
            lane(1, at: start)
            position(130m, at: start)
            speed(11mps)
            until (parked.speed > 1mps)
        ego.change_speed(target: 5mps, rate_profile: smooth, duration: 3s)
""",
        )
    ],
    "crossing",
)
"""With `direction`, esmini takes lateral motion of a slow car for a part of its speed."""

FOLLOWS_IN_A_BEND = source(
    [
        (
            "follows",
            "lead, ego: vehicle\ndo parallel:\n    serial:\n"
            + _drive("lead", 1, "140m", 2)
            + "        lead.change_speed(target: 6mps, rate_profile: constant, rate_peak: 2mpss)\n"
            "        lead.drive(duration: 2s)\n"
            "    ego.{action}(reference: lead, direction: longitudinal) with:\n"
            "        lane(1, at: start)\n        position(20m, behind: lead, at: start)\n"
            "        speed(10mps, at: start)\n",
        )
    ],
    "curve",
)
"""esmini fits gaps to the boxes as they stand, and a time to the speed of the one ahead."""

LEFT_IN_A_JUNCTION = source(
    [
        (
            "left",
            """cross: vehicle
arm, onward: road
middle: junction
road.roads_follow_in_junction(
    junction: middle, in_road: arm, out_road: onward, direction: left
)
keep(arm.anchors == ["south"])
way: compound_route = road.create_route([arm, onward])
do serial:
    cross.drive(duration: 14s) with:
        along(way, start_offset: 30m)
        speed(9mps)
    cross.drive(duration: 6s)
""",
        )
    ],
    "urban_crossing",
)
"""The way is left by a change to the own lane, in a junction where roads overlap."""

GAP = "space_gap(reference: lead, direction: longitudinal) < -8m"
HEADWAY = "space_headway(reference: lead) > 12m"
LOOKS_AT_A_GAP_IN_A_BEND = source(
    [
        (
            "looks",
            "lead, ego: vehicle\ndo parallel:\n"
            + _drive("lead", 1, "190m", 1).replace("duration: 2s", "duration: 6s")
            + """\
    serial:
        ego.drive() with:
            lane(1, at: start)
            position(25m, behind: lead, at: start)
            speed(14mps)
            until fall(ego.{measure})
        ego.change_speed(target: 10mps, rate_profile: constant, rate_peak: 4mpss)
""",
        )
    ],
    "curve",
)
"""The outer lane is longer than the road, along which esmini counts."""

WALKS_A_RELATIVE_WAY = source(
    [
        (
            "walks",
            "ego: vehicle\nw: person\n" + point("kerb", 100, -5) + """\
here: pose_3d with:
    keep(it.position.x == 0m)
    keep(it.position.y == 0m)
ahead: pose_3d with:
    keep(it.position.x == 6m)
    keep(it.position.y == 0m)
way: relative_path_pose_3d with:
    keep(it.points == [here, ahead])
    keep(it.interpolation == straight_line)
do parallel:
    serial:
        w.walk(duration: 1s) with:
            position(at_point: kerb, project_on_route: false, at: start)
            yaw(70deg, at: start)
            speed(1.5mps)
        w.replay_path(relative: way, reference: w, transform: object_relative) with:
            speed(1.5mps)
END
""" + _drive("ego", 1, "20m").replace("duration: 2s", "duration: 12s"),
        )
    ],
    "crossing",
)
"""Behind the way it goes straight on."""
