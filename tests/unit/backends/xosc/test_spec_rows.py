"""The tables of the mapping to OpenSCENARIO XML, row by row.

`rows/*.toml` has one entry for each row: the smallest scenario with its construct, the lowest
version that says it exactly, and what must then stand in the document. For older versions, and for
rows that no version has, it says how the construct is graded, and a part of the reason.

Entries of a row:

    do              members of the scenario, after a first phase in which the actors start
    declare         declarations and modifiers of the scenario
    before          text in front of the scenario
    setup           one of `SETUPS`
    since           lowest version that is exact; `never` for rows without counterpart
    grade           where it is not exact; `inexpressible` by default
    why             part of a reason where it is not exact
    has, has_not    XPaths that find something, or nothing, from `since` on; of the document or,
                    where they begin with `values:`, of that of the values of its parameters
    esmini          grade for that tool in 1.3, where it is not the one of others
    scenario_runner the same in 1.0
    esmini_has      XPaths that find something in the document for that tool
    scenario_runner_has  likewise
    options         of the compiler, as `name=value`
"""

import os
import subprocess
import sys
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from hashlib import sha256
from pathlib import Path

import pytest
from lxml import etree

from osc2tx.backends.xosc import XmlScenario
from osc2tx.compilation.driver import Compilation
from osc2tx.options import (
    ONE_OF_POLICIES,
    XML_VERSIONS,
    CompileOptions,
    Standard,
    XmlOptions,
    XmlProfile,
    XmlVersion,
)
from tests.unit.backends.xosc.checks import (
    checker_issues,
    schema_errors,
    story_problems,
    untraced,
)
from tests.unit.backends.xosc.documents import documents

FOLDER = Path(__file__).parent / "rows"
NEVER = "never"
VALUES = "values:"
GRADES = ("exact", "approximated", "inexpressible")

HEAD = """\
import osc.standard.all

namespace null use std, stdtypes
{before}
scenario row:
"""

ROAD = """\
    road: map with:
        keep(it.map_file == "{map}.xodr")
"""

CARS = """\
    ego, other: vehicle
{declare}
    do serial:
        start: parallel:
            ego.change_speed(target: 20mps, rate_profile: constant) with:
                lane(2, at: start)
                position(100m, at: start)
                speed(18mps, at: start)
            other.change_speed(target: 20mps, rate_profile: constant) with:
                lane(same_as: ego, at: start)
                position(40m, ahead_of: ego, at: start)
                speed(18mps, at: start)
{do}
"""

WALKER = """\
    walker: person
    post: stationary_object
    post_pose: pose_3d with:
        keep(it.position.x == 100m)
        keep(it.position.y == -15m)
        keep(it.position.z == 0m)
        keep(it.orientation.yaw == 0deg)
    post.location(pose: post_pose)
    curb: position_3d with:
        keep(it.x == 100m)
        keep(it.y == -20m)
        keep(it.z == 0m)
{declare}
    do serial:
        walker.walk() with:
            position(at_point: curb, project_on_route: false, at: start)
            yaw(90deg, at: start)
            speed(1.5mps)
            until walker.object_distance(reference: post, direction: euclidean) < 2m
{do}
"""

TOWN = """\
    lights: traffic_light_controller
    ego: vehicle
    east: traffic_light with:
        keep(it.map_id == "101")
    main_road: traffic_light_group with:
        keep(it.map_id == "1")
"""

DRIVE = """\
{declare}
    do serial:
        ego.change_speed(target: 10mps, rate_profile: constant) with:
            lane(1, at: start)
            position(20m, at: start)
            speed(8mps, at: start)
{do}
"""

PLAIN = "{declare}\n    do serial:\n{do}\n"

SETUPS = {
    "cars": ROAD.format(map="highway") + CARS,
    "cars on the left": ROAD.format(map="left_hand") + CARS,
    "walker": ROAD.format(map="highway") + WALKER,
    "lights": ROAD.format(map="urban_crossing") + TOWN + DRIVE,
    "town": ROAD.format(map="urban_crossing") + TOWN + PLAIN,
    "road": ROAD.format(map="highway") + PLAIN,
    "nothing": PLAIN,
}


@dataclass(frozen=True, kw_only=True)
class Row:
    """A row of a table."""

    section: str
    name: str
    do: str
    declare: str = ""
    before: str = ""
    setup: str = "cars"
    since: str = "1.0"
    grade: str = "inexpressible"
    why: str = ""
    has: list[str] = field(default_factory=list)
    has_not: list[str] = field(default_factory=list)
    esmini: str | None = None
    scenario_runner: str | None = None
    esmini_has: list[str] = field(default_factory=list)
    scenario_runner_has: list[str] = field(default_factory=list)
    options: Mapping[str, str] = field(default_factory=dict)

    @property
    def text(self) -> str:
        """The scenario."""
        head = HEAD.format(before=self.before)
        body = SETUPS[self.setup]
        declare, do = _indented(self.declare, 4), _indented(self.do, 8)
        return head + body.replace("{declare}", declare).replace("{do}", do)

    def is_exact(self, version: str) -> bool:
        """Whether a version says it."""
        return self.since != NEVER and version >= self.since


