"""How the costs of road maps grow with their size: seconds, memory, and exponents.

    python benchmarks/maps.py [--largest] [shape ...]

Each shape is a map of n parts. Every size is read in a process of its own, which then asks what
runs, checks and reports ask. Printed are CPU seconds and the peak of memory (MB, with that of the
interpreter), and the exponent of the seconds from size to size: 1.00 is linear. `--largest` takes
the sizes of `LARGEST` as well. `tests/runtime/opendrive/test_growth.py` counts the work of the
same shapes.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "runtime_lib"))

from osc2tx_runtime.opendrive import LanePosition, RoadMap, read_map_text

WIDTH = '<width sOffset="0" a="3.5" b="0" c="0" d="0"/>'


def lane(number: int, inner: str = WIDTH) -> str:
    """A driving lane that goes on as the lane of the same number."""
    link = f'<link><predecessor id="{number}"/><successor id="{number}"/></link>'
    return f'<lane id="{number}" type="driving">{link}{inner}</lane>'


def section(s: float, right: str, left: str = "") -> str:
    """A lane section."""
    left = f"<left>{left}</left>" if left else ""
    return f'<laneSection s="{s}">{left}<right>{right}</right></laneSection>'


def piece(s: float, x: float, y: float, length: float, shape: str = "<line/>") -> str:
    """A piece of a reference line, along x at its begin."""
    return f'<geometry s="{s}" x="{x}" y="{y}" hdg="0" length="{length}">{shape}</geometry>'


def road(
    name: int, length: float, view: str, sections: str, *, link: str = "", junction: int = -1
) -> str:
    """A road."""
    return (
        f'<road id="{name}" length="{length}" junction="{junction}"><link>{link}</link>'
        f"<planView>{view}</planView><lanes>{sections}</lanes></road>\n"
    )


def drive(parts: Iterable[str]) -> str:
    """A map."""
    return f"<OpenDRIVE>{''.join(parts)}</OpenDRIVE>"


BOTH = section(0, lane(-1), lane(1))


def _joined(kind: str, number: int, contact: str) -> str:
    return f'<{kind} elementType="road" elementId="{number}" contactPoint="{contact}"/>'


def chain(n: int) -> str:
    """Roads of 20 m in rows of a hundred, each linked to the one before and the next."""
    roads = []
    for i in range(n):
        before = _joined("predecessor", i - 1, "end") if i % 100 else ""
        after = _joined("successor", i + 1, "start") if (i + 1) % 100 and i + 1 < n else ""
        view = piece(0, 20.0 * (i % 100), 50.0 * (i // 100), 20)
        roads.append(road(i, 20, view, BOTH, link=before + after))
    return drive(roads)


def crossings(n: int) -> str:
    """Roads in rows, with a junction of three connecting roads between each two."""
    parts = []
    for i in range(n):
        x, y = 60.0 * (i % 50), 40.0 * (i // 50)
        ends = f'<predecessor elementType="junction" elementId="{i - 1}"/>' if i % 50 else ""
        ends += f'<successor elementType="junction" elementId="{i}"/>'
        parts.append(road(10 * i, 40, piece(0, x, y, 40), section(0, lane(-1)), link=ends))
        if (i + 1) % 50 == 0 or i + 1 == n:
            continue
        found = ""
        for k in range(1, 4):
            onto = _joined("predecessor", 10 * i, "end") + _joined(
                "successor", 10 * i + 10, "start"
            )
            view, number = piece(0, x + 40, y, 20), 10 * i + k
            parts.append(road(number, 20, view, section(0, lane(-1)), link=onto, junction=i))
            found += f'<connection id="{k}" incomingRoad="{10 * i}" connectingRoad="{number}"'
            found += ' contactPoint="start"><laneLink from="-1" to="-1"/></connection>'
        parts.append(f'<junction id="{i}">{found}</junction>')
    return drive(parts)


def fan(n: int) -> str:
    """A junction in which a road leads to many."""
    into = '<successor elementType="junction" elementId="0"/>'
    parts = [road(0, 100, piece(0, -100, 0, 100), section(0, lane(-1)), link=into)]
    found = ""
    for i in range(1, n + 1):
        view, back = piece(0, 0, 10.0 * i, 50), _joined("predecessor", 0, "end")
        parts.append(road(i, 50, view, section(0, lane(-1)), link=back, junction=0))
        found += f'<connection id="{i}" incomingRoad="0" connectingRoad="{i}"'
        found += ' contactPoint="start"><laneLink from="-1" to="-1"/></connection>'
    return drive([*parts, f'<junction id="0">{found}</junction>'])


def widths(n: int) -> str:
    """A road whose lanes have many widths."""
    rows = "".join(
        f'<width sOffset="{0.5 * i}" a="{3 + i % 2}" b="0" c="0" d="0"/>' for i in range(n)
    )
    lanes = section(0, lane(-1, rows) + lane(-2, rows), lane(1, rows))
    return drive([road(0, 0.5 * n, piece(0, 0, 0, 0.5 * n), lanes)])


def pieces(n: int) -> str:
    """A road of many pieces."""
    view = "".join(piece(5.0 * i, 5.0 * i, 0, 5) for i in range(n))
    return drive([road(0, 5.0 * n, view, BOTH)])


def motorway(n: int) -> str:
    """A road of many sections, each with pieces, widths, heights and offsets of its own."""
    each = range(n)
    view = "".join(piece(50.0 * i, 50.0 * i, 0, 50) for i in each)
    rows = WIDTH + '<width sOffset="25" a="3.5" b="0.01" c="0" d="0"/>'
    lanes = "".join(
        f'<laneOffset s="{50 * i}" a="0.1" b="0" c="0" d="0"/>' for i in each
    ) + "".join(section(50.0 * i, lane(-1, rows) + lane(-2), lane(1, rows)) for i in each)
    heights = "".join(f'<elevation s="{50 * i}" a="{i % 2}" b="0" c="0" d="0"/>' for i in each)
    rolls = "".join(f'<superelevation s="{50 * i}" a="0.01" b="0" c="0" d="0"/>' for i in each)
    found = road(0, 50.0 * n, view, lanes)
    profiles = f"<elevationProfile>{heights}</elevationProfile>"
    profiles += f"<lateralProfile>{rolls}</lateralProfile>"
    return drive([found.replace("<lanes>", profiles + "<lanes>")])


def one_sided(n: int) -> str:
    """A road with sections of one side, over lanes of the other side with as many widths."""
    rows = "".join(
        f'<width sOffset="{40 * i}" a="{3 + i % 2}" b="0" c="0" d="0"/>' for i in range(n)
    )
    lanes = section(0, lane(-1, rows), lane(1))
    lanes += "".join(
        f'<laneSection s="{40 * i}" singleSide="true"><left>{lane(1)}</left></laneSection>'
        for i in range(1, n)
    )
    return drive([road(0, 40.0 * n, piece(0, 0, 0, 40.0 * n), lanes)])


def abreast(n: int) -> str:
    """A road with many lanes side by side."""
    return drive(
        [road(0, 500, piece(0, 0, 0, 500), section(0, "".join(map(lane, range(-1, -n - 1, -1)))))]
    )


def straight(n: int) -> str:
    """A road of n km."""
    return drive([road(0, 1000.0 * n, piece(0, 0, 0, 1000.0 * n), BOTH)])


def ring(n: int) -> str:
    """A road of n km along circles of 5 km radius."""
    return drive([road(0, 1000.0 * n, piece(0, 0, 0, 1000.0 * n, '<arc curvature="2e-4"/>'), BOTH)])


def spiral(n: int) -> str:
    """A road of n km along a spiral of many turns."""
    shape = '<spiral curvStart="0.0001" curvEnd="0.001"/>'
    return drive([road(0, 1000.0 * n, piece(0, 0, 0, 1000.0 * n, shape), BOTH)])


def curve(n: int) -> str:
    """A road of n km along a polynomial."""
    u, v = f'aU="0" bU="{1000 * n}" cU="0" dU="0"', f'aV="0" bV="0" cV="{100 * n}" dV="{-50 * n}"'
    shape = f'<paramPoly3 {u} {v} pRange="normalized"/>'
    return drive([road(0, 1000.0 * n, piece(0, 0, 0, 1000.0 * n, shape), BOTH)])


def furniture(n: int) -> str:
    """A road with signals, their controllers, and crosswalks."""
    each = range(n)
    corners = "".join(
        f'<cornerLocal u="{u}" v="{v}" z="0"/>' for u, v in ((0, -4), (3, -4), (3, 4), (0, 4))
    )
    objects = "".join(
        f'<object id="{i}" type="crosswalk" s="{20 * i}" t="0">'
        f"<outline>{corners}</outline></object>"
        for i in each
    )
    signals = "".join(
        f'<signal id="{i}" s="{20 * i}" t="-4" dynamic="yes" orientation="+" type="1000001"/>'
        for i in each
    )
    controllers = "".join(
        f'<controller id="{i}"><control signalId="{i}"/></controller>' for i in each
    )
    found = road(0, 20.0 * n, piece(0, 0, 0, 20.0 * n), BOTH)
    extra = f"<objects>{objects}</objects><signals>{signals}</signals></road>"
    return drive([found.replace("</road>", extra), controllers])


SHAPES: Mapping[str, tuple[Callable[[int], str], int]] = {
    shape.__name__: (shape, size)
    for shape, size in (
        (chain, 1000),
        (crossings, 300),
        (fan, 300),
        (widths, 1000),
        (pieces, 1000),
        (motorway, 300),
        (one_sided, 100),
        (abreast, 50),
        (straight, 20),
        (ring, 20),
        (spiral, 20),
        (curve, 20),
        (furniture, 300),
    )
}
"""Each shape with its smallest size."""

LARGEST = {"chain": 50_000, "widths": 20_000, "straight": 1000, "ring": 1000, "spiral": 1000}


def ask(text: str) -> RoadMap:
    """Read a map, and ask what a run, a check and a report ask of it."""
    road_map = read_map_text(text)
    steps: Mapping[str, Callable[[], object]] = {
        "bounds": road_map.bounds,
        "spawn": road_map.spawn_points,
        "seams": road_map.seams,
        "furniture": lambda: (road_map.signals(), road_map.controllers(), road_map.crosswalks()),
        "lengths": lambda: [
            road_map.lane_length(each.key)
            for road in road_map.roads.values()
            for section in road.sections
            for each in section.lanes.values()
        ],
        "walk": lambda: walk(road_map),
        "outlines": lambda: sum(1 for _ in road_map.lane_outlines((-50, -50, 50, 50))),
    }
    for step in steps.values():
        step()
    return road_map


def walk(road_map: RoadMap) -> None:
    """Go along the map in a hundred places: poses, positions, distances."""
    points = road_map.spawn_points()
    for place in points[:: max(1, len(points) // 100)]:
        pose = road_map.pose(place)
        road_map.locate(pose.x, pose.y)
        road_map.locate(pose.x, pose.y, hint=place)
        onward = road_map.advance(place, 30.0).position
        road_map.route_distance(place, onward)
        road_map.route_to(onward)
        road_map.neighbour(place, "left")
        road_map.lanes(place.road, place.s)
    first, last = points[0], points[-1]
    road_map.route_distance(first, LanePosition(last.road, first.lane, last.s))


def measure(name: str, size: int) -> None:
    """Print what one map costs, as JSON."""
    import resource

    text = SHAPES[name][0](size)
    begin = time.process_time()
    ask(text)
    seconds = time.process_time() - begin
    print(json.dumps([seconds, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024]))


def main() -> None:
    parser = argparse.ArgumentParser(description="Growth of the costs of road maps.")
    parser.add_argument("shapes", nargs="*", choices=[[], *SHAPES], help="all, if left out")
    parser.add_argument("--largest", action="store_true", help="the largest sizes as well")
    parser.add_argument("--one", type=int, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.one:
        measure(arguments.shapes[0], arguments.one)
        return
    for name in arguments.shapes or SHAPES:
        sizes = [SHAPES[name][1] * factor for factor in (1, 2, 4)]
        sizes += [LARGEST[name]] if arguments.largest and name in LARGEST else []
        costs = []
        for size in sizes:
            command = [sys.executable, __file__, name, "--one", str(size)]
            found = subprocess.run(command, capture_output=True, text=True, check=True)
            costs.append(json.loads(found.stdout))
        exponents = " ".join(
            f"{math.log(costs[i + 1][0] / costs[i][0]) / math.log(sizes[i + 1] / sizes[i]):.2f}"
            for i in range(len(sizes) - 1)
        )
        told = "  ".join(f"{seconds:7.2f} s {memory:5.0f} MB" for seconds, memory in costs)
        print(f"{name:<10} {sizes!s:<26} {told}   {exponents}", flush=True)


if __name__ == "__main__":
    main()
