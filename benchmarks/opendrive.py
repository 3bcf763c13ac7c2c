"""Times of the OpenDRIVE reader, as ratios against U and against `carla.Map` where it exists.

U is one `next()` on a trivial generator on the same machine: ratios survive a change of machine,
microseconds do not. Run with OpenDRIVE files, or with the folder of third-party maps:

    python benchmarks/opendrive.py MAP.xodr ...
    OSC2TX_TEST_DATA=... python benchmarks/opendrive.py
"""

import gc
import math
import os
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "runtime_lib"))

from osc2tx_runtime.opendrive import LanePosition, RoadMap, read_map  # noqa: E402

try:
    import carla  # type: ignore[import-not-found, unused-ignore]
except ImportError:
    carla = None

MAPS = ("carla-2020/Town06", "carla-2020/Town04", "esmini/e6mini", "esmini/curve_r100")


def forever() -> Iterator[None]:
    while True:
        yield None


def best(action: Callable[[], object], rounds: int) -> float:
    """Shortest time of one call (s)."""
    times = []
    gc.collect()
    for _ in range(rounds):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return min(times)


def unit() -> float:
    """Time U of one generator step (s)."""
    generator, count = forever(), 200_000

    def run() -> None:
        for _ in range(count):
            next(generator)

    return best(run, 7) / count


def per_item(action: Callable[[Any], object], items: list[Any]) -> float:
    """Time of one call, averaged over items, best of five rounds (s)."""

    def run() -> None:
        for item in items:
            action(item)

    run()  # fills caches
    return best(run, 5) / len(items)


def report(name: str, seconds: float, u: float, theirs: float | None = None) -> None:
    ratio = "" if theirs is None else f"  {seconds / theirs:6.2f} x carla ({theirs * 1e6:.2f} us)"
    print(f"  {name:34s} {seconds * 1e6:10.2f} us {seconds / u:10.0f} U{ratio}")


def load(path: Path, u: float) -> RoadMap:
    text = path.read_text(encoding="utf-8")
    theirs = None if carla is None else best(lambda: carla.Map(path.stem, text), 3)
    report("load", best(lambda: read_map(path), 5), u, theirs)
    road_map = read_map(path)
    report("load, index and one query", best(lambda: read_map(path).locate(0.0, 0.0), 3), u, theirs)
    return road_map


def queries(road_map: RoadMap, path: Path, u: float) -> None:
    points = list(road_map.spawn_points())[:1500]
    poses = [road_map.pose(p) for p in points]
    other = None if carla is None else carla.Map(path.stem, path.read_text(encoding="utf-8"))
    pose = locate = None
    if other is not None:
        pose = per_item(lambda p: other.get_waypoint_xodr(int(p.road), p.lane, p.s), points)
        places = [carla.Location(p.x, -p.y, p.z) for p in poses]
        locate = per_item(other.get_waypoint, places)
    report("pose", per_item(road_map.pose, points), u, pose)
    report("locate, cold", per_item(lambda p: road_map.locate(p.x, p.y), poses), u, locate)
    hinted = [
        (p.x, p.y, road_map.advance(q, -1.0).position) for p, q in zip(poses, points, strict=True)
    ]
    report(
        "locate, tracked from 1 m behind",
        per_item(lambda item: road_map.locate(item[0], item[1], hint=item[2]), hinted),
        u,
    )
    report("advance 1 m", per_item(lambda p: road_map.advance(p, 1.0), points), u)
    shifted = [LanePosition(p.road, p.lane, p.s, 0.7) for p in points]
    report("advance 1 m, at an offset", per_item(lambda p: road_map.advance(p, 1.0), shifted), u)
    pairs = [(p, road_map.advance(p, 60.0).position) for p in points]
    report("route_distance 60 m, warm", per_item(lambda q: road_map.route_distance(*q), pairs), u)


def search(path: Path, u: float) -> None:
    """Distance fields from fresh goals, the part that a cache cannot help."""
    road_map = read_map(path)
    points = road_map.spawn_points()
    goals = [points[i] for i in range(0, len(points), max(1, len(points) // 40))]
    for goal in points:  # arc length tables are made once per map
        road_map.lane_length(road_map.lane_key(goal))
    road_map.route_to(points[0])
    start = time.perf_counter()
    for goal in goals:
        road_map.route_to(goal)
    report("route_to, new goal", (time.perf_counter() - start) / len(goals), u)


def main(arguments: list[str]) -> int:
    data = os.environ.get("OSC2TX_TEST_DATA")
    if not arguments and data is None:
        print("name a map, or a folder with `maps` in OSC2TX_TEST_DATA", file=sys.stderr)
        return 2
    u = unit()
    print(f"U = {u * 1e6:.4f} us; carla {'present' if carla is not None else 'absent'}")
    for name in arguments or [f"{data}/maps/{name}.xodr" for name in MAPS]:
        path = Path(name)
        print(f"{path.stem} ({path.stat().st_size / 1e6:.2f} MB)")
        queries(load(path, u), path, u)
        search(path, u)
    return 0 if math.isfinite(u) else 1


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
