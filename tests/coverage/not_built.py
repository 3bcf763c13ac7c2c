"""What the standard allows and the compiler refuses: the report, and the reason."""

from __future__ import annotations

from typing import NamedTuple


class NotBuilt(NamedTuple):
    """A use that is refused.

    Attributes:
        what: As the page names it.
        code: The report.
        why: The reason.
        text: Declarations, and the behavior of a scenario with `road`, `ego` and `walker`.
    """

    what: str
    code: str
    why: str
    text: str


HEAD = """import osc.standard.all

namespace null use std, stdtypes

scenario base:
    quick: bool
    do serial:
        wait elapsed(1s)
scenario hasty inherits base(quick == true):
    event early
"""
SCENARIO = """
namespace null use std, stdtypes
scenario top:
    road: map with:
        keep(it.map_file == "crossing.xodr")
    ego: vehicle
    walker: person
"""
DRIVE = """
    do serial:
        ego.drive(duration: 1s) with:
            """

NOT_BUILT = (
    NotBuilt(
        "constraints on roads and lanes other than closed bounds, values and lists:"
        ' `keep(it.length > 100m)`, `keep(r.anchors[0] == "3")`',
        "OSC502",
        "parts of the map are searched by what they are given; other expressions have no value"
        " before the search ends. `keep(it.length >= 100m)` says nearly the same",
        SCENARIO + "    r: road with:\n        keep(it.length > 100m)" + DRIVE + "along(r)\n",
    ),
    NotBuilt(
        "two fields of one name that a type has in different namespaces, by extensions or from its"
        " base",
        "OSC501",
        "types are Python classes, whose attributes have one name; types of one name in several"
        " namespaces are built",
        "namespace one use std, stdtypes\nextend vehicle:\n    n: int = 1\n"
        "namespace two use std, stdtypes\nextend vehicle:\n    n: int = 2\n"
        + (SCENARIO + DRIVE + "speed(5mps)\n"),
    ),
    NotBuilt(
        "an actor that is a field of a struct or of another actor, and that nothing names",
        "OSC501",
        "the cast of a scenario are its own fields and lists, so that each actor has a name of its"
        " own in traces and settings. A field inside of an object is one of them:"
        " `keep(p.lead == ego)`",
        "struct pair_of_cars:\n    lead: vehicle\n"
        + SCENARIO.replace("\nnamespace null use std, stdtypes\n", "")
        + "    p: pair_of_cars"
        + DRIVE
        + "speed(p.lead.speed)\n",
    ),
    NotBuilt(
        "`distance`, `change_lane` or `change_speed` as a member of a"
        " scenario, or of a composition, in which the actor carries out several actions",
        "OSC508",
        "it is about the whole: each of the actions would cover the distance or change the lane."
        " In the `with` of one action it is built",
        SCENARIO
        + "    ego.distance(40m)"
        + DRIVE
        + "speed(5mps)\n        ego.drive(duration: 1s)\n",
    ),
    NotBuilt(
        "`lateral` of persons and other actors that follow no lane",
        "OSC508",
        "they move along paths, routes and crossings, and have no lane in which an offset is kept;"
        " a path beside the line says it",
        SCENARIO
        + "    c: crossing\n    do serial:\n        walker.walk(duration: 1s) with:\n"
        + "            along(c)\n            lateral(0.5m, side: left)\n",
    ),
)