def _indented(text: str, depth: int) -> str:
    lines = text.strip("\n").splitlines()
    return "\n".join(" " * depth + line if line else "" for line in lines)


def _rows() -> Iterator[Row]:
    for path in sorted(FOLDER.glob("*.toml")):
        data = tomllib.loads(path.read_text(encoding="utf-8"))
        for name, entry in data.items():
            yield Row(section=path.stem, name=name, **entry)


ROWS = {f"{row.section}: {row.name}": row for row in _rows()}


def written(
    id_: str, version: XmlVersion, profile: XmlProfile = "generic", *, allow_approx: bool = False
) -> XmlScenario:
    """Return the document of a row."""
    options = ROWS[id_].options
    signals = (options["signal"],) if "signal" in options else ()
    return documents(
        compiled(id_),
        XmlOptions(version=version, profile=profile, allow_approx=allow_approx, signals=signals),
    )[-1]


@cache
def compiled(id_: str) -> Compilation:
    """Return the compilation of a row."""
    row = ROWS[id_]
    standard: Standard = "2.2" if row.options.get("standard") == "2.2" else "2.1"
    one_of = next((each for each in ONE_OF_POLICIES if each == row.options.get("one_of")), "race")
    options = CompileOptions(standard=standard, one_of=one_of)
    return Compilation(Path("row.osc"), "row.osc", options, text=row.text)


def grade_of(scenario: XmlScenario) -> str:
    """Return the worst grade of all constructs."""
    found = (entry.grade.value for entry in scenario.report.entries)
    return max(found, key=GRADES.index, default="exact")


def told(scenario: XmlScenario) -> str:
    """Return what is in the way of a document."""
    return "; ".join(entry.message for entry in scenario.report.obstacles)


def document(text: str | None) -> etree._Element:
    """Return a document as elements."""
    assert text is not None
    return etree.fromstring(text.encode())


def edges(row: Row) -> set[XmlVersion]:
    """Return the versions at which something may change: the ends, and where it becomes exact."""
    exact = sum(row.is_exact(version) for version in XML_VERSIONS)
    first = len(XML_VERSIONS) - exact
    return {XML_VERSIONS[0], XML_VERSIONS[-1], *XML_VERSIONS[max(first - 1, 0) : first + 1]}


VERSIONS = [
    *(pytest.param(id_, sorted(edges(row)), id=id_) for id_, row in ROWS.items()),
    *(
        pytest.param(
            id_,
            between,
            id=f"{id_}, versions between",
            marks=pytest.mark.slow,
        )
        for id_, row in ROWS.items()
        if (between := sorted(set(XML_VERSIONS) - edges(row)))
    ),
]
"""Rows, with versions to look at: those between two that are alike are slow tests."""


@pytest.mark.parametrize(("id_", "versions"), VERSIONS)
def test_the_row_is_exact_from_its_version_on(id_: str, versions: list[XmlVersion]) -> None:
    row = ROWS[id_]
    for version in versions:
        found = written(id_, version)
        if not row.is_exact(version):
            assert found.xml is None, f"{version} says it too"
            continue
        assert found.xml is not None, f"{version}: {told(found)}"
        for path in row.has:
            inner = path.removeprefix(VALUES)
            text = found.parameters if inner != path else found.xml
            if text is None and version == "1.0":
                continue  # it has no document of values
            assert document(text).xpath(inner), f"{version}: {path}\n{text}"
        for path in row.has_not:
            assert not document(found.xml).xpath(path), f"{version}: {path}\n{found.xml}"


@pytest.mark.parametrize("id_", [id_ for id_, row in ROWS.items() if row.since != "1.0"])
def test_other_versions_say_why_they_cannot(id_: str) -> None:
    row = ROWS[id_]
    assert row.why, "a row that is not exact everywhere has a reason"
    for version in XML_VERSIONS:
        if row.is_exact(version):
            continue
        found = written(id_, version)
        assert grade_of(found) == row.grade, f"{version}: {told(found)}"
        assert row.why in told(found), version
        if row.since != NEVER:
            remedies = {entry.remedy.version for entry in found.report.obstacles}
            assert row.since in remedies, f"{version}: nothing leads to {row.since}: {remedies}"
        elif row.grade == "approximated":
            assert all(entry.bound for entry in found.report.obstacles)


