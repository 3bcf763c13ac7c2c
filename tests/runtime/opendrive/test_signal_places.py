"""Where signals hold: at their own place and at references, for lanes of their direction."""

from __future__ import annotations

from pathlib import Path

import osc2tx_runtime
from osc2tx_runtime.opendrive import RoadMap, SignalPlace, read_map_text, signal_places

MAP = Path(osc2tx_runtime.__file__).parent / "maps" / "urban_crossing.xodr"


def places(road_map: RoadMap) -> dict[tuple[str, int], list[SignalPlace]]:
    lights = [signal for signal in road_map.signals() if signal.dynamic]
    return {key: list(found) for key, found in signal_places(road_map.roads, lights).items()}


def with_light(orientation: str, *validity: tuple[int, int], reference: str = "") -> RoadMap:
    """The crossing with a changed light 101, and a reference to it on road 11."""
    lines: list[str] = []
    for line in MAP.read_text(encoding="utf-8").splitlines():
        if 'id="101" name' in line:
            line = line.replace('orientation="+"', f'orientation="{orientation}"')
            inside = "".join(f'<validity fromLane="{a}" toLane="{b}"/>' for a, b in validity)
            line = line.replace("/>", f">{inside}</signal>")
        if '<road name="left from 1"' in line and reference:
            # The element before ends road 11.
            lines[-1] = f"<signals>{reference}</signals></road>"
        lines.append(line)
    return read_map_text("\n".join(lines), "case")


def lanes_of_101(road_map: RoadMap) -> set[tuple[str, int]]:
    return {key for key, found in places(road_map).items() if found[0].signal == "101"}


def test_lights_of_the_crossing() -> None:
    """Lanes -1 and -2 of each arm run with s towards the crossing; sidewalks do not count."""
    found = places(read_map_text(MAP.read_bytes(), "case"))
    expected = {(str(arm), lane): f"{100 + arm}" for arm in range(1, 5) for lane in (-1, -2)}
    assert {key: [SignalPlace(each, 149.0)] for key, each in expected.items()} == found


def test_orientation_and_validity() -> None:
    assert lanes_of_101(with_light("-")) == {("1", 1), ("1", 2)}
    assert lanes_of_101(with_light("none")) == {("1", lane) for lane in (-2, -1, 1, 2)}
    assert lanes_of_101(with_light("+", (-1, -1))) == {("1", -1)}
    assert lanes_of_101(with_light("+", (2, -1))) == {("1", -1)}
    assert lanes_of_101(with_light("+", (1, 2))) == {("1", 1), ("1", 2)}  # as maps of CARLA do
    assert lanes_of_101(with_light("+", (0, 0))) == set()


def test_references_count_as_well() -> None:
    reference = (
        '<signalReference id="101" s="0" t="0" orientation="+">'
        '<validity fromLane="-1" toLane="-1"/></signalReference>'
    )
    found = places(with_light("+", (0, 0), reference=reference))
    assert found["11", -1] == [SignalPlace("101", 0.0)]
    assert ("1", -1) not in found
