"""Random inputs that are no scenarios: maps, traces, settings files, records of builds.

Each starts from something sound and changes a few of its values or parts. What reads it gives a
result or the error that is meant for it.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

from lxml import etree

from osc2tx.building.ownership import stated_source
from osc2tx.building.written_digests import DIGESTS_NAME, read_digests
from osc2tx.campaigns import CampaignError
from osc2tx.config import ConfigError, ConfigFiles, GivenOptions
from osc2tx_runtime import ScenarioError
from osc2tx_runtime.language.source_map import parse_source_map
from osc2tx_runtime.opendrive import MapError, RoadMap, read_map_text, signal_places
from osc2tx_runtime.report.page import render_report
from osc2tx_runtime.running.options import OPTIONS, read_options
from osc2tx_shared.text import visible
from tests.fuzz.mutations import SPICE
from tests.fuzz.stores import read_store, write_damage

MAPS = Path(__file__).parents[2] / "runtime_lib/osc2tx_runtime/maps"
NUMBERS = (
    *("0", "-0", "-1", "1", "1e-9", "-1e-300", "0.5", "3", "99.999", "1e6", "1e9", "1e308"),
    *("1_0", "\uff11", "nan", "inf", "-inf", "1e999", "0x1", "", " ", "\n1", "1,5", "9" * 400),
)
WORDS = (
    *("1", "-1", "0", "driving", "none", "start", "end", "road", "junction", "true", "LHT", "x"),
    *("direct", "virtual", "sidewalk", "\u202e", "a" * 3000, "%s", "\ud7ff", "\x85", "</x>", "&"),
)
VALUES: tuple[Any, ...] = (
    *(None, True, False, 0, -1, 1.5, 1e308, float("nan"), float("inf"), 10**400, 2**63),
    *("", "a", "header", "state", "start", "success", "\ud800", "\x1b[2J", "</script>", "x" * 999),
    *([], {}, [1], [None], {"a": {}}, [[]], {"id": {}}, [[[0]]], "nan", "ego", 3, 4),
)


@dataclass(frozen=True, slots=True)
class Input:
    """Something to read.

    Attributes:
        name: What it is, and the name of its file.
        write: Makes one.
        read: Reads it, and may raise what it is allowed to.
        allowed: The error that says what is wrong.
    """

    name: str
    write: Callable[[Random], str]
    read: Callable[[str, Path], object]
    allowed: tuple[type[Exception], ...] = ()


# --- maps ---


@cache
def sound_maps() -> tuple[str, ...]:
    """Return own maps that are small, and one with a shape of each kind."""
    texts = [path.read_text(encoding="utf-8") for path in sorted(MAPS.glob("*.xodr"))]
    return (*(text for text in texts if len(text) < 5000), SHAPES)


SHAPES = """<OpenDRIVE><header><geoReference>+proj=tmerc +lat_0=49</geoReference></header>
<road id="1" length="50" junction="-1"><link><successor elementType="junction" elementId="9"/>
</link><type s="0" type="town"><speed max="50" unit="km/h"/></type><planView>
<geometry s="0" x="0" y="0" hdg="0" length="10"><spiral curvStart="0" curvEnd="0.1"/></geometry>
<geometry s="10" x="9.8" y="1.6" hdg="0.5" length="10"><arc curvature="-0.1"/></geometry>
<geometry s="20" x="19" y="3" hdg="-0.5" length="10"><poly3 a="0" b="0" c="0.1" d="0"/></geometry>
<geometry s="30" x="28" y="0" hdg="0.1" length="20"><paramPoly3 aU="0" bU="20" cU="0" dU="0"
aV="0" bV="0" cV="1" dV="1" pRange="normalized"/></geometry></planView>
<elevationProfile><elevation s="0" a="0" b="0.1" c="0" d="0"/></elevationProfile>
<lateralProfile><superelevation s="5" a="0.1" b="0" c="0" d="0"/></lateralProfile>
<lanes><laneOffset s="0" a="0.5" b="0" c="0" d="0"/><laneSection s="0"><center><lane id="0"/>
</center><right><lane id="-1" type="driving"><link><successor id="-1"/></link>
<width sOffset="0" a="3" b="0" c="0" d="0"/><speed sOffset="0" max="30"/></lane></right>
</laneSection><laneSection s="25"><right><lane id="-1" type="driving" level="true">
<border sOffset="0" a="-3" b="0.01" c="0" d="0"/></lane></right></laneSection></lanes>
<objects><object id="1" type="crosswalk" s="9" t="0"><outlines><outline>
<cornerRoad s="9" t="-3"/><cornerRoad s="12" t="3"/><cornerLocal u="1" v="1"/></outline></outlines>
</object></objects><signals><signal id="5" s="40" t="-4" dynamic="yes" orientation="+"
type="1000001"><validity fromLane="-1" toLane="-1"/></signal></signals></road>
<road id="2" length="9" junction="9"><link><predecessor elementType="road" elementId="1"
contactPoint="end"/></link><planView><geometry s="0" x="48" y="2" hdg="0.2" length="9"><line/>
</geometry></planView><lanes><laneSection s="0"><right><lane id="-1" type="driving"><width
sOffset="0" a="3" b="0" c="0" d="0"/></lane></right></laneSection></lanes></road>
<controller id="7"><control signalId="5"/></controller>
<junction id="9"><connection id="0" incomingRoad="1" connectingRoad="2" contactPoint="start">
<laneLink from="-1" to="-1"/></connection></junction></OpenDRIVE>"""


def write_map(random: Random) -> str:
    """Return a map with a few values and elements changed."""
    root = etree.fromstring(random.choice(sound_maps()).encode())
    elements = [each for each in root.iter() if isinstance(each.tag, str)]
    for _ in range(random.randint(1, 4)):
        element = random.choice(elements)
        names = sorted(element.attrib)
        parent = element.getparent()
        kind = random.random()
        if names and kind < 0.7:
            name = random.choice(names)
            numbers = NUMBERS if random.random() < 0.7 else WORDS
            value = random.choice(numbers)
            element.set(name, "".join(c for c in value if c.isprintable() or c in "\n\x85\u202e"))
        elif names and kind < 0.8:
            del element.attrib[random.choice(names)]
        elif parent is not None and kind < 0.9:
            parent.remove(element)
        elif parent is not None:
            parent.append(etree.fromstring(etree.tostring(random.choice(elements))))
    text = etree.tostring(root, encoding="unicode")
    return _spiced(random, text) if random.random() < 0.1 else text


def read_map(text: str, folder: Path) -> None:
    """Read a map and ask it everything that a run does."""
    road_map = read_map_text(text.encode("utf-8", "surrogateescape"), "fuzzed.xodr")
    signal_places(road_map.roads, road_map.signals())
    road_map.seams()
    road_map.bounds()
    list(road_map.lane_outlines(step=50.0))
    for place in road_map.spawn_points()[:3]:
        pose = road_map.pose(place)
        road_map.locate(pose.x, pose.y)
        road_map.advance(place, 7.0)
        _ask(road_map, place)


def _ask(road_map: RoadMap, place: Any) -> None:
    road_map.neighbour(place, "left")
    road_map.route_distance(place, road_map.spawn_points()[-1])
    key = road_map.lane_key(place)
    road_map.lane_length(key)
    for after in road_map.successors(key):
        road_map.predecessors(after)


# --- JSON: traces, source maps, reports, digests ---

TRACE: tuple[dict[str, Any], ...] = (
    {"kind": "header", "version": 1, "scenario": "a", "source": "a.osc", "map": "m", "dt": 0.05}
    | {"seed": 0, "parameters": {"v": 1.5}, "actors": {"ego": {"kind": "vehicle", "length": 4.5}}},
    {"kind": "tree", "nodes": [{"id": 0, "name": "a", "kind": "Serial", "parent": None}]},
    {"t": 0.0, "kind": "state", "actor": "ego", "x": 1.0, "y": 2.0, "h": 0.1, "v": 3.0, "z": 0.0},
    {"t": 0.5, "kind": "state", "actor": "ego", "x": 2.0, "y": 2.0, "h": 0.1, "v": 3.0, "a": 0.0},
    {"t": 0.1, "kind": "action", "status": "start", "name": "drive", "actor": "ego", "node": 0},
    {"t": 0.4, "kind": "action", "status": "end", "name": "drive", "actor": "ego", "node": 0},
    {"t": 0.2, "kind": "event", "name": "go", "arguments": {"x": 1}, "source": "a.osc:4"},
    {"t": 0.2, "kind": "collision", "actors": ["ego", "npc"]},
    {"t": 0.3, "kind": "criterion", "name": "near", "status": "failure", "source": "a.osc:9"},
    {"t": 0.3, "kind": "environment", "rain": 0.1, "sun": {"azimuth": 1.0}},
    {"t": 0.3, "kind": "signal", "id": "5", "state": "red"},
    {"kind": "result", "status": "success", "reason": "", "steps": 10, "time": 0.5},
)
SOURCE_MAP = {"fields": {"a": 1}, "constraints": [1, 2], "placements": [3], "nodes": [1, 2, 3]}
REPORT = {"format": 4, "source": "a.osc", "losses": []}
DIGESTS = {"format": 2, "digests": {"a.py": ["a.osc", "0"], "sub/b.py": ["sub/b.osc", "1", "2"]}}


def _changed(random: Random, document: Any) -> Any:
    """Return a document with one part of it changed."""
    if isinstance(document, dict) and document and random.random() < 0.85:
        key = random.choice(list(document))
        kind = random.random()
        if kind < 0.15:
            return {name: value for name, value in document.items() if name != key}
        if kind < 0.25:
            return {**document, random.choice(("", "\ud800", "id", "../x", "t")): document[key]}
        return {**document, key: _changed(random, document[key])}
    if isinstance(document, list) and document and random.random() < 0.8:
        at = random.randrange(len(document))
        return [*document[:at], _changed(random, document[at]), *document[at + 1 :]]
    return random.choice(VALUES)


def _json(document: Any) -> Callable[[Random], str]:
    def write(random: Random) -> str:
        text = json.dumps(_changed(random, document))
        return _spiced(random, text) if random.random() < 0.3 else text

    return write


def write_trace(random: Random) -> str:
    """Return a trace with a few lines changed, repeated or lost."""
    lines: list[Any] = list(TRACE)
    for _ in range(random.randint(1, 5)):
        at = random.randrange(len(lines))
        lines[at] = _changed(random, lines[at])
        if random.random() < 0.2:
            lines.insert(random.randrange(len(lines)), random.choice(TRACE))
    text = "\n".join(map(json.dumps, lines))
    return _spiced(random, text) if random.random() < 0.2 else text


def read_trace(text: str, folder: Path) -> None:
    """Make the page of a trace."""
    render_report(text.split("\n")).encode()


def read_source_map(text: str, folder: Path) -> None:
    """Read a source map, of whatever form."""
    try:
        entry = json.loads(text)
    except ValueError:
        return
    found = parse_source_map(entry if isinstance(entry, dict) else {}, "a.osc")
    for number in range(4):
        found.of_constraint(number)
        found.of_placement(number)
    found.of_field("a")


def read_the_source(text: str, folder: Path) -> None:
    """Read which source an output states."""
    for name in ("a.xosc.report.json", "a.py", "a.xosc"):
        stated_source(name, text.encode("utf-8", "surrogatepass"))


def read_some_digests(text: str, folder: Path) -> None:
    """Read the digests of a folder."""
    _write(folder / DIGESTS_NAME, text)
    read_digests(folder)


# --- settings files and options of a run ---

SETTINGS = """std = "2.1"
dialect = "asam"
xml_version = "1.3"
allow_approx = true
sources = ["in", "b"]
out = "out"
[scenarios.a]
one_of = "race"
[scenarios.a.run]
seed = 3
set = ["v=1", "w=2"]
dt = 0.1
signal = ["go@1s"]
world = "embedded"
"""
TOML = (
    *("0x" + "f" * 5000, "9" * 5000, "-1", "1e400", "nan", "true", "{}", "[]", "[[1]]", "{a={}}"),
    *('""', "''", '"\\ud800"', '"\\u202e"', '"\\u0000"', "1979-05-27", "07:32:00", "[1, 'a']"),
    *('"' + "x" * 3000 + '"', '"a"', "[" * 300, '["a"]', '"carla"', "{run={seed=[]}}"),
)
KEYS = ("std", "run", "scenarios", "a", "x", '""', '"\\u001b"', "sources", "set", "'a.b'", "world")


def write_settings(random: Random) -> str:
    """Return a settings file with a few values, keys and lines changed."""
    lines = SETTINGS.splitlines()
    for _ in range(random.randint(1, 3)):
        at = random.randrange(len(lines))
        key, equals, _value = lines[at].partition(" = ")
        kind = random.random()
        if kind < 0.6 and equals:
            lines[at] = f"{key} = {random.choice(TOML)}"
        elif kind < 0.8:
            lines.insert(at, f"{random.choice(KEYS)} = {random.choice(TOML)}")
        elif kind < 0.9:
            lines.insert(at, f"[{random.choice(KEYS)}.{random.choice(KEYS)}]")
        else:
            del lines[at]
            lines = lines or [""]
    text = "\n".join(lines)
    return _spiced(random, text) if random.random() < 0.2 else text


def read_settings(text: str, folder: Path) -> None:
    """Read a settings file and ask what counts."""
    _write(folder / "osc2tx.toml", text)
    config = ConfigFiles().for_source(folder / "a.osc")
    config.options_for(folder / "a.osc", GivenOptions())
    for each in config.settings_in_force(folder / "a.osc", GivenOptions()):
        visible(f"{each.name} {each.value} {each.origin.place}")


NAMES = tuple(option.name for option in OPTIONS)
PARTS = ("v", "ego", "=", "@", ",", "1", "-1", "1s", "nan", "go", "..", ":", "#", "1e999", " ")


def write_options(random: Random) -> str:
    """Return options of a run, a line each."""

    def value() -> str:
        parts = random.choices((*PARTS, *NUMBERS, *WORDS), k=random.randint(0, 6))
        return "".join(parts).replace("\n", "")

    return "\n".join(f"{random.choice(NAMES)} {value()}" for _ in range(random.randint(1, 3)))


def read_some_options(text: str, folder: Path) -> None:
    """Read options of a run."""
    given: dict[str, list[str]] = {}
    for line in text.split("\n"):
        name, _, value = line.partition(" ")
        given.setdefault(name, []).append(value)
    read_options(given)


def _write(path: Path, text: str) -> None:
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(text.encode("utf-8", "surrogateescape"))


def _spiced(random: Random, text: str) -> str:
    at = random.randint(0, len(text))
    return text[:at] + random.choice(SPICE) + text[at + random.randint(0, 3) :]


INPUTS = {
    each.name: each
    for each in (
        Input("maps", write_map, read_map, (MapError,)),
        Input("traces", write_trace, read_trace),
        Input("source_maps", _json(SOURCE_MAP), read_source_map),
        Input("reports", _json(REPORT), read_the_source),
        Input("digests", _json(DIGESTS), read_some_digests),
        Input("settings", write_settings, read_settings, (ConfigError,)),
        Input("options", write_options, read_some_options, (ScenarioError,)),
        Input("stores", write_damage, read_store, (CampaignError, ScenarioError)),
    )
}