# What ScenarioRunner does with elements that others carry out as they stand.
IN_SCENARIO_RUNNER = {
    "//Event//AssignRouteAction | //Event//AcquirePositionAction": "inexpressible",
    "//ManeuverGroup[Actors/EntityRef/@entityRef=//ScenarioObject[not(Pedestrian)]/@name]"
    "//FollowTrajectoryAction": "inexpressible",
    "//Event//FollowTrajectoryAction": "approximated",
    "//OpenSCENARIO[//Vehicle]//Event//TeleportAction": "inexpressible",
    "//LateralDistanceAction": "inexpressible",
    "//TrafficSignalControllerAction": "inexpressible",
    "//Pedestrian[@pedestrianCategory='animal']": "approximated",
    "//LongitudinalDistanceAction": "inexpressible",
    "//AccelerationCondition | //TimeHeadwayCondition": "inexpressible",
    "//DistanceCondition[@alongRoute='true']": "inexpressible",
    "//Vehicle[BoundingBox/Center/@x != 0]": "approximated",
    "//Event//*[@dynamicsShape != 'step']": "approximated",
}


def in_scenario_runner(id_: str, row: Row, anywhere: str) -> str:
    """Return the grade there: that of any tool, or a worse one that follows from the document."""
    if row.scenario_runner is not None:
        return row.scenario_runner
    plain = written(id_, "1.0", "generic", allow_approx=True).xml
    if plain is None:
        return anywhere
    found = [grade for path, grade in IN_SCENARIO_RUNNER.items() if document(plain).xpath(path)]
    return max((anywhere, *found), key=GRADES.index)


@pytest.mark.slow
@pytest.mark.parametrize("id_", ROWS)
def test_what_tools_can_do_of_it(id_: str) -> None:
    row = ROWS[id_]
    one_three, one_zero = (
        "exact" if row.is_exact(version) else row.grade for version in ("1.3", "1.0")
    )
    tools: tuple[tuple[XmlProfile, XmlVersion, str, list[str]], ...] = (
        ("esmini", "1.3", row.esmini or one_three, row.esmini_has),
        (
            "scenario_runner",
            "1.0",
            in_scenario_runner(id_, row, one_zero),
            row.scenario_runner_has,
        ),
    )
    for profile, version, expected, has in tools:
        found = written(id_, version, profile, allow_approx=has != [])
        assert grade_of(found) == expected, f"{profile}: {told(found)}"
        for path in has:
            assert document(found.xml).xpath(path), f"{profile}: {path}\n{found.xml}"


GENERIC: XmlProfile = "generic"
TOOLS: Mapping[XmlVersion, XmlProfile] = {"1.3": "esmini", "1.0": "scenario_runner"}


@pytest.mark.slow
@pytest.mark.parametrize(("id_", "versions"), VERSIONS)
def test_the_documents_are_valid_and_lead_back_to_the_source(
    id_: str, versions: list[XmlVersion]
) -> None:
    tools = [(version, TOOLS[version]) for version in versions if version in TOOLS]
    for version, profile in [*((version, GENERIC) for version in versions), *tools]:
        found = written(id_, version, profile, allow_approx=True)
        assert (found.xml is None) == bool(found.report.obstacles)
        if found.xml is None:
            continue
        assert schema_errors(found.xml, version) == [], (version, profile)
        assert story_problems(found.xml) == [], (version, profile)
        assert untraced(found) == [], (version, profile)
        if found.parameters is not None:
            assert schema_errors(found.parameters, version) == [], (version, profile)


@pytest.mark.slow
@pytest.mark.parametrize("id_", ROWS)
def test_the_quality_checker_has_no_objection(id_: str, tmp_path: Path) -> None:
    for version in XML_VERSIONS[2:]:  # it skips most of its rules before
        found = written(id_, version, allow_approx=True)
        for text in (found.xml, found.parameters):
            if text is not None:
                assert checker_issues(text, tmp_path) == []


def digest() -> str:
    """Return a digest of the documents of all rows."""
    texts = (written(id_, "1.3").xml or "" for id_ in ROWS)
    return sha256("\0".join(texts).encode()).hexdigest()


@pytest.mark.slow
def test_documents_are_the_same_on_every_machine() -> None:
    done = subprocess.run(
        [
            *(sys.executable, "-c"),
            "from tests.unit.backends.xosc import test_spec_rows; print(test_spec_rows.digest())",
        ],
        env={**os.environ, "PYTHONHASHSEED": "1"},
        cwd=Path(__file__).parents[4],
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == f"{digest()}\n"
