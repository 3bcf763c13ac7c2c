"""Snapshots of maps: the same as reading, and never trusted further than they deserve."""

import marshal
import os
from collections.abc import Callable, Iterator
from itertools import islice
from pathlib import Path
from random import Random
from typing import Any

import pytest

from osc2tx_runtime.opendrive import MapError, RoadMap, map_snapshots, read_map, read_map_text
from osc2tx_runtime.opendrive.map_snapshots import MOST_KEPT, SMALLEST
from osc2tx_runtime.opendrive.packed_map import PackingError, pack, unpack
from osc2tx_runtime.opendrive.reader import MapContent, read_content_text
from osc2tx_shared.cache import snapshots
from tests.runtime.opendrive.conftest import OWN_MAPS
from tests.runtime.opendrive.small_maps import map_text, road_text, shape

THIRD_PARTY = [
    *("carla-2019/Town03", "carla-2020/Town10HD", "esmini/multi_intersections"),
    *("esmini/fabriksgatan_traffic_lights", "esmini/crest-curve", "esmini/soderleden"),
]
CROSS_SECTION = (
    '<lateralProfile><shape s="0" t="-9" a="0.1" b="0.01" c="0" d="0"/></lateralProfile>',
    '<lateralProfile><crossSectionSurface><surfaceStrips><strip id="1"><width>'
    '<coefficients s="0" a="3" b="0" c="0" d="0"/></width><linear>'
    '<coefficients s="0" a="0.02" b="0" c="0" d="0"/></linear></strip></surfaceStrips>'
    "</crossSectionSurface></lateralProfile>",
)
SHAPES = (
    "line",
    'arc curvature="0.01"',
    'spiral curvStart="0" curvEnd="0.02"',
    'poly3 a="0" b="0" c="0.01" d="0"',
    'paramPoly3 aU="0" bU="1" cU="0" dU="0" aV="0" bV="0" cV="0.01" dV="0" pRange="arcLength"',
)
SMALL = [
    map_text(*(road_text(shape(s, 40.0), 40.0, identity=str(i)) for i, s in enumerate(SHAPES)))
]
SMALL += [map_text(road_text(shape("line", 40.0), 40.0, extra=extra)) for extra in CROSS_SECTION]


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A cache of the test's own; its folder of maps."""
    monkeypatch.delenv("OSC2TX_NO_CACHE", raising=False)
    monkeypatch.setattr(snapshots, "_STARTED", 1 << 62)  # others may be editing the code
    for name in ("XDG_CACHE_HOME", "HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path))
    path = map_snapshots.SNAPSHOTS.path("maps/name")
    assert path is not None and path.is_relative_to(tmp_path)
    return path.parent


@pytest.fixture
def town(tmp_path: Path) -> Path:
    """A map that is large enough for a snapshot."""
    path = tmp_path / "town.xodr"
    roads = [road_text(shape(SHAPES[1], 40.0), 40.0, identity=str(i)) for i in range(20)]
    path.write_text(map_text(*roads) + " " * SMALLEST, encoding="utf-8")
    return path


@pytest.fixture
def parses(monkeypatch: pytest.MonkeyPatch) -> Iterator[list[Path]]:
    """The files that are parsed."""
    found: list[Path] = []
    parse = map_snapshots.read_content

    def noted(path: Path) -> MapContent:
        found.append(path)
        return parse(path)

    monkeypatch.setattr(map_snapshots, "read_content", noted)
    yield found


def the_file(cache: Path) -> Path:
    (path,) = cache.iterdir()
    return path


def again(content: MapContent) -> MapContent:
    return unpack(marshal.loads(marshal.dumps(pack(content))))  # type: ignore[arg-type]


def answers(road_map: RoadMap) -> list[Any]:
    """What a map says about itself and about some places."""
    places = road_map.spawn_points()[:: max(1, len(road_map.spawn_points()) // 50)]
    poses = [road_map.pose(place) for place in places]
    return [
        (road_map.name, road_map.header, road_map.remarks, road_map.geo_reference),
        (road_map.signals(), road_map.controllers(), road_map.crosswalks(), road_map.seams()),
        (list(road_map.roads), list(road_map.junctions.items()), road_map.bounds()),
        (poses, [road_map.locate(pose.x, pose.y, pose.z) for pose in poses]),
        [road_map.advance(place, 150.0) for place in places],
        list(islice(road_map.lane_outlines(), 200)),
    ]


@pytest.mark.slow
def test_a_map_of_third_parties_survives_packing(maps_folder: Path) -> None:
    for name in THIRD_PARTY:
        text = (maps_folder / f"{name}.xodr").read_bytes()
        content = again(read_content_text(text, name))
        assert answers(RoadMap(content)) == answers(read_map_text(text, name)), name


TEXTS = [path.read_bytes() for path in sorted(OWN_MAPS.glob("*.xodr"))] + SMALL


@pytest.mark.parametrize("text", TEXTS, ids=range(len(TEXTS)))
def test_a_map_survives_packing(text: str | bytes) -> None:
    content = again(read_content_text(text, "map"))
    assert pack(content) == pack(read_content_text(text, "map"))
    assert answers(RoadMap(content)) == answers(read_map_text(text, "map"))


def test_a_large_map_is_parsed_once(town: Path, parses: list[Path], cache: Path) -> None:
    first, second = read_map(town), read_map(town)
    assert parses == [town]
    assert answers(second) == answers(first)
    assert the_file(cache).stat().st_size < town.stat().st_size


def test_elsewhere_it_has_another_name(town: Path, parses: list[Path], tmp_path: Path) -> None:
    read_map(town)
    other = town.rename(tmp_path / "city.xodr")
    city = read_map(other)
    assert parses == [town] and city.name == "city"
    with pytest.raises(MapError, match=r"city\.xodr"):
        city.lane_width("nowhere", 1, 0.0)


def test_a_small_map_is_not_kept(tmp_path: Path, cache: Path) -> None:
    path = tmp_path / "small.xodr"
    path.write_text(SMALL[0], encoding="utf-8")
    read_map(path)
    assert not cache.exists()


def test_another_text_is_parsed(town: Path, parses: list[Path]) -> None:
    read_map(town)
    town.write_text(town.read_text().replace('id="7"', 'id="7000"'))
    assert "7000" in read_map(town).roads
    assert parses == [town, town]


def test_a_map_that_changes_while_it_is_read_is_not_kept(
    town: Path, monkeypatch: pytest.MonkeyPatch, cache: Path
) -> None:
    parse = map_snapshots.read_content

    def read_before_a_change(path: Path) -> MapContent:
        content = parse(path)
        path.write_text(path.read_text() + "\n")
        return content

    monkeypatch.setattr(map_snapshots, "read_content", read_before_a_change)
    read_map(town)
    assert not cache.exists()


def test_what_is_no_map_is_refused_each_time(tmp_path: Path, cache: Path) -> None:
    path = tmp_path / "broken.xodr"
    path.write_text(" " * SMALLEST)
    for _ in range(2):
        with pytest.raises(MapError, match="well-formed"):
            read_map(path)
    assert not cache.exists()


def test_a_damaged_snapshot_is_replaced(town: Path, parses: list[Path], cache: Path) -> None:
    expected = answers(read_map(town))
    path = the_file(cache)
    whole = path.read_bytes()
    random = Random(3)
    damaged = [whole[:100], b"nonsense", *(_flipped(whole, random) for _ in range(20))]
    for data in damaged:
        path.write_bytes(data)
        assert answers(read_map(town)) == expected
        assert path.read_bytes() == whole
    assert len(parses) == 1 + len(damaged)


def _flipped(data: bytes, random: Random) -> bytes:
    bit = random.randrange(len(data) * 8)
    changed = bytearray(data)
    changed[bit // 8] ^= 1 << bit % 8
    return bytes(changed)


@pytest.mark.parametrize(
    "data",
    [3, [], [("MapContent", 1, [])], [("os", 1, [])], [("Lane", 1, [("plain", [1])] * 3)]],
    ids=str,
)
def test_other_data_are_ignored(town: Path, parses: list[Path], data: object, cache: Path) -> None:
    read_map(town)
    digest = map_snapshots._digest(town)
    assert digest is not None
    map_snapshots.SNAPSHOTS.save(f"maps/{digest[:32]}", digest, data)
    assert "7" in read_map(town).roads and len(parses) == 2
    with pytest.raises(PackingError):
        unpack(data)  # type: ignore[arg-type]


@pytest.mark.skipif(os.name == "nt", reason="permissions of POSIX")
def test_what_others_may_write_to_is_not_read(town: Path, parses: list[Path], cache: Path) -> None:
    read_map(town)
    assert the_file(cache).stat().st_mode & 0o777 == 0o600
    the_file(cache).chmod(0o666)
    read_map(town)
    cache.chmod(0o777)
    read_map(town)
    assert len(parses) == 3


def test_without_a_cache(town: Path, monkeypatch: pytest.MonkeyPatch, cache: Path) -> None:
    monkeypatch.setenv("OSC2TX_NO_CACHE", "1")
    assert "7" in read_map(town).roads
    assert not cache.exists()


def test_the_oldest_are_forgotten(town: Path, cache: Path) -> None:
    cache.mkdir(parents=True, mode=0o700)
    for number in range(MOST_KEPT + 5):
        old = cache / f"{number}.snapshot"
        old.touch()
        os.utime(old, (number, number))
    read_map(town)
    left = {path.name for path in cache.iterdir()}
    assert len(left) == MOST_KEPT and "5.snapshot" not in left and "6.snapshot" in left


def test_what_is_in_no_map_is_not_packed(own: Callable[[str], RoadMap]) -> None:
    with pytest.raises(PackingError, match="`RoadMap` is not a part of a map"):
        pack(own("highway"))  # type: ignore[arg-type]
