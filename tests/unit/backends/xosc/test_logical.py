"""Every run of a logical scenario is the scenario with the values of that run.

The document of parameter values is carried out as a tool does it: each row is put into the document
with the parameters. What comes out has to be the document of a scenario whose source has just these
values, and nothing open.
"""

import itertools
import math
import re
from dataclasses import replace
from pathlib import Path

import pytest
from lxml import etree

from osc2tx.backends.xosc import XmlScenario
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions, OneOfPolicy, XmlOptions, XmlVersion
from osc2tx_runtime import RunSettings
from tests.unit.backends.xosc.checks import schema_errors, story_problems
from tests.xosc.parity import NEAR, compare, played, world

HEAD = """\
import osc.standard.all

namespace null use std, stdtypes

"""
SCENARIO = """\
scenario logical:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
{values}
    do serial:
        ego.drive(duration: 2s) with:
            lane({lane}, at: start)
            position(50m, at: start)
            speed({speed})
        {then}
"""
WITHOUT_EFFECT = ("FileHeader", "ParameterDeclarations")
Run = dict[str, str]


def emitted(
    folder: Path, text: str, version: XmlVersion = "1.3", *, one_of: OneOfPolicy = "race"
) -> XmlScenario:
    path = folder / "a.osc"
    path.write_text(HEAD + text, encoding="utf-8")
    xml = XmlOptions(version=version, allow_approx=True)
    options = CompileOptions(target="xosc", xml=xml, one_of=one_of)
    compilation = Compilation(path, path.name, options)
    assert compilation.ir is not None, compilation.diagnostics
    found = compilation.xml[-1]
    assert found.xml is not None, found.report.obstacles
    assert schema_errors(found.xml, version) == []
    assert story_problems(found.xml) == []
    if found.parameters is not None:
        assert schema_errors(found.parameters, version) == []
    return found


def parsed(text: str | None) -> etree._Element:
    assert text is not None
    return etree.fromstring(text.encode(), etree.XMLParser(remove_comments=True))


def runs(found: XmlScenario) -> list[Run]:
    """Return the values of each run, as a tool combines distributions."""
    axes: list[list[Run]] = []
    for node in parsed(found.parameters).iter("Deterministic"):
        for distribution in node:
            if distribution.tag == "DeterministicMultiParameterDistribution":
                sets = distribution.iter("ParameterValueSet")
                axes.append([{a.get("parameterRef"): a.get("value") for a in s} for s in sets])
                continue
            name = distribution.get("parameterName")
            values = [element.get("value") for element in distribution.iter("Element")]
            for steps in distribution.iter("DistributionRange"):
                low, high = (float(steps[0].get(end)) for end in ("lowerLimit", "upperLimit"))
                step = float(steps.get("stepWidth"))
                count = int((high - low) / step + 1e-6)
                values = [str(low + index * step) for index in range(count + 1)]
            axes.append([{name: value} for value in values])
    return [
        dict(itertools.chain(*(run.items() for run in row))) for row in itertools.product(*axes)
    ]


def with_values(found: XmlScenario, run: Run) -> etree._Element:
    """Return the document as a tool sees it in a run."""
    root = parsed(found.xml)
    values = {node.get("name"): node.get("value") for node in root.iter("ParameterDeclaration")}
    assert set(run) <= set(values)
    values |= run
    for node in root.iter("ParameterDeclaration"):
        node.set("value", values[node.get("name")])
    for node in root.iter():
        for key, text in node.attrib.items():
            if text.startswith("${"):
                formula = re.sub(r"\$(\w+)", lambda m: f"({values[m.group(1)]})", text[2:-1])
                assert re.fullmatch(r"[-+*/().0-9e ]+", formula), formula
                node.set(key, repr(eval(formula)))
            elif text.startswith("$"):
                node.set(key, values[text[1:]])
    return root


def assert_same(a: etree._Element, b: etree._Element) -> None:
    assert (a.tag, set(a.attrib)) == (b.tag, set(b.attrib))
    for key, text in a.attrib.items():
        if text != b.get(key):
            assert math.isclose(float(text), float(b.get(key)), rel_tol=1e-6, abs_tol=2e-6), key
    left, right = ([c for c in node if c.tag not in WITHOUT_EFFECT] for node in (a, b))
    assert len(left) == len(right)
    for x, y in zip(left, right, strict=True):
        assert_same(x, y)


RANGES = {
    "v": ("speed", "[10mps..20mps]", "{}mps"),
    "w": ("speed", "[v + 2mps..30mps]", "{}mps"),
    "t": ("time", "[2s..5s]", "{}s"),
    "n": ("uint", "[1..3]", "{}"),
    "p": ("dynamic_profile", "[dynamic_profile!smooth, dynamic_profile!constant]", "{}"),
    "b": ("bool", "[true, false]", "{}"),
    "a": ("acceleration", "[1mpss, 2mpss]", "{}mpss"),
}
CASES = {
    "a lane and a speed": ("nv", {"lane": "n", "speed": "v"}),
    "a profile": ("p", {"then": "ego.change_speed(target: 18mps, rate_profile: p, duration: 6s)"}),
    "a rate towards one side or the other": (
        "va",
        {"speed": "v", "then": "ego.change_speed(15mps, rate_profile: smooth, rate_peak: a)"},
    ),
    "limits of the jerk": ("v", {"speed": "v", "then": "ego.change_speed(22mps)"}),
    "a truth value": (
        "b",
        {"then": "ego.change_speed(target: b ? 18mps : 15mps, duration: 6s)"},
    ),
    "one range above another": (
        "vw",
        {"speed": "v", "then": "ego.change_speed(target: w, rate_profile: constant, duration: 9s)"},
    ),
    "five at once": (
        "vwtpn",
        {
            "lane": "n",
            "speed": "v",
            "then": "ego.change_speed(target: w, rate_profile: p, duration: 2 * t + 4s)",
        },
    ),
}


def source(parts: dict[str, str], values: dict[str, str]) -> str:
    lines = "".join(
        f"    {name}: {RANGES[name][0]} with:\n        keep(it {value})\n"
        for name, value in values.items()
    )
    given = {"lane": "2", "speed": "12mps", "then": "ego.drive(duration: 1s)", **parts}
    return SCENARIO.format(values=lines, **given)


@pytest.mark.parametrize("version", ["1.1", "1.3"])
@pytest.mark.parametrize("case", CASES)
def test_each_run_is_the_scenario_with_its_values(
    case: str, version: XmlVersion, tmp_path: Path
) -> None:
    names, parts = CASES[case]
    found = emitted(tmp_path, source(parts, {n: f"in {RANGES[n][1]}" for n in names}), version)
    graded = {
        entry.grade.value
        for entry in found.report.entries
        if entry.construct.startswith("parameter")
    }
    assert graded == {"exact"}
    listed = runs(found)
    assert 2 <= len(listed) <= 10 * len(names) + 1
    sample = listed[:: max(1, len(listed) // 6)]
    for run in sample:
        fixed = {name: f"== {RANGES[name][2].format(run[name])}" for name in names}
        if "p" in fixed:
            fixed["p"] = f"== dynamic_profile!{run['p']}"
        alone = emitted(tmp_path, source(parts, fixed), version)
        assert alone.parameters is None
        assert_same(with_values(found, run), parsed(alone.xml))


def test_a_table_goes_from_end_to_end_in_each_parameter(tmp_path: Path) -> None:
    text = SCENARIO.format(
        values="".join(
            f"    {name}: speed with:\n        keep(it in [10mps..20mps])\n" for name in "uvw"
        ),
        lane="1",
        speed="u",
        then="ego.change_speed(target: v + w, rate_profile: constant, duration: 20s)",
    )
    listed = runs(emitted(tmp_path, text))
    assert len(listed) == 31  # not 125
    for name in "uvw":
        values = sorted(float(run[name]) for run in listed)
        assert values == pytest.approx([10.0 + index / 3.0 for index in range(31)])
    corners = {tuple(float(run[name]) >= 15.0 for name in "uvw") for run in listed}
    assert len(corners) == 8


@pytest.mark.parametrize(
    ("relation", "holds"),
    [
        ("v < w", lambda v, w: v < w),
        ("w > v + 5mps", lambda v, w: w > v + 5.0),
        ("v + w == 30mps or v < 11mps", lambda v, w: v + w == 30.0 or v < 11.0),
    ],
)
def test_constraints_hold_in_every_row(relation, holds, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    values = "".join(
        f"    {name}: speed with:\n        keep(it in [10mps..20mps])\n" for name in "vw"
    )
    text = SCENARIO.format(
        values=f"{values}    keep({relation})\n",
        lane="1",
        speed="v",
        then="ego.change_speed(target: w, rate_profile: constant, duration: 20s)",
    )
    found = emitted(tmp_path, text)
    listed = runs(found)
    assert 10 <= len(listed) <= 21
    assert all(holds(float(run["v"]), float(run["w"])) for run in listed)
    nominal = {
        n.get("name"): n.get("value") for n in parsed(found.xml).iter("ParameterDeclaration")
    }
    assert holds(float(nominal["v"]), float(nominal["w"]))


def test_an_order_that_hardly_any_values_have_is_refused(tmp_path: Path) -> None:
    """One draw in 40,320 is in order, fewer than are tried."""
    names = [f"v{index}" for index in range(8)]
    values = "".join(f"    {v}: speed with:\n        keep(it in [10mps..20mps])\n" for v in names)
    values += "".join(f"    keep({one} < {next})\n" for one, next in itertools.pairwise(names))
    text = SCENARIO.format(values=values, lane="1", speed="v0", then="ego.assign_speed(v7)")
    path = tmp_path / "a.osc"
    path.write_text(HEAD + text, encoding="utf-8")
    (found,) = Compilation(path, path.name, CompileOptions(target="xosc")).xml
    obstacle = next(e for e in found.report.obstacles if e.construct == "constraints")
    assert found.xml is None
    assert obstacle.reason.startswith("hardly any values of the open parameters keep")
    assert obstacle.span.text == "v0 < v1"


def test_a_choice_of_members_runs_each_of_them(tmp_path: Path) -> None:
    then = """one_of:
            faster: ego.change_speed(target: 15mps, rate_profile: constant, duration: 4s)
            slower: ego.change_speed(target: v, rate_profile: constant, duration: 4s)"""
    values = "    v: speed with:\n        keep(it in [5mps, 6mps])\n"
    text = SCENARIO.format(values=values, lane="1", speed="10mps", then=then)
    for version in ("1.0", "1.1", "1.2", "1.3"):
        found = emitted(tmp_path, text, version, one_of="seeded")
        tested = [
            (node.getparent().getparent().getparent().getparent().getparent().get("name"), node)
            for node in parsed(found.xml).iter("ParameterCondition")
        ]
        starts = {
            (name, node.get("value")) for name, node in tested if name in ("faster", "slower")
        }
        assert starts == {("faster", "faster"), ("slower", "slower")}
        if version > "1.0":
            pairs = {(run["branch"], run["v"]) for run in runs(found)}
            assert pairs == set(itertools.product(("faster", "slower"), ("5", "6")))


def test_a_value_at_which_nothing_happens_is_not_listed(tmp_path: Path) -> None:
    """At 12 m/s there is no change of speed, so there is no event for it."""
    values = "    v: speed with:\n        keep(it in [7mps..17mps])\n"
    then = "ego.change_speed(target: v, rate_profile: constant, duration: 4s)"
    text = SCENARIO.format(values=values, lane="1", speed="12mps", then=then)
    listed = [float(run["v"]) for run in runs(emitted(tmp_path, text))]
    assert len(listed) == 11 and 12.0 not in listed
    assert (min(listed), max(listed)) == (7.0, 17.0)


# --- carried out ---


def assert_runs_like(
    found: XmlScenario, document: etree._Element, path: Path, settings: RunSettings
) -> None:
    """Compare a document whose parameters have values with the module of a scenario."""
    text = etree.tostring(document, encoding="unicode")
    should = world(path, "logical", settings, CompileOptions())
    difference = compare(replace(found, xml=text), should, played(text, settings.dt), settings.dt)
    assert not difference.beyond(NEAR), difference


@pytest.mark.slow
def test_runs_end_where_the_module_does_with_the_same_values(tmp_path: Path) -> None:
    names, parts = CASES["five at once"]
    found = emitted(tmp_path, source(parts, {n: f"in {RANGES[n][1]}" for n in names}))
    listed = runs(found)
    assert len(listed) == 51
    for run in listed[::10]:
        values = {name: run[name] if name == "p" else float(run[name]) for name in names}
        settings = RunSettings(dt=0.05, set=values)
        assert_runs_like(found, with_values(found, run), tmp_path / "a.osc", settings)


@pytest.mark.slow
def test_runs_of_a_choice_do_what_the_member_alone_does(tmp_path: Path) -> None:
    members = {
        "faster": "ego.change_speed(target: 15mps, rate_profile: constant, duration: 4s)",
        "slower": "ego.change_speed(target: 5mps, rate_profile: smooth, duration: 4s)",
        "later": "wait elapsed(3s)",
    }
    choice = "".join(f"\n            {label}: {member}" for label, member in members.items())
    given = {"values": "", "lane": "1", "speed": "10mps"}
    after = "\n        ego.drive(duration: 1s)"
    found = emitted(
        tmp_path, SCENARIO.format(then=f"one_of:{choice}{after}", **given), one_of="seeded"
    )
    assert [run["branch"] for run in runs(found)] == list(members)
    for run in runs(found):
        path = tmp_path / run["branch"] / "a.osc"
        path.parent.mkdir()
        alone = "".join(  # on the line that it has among the others
            f"\n            {member if label == run['branch'] else '# another one'}"
            for label, member in members.items()
        )
        text = SCENARIO.format(then=f"serial:{alone}{after}", **given)
        path.write_text(HEAD + text, encoding="utf-8")
        assert_runs_like(found, with_values(found, run), path, RunSettings(dt=0.05))


@pytest.mark.parametrize("version", ["1.2", "1.3"])
def test_the_scenario_of_a_new_project_is_exact(version: XmlVersion) -> None:
    path = Path(__file__).parents[4] / "templates" / "project" / "scenario.osc"
    options = CompileOptions(target="xosc", xml=XmlOptions(version=version))
    (found,) = Compilation(path, path.name, options).xml
    assert found.xml is not None, found.report.obstacles
    assert {entry.grade.value for entry in found.report.entries} == {"exact"}
    assert [set(run) for run in runs(found)] == [{"v_ego"}] * 5


def test_what_the_run_hands_in_is_not_open(tmp_path: Path) -> None:
    """An invoked scenario has neither its default nor a range where it gets another value."""
    inner = """\
scenario inner:
    who: vehicle
    v: speed = 5mps
    w: speed with:
        keep(it in [2mps..30mps])
    do serial:
        who.change_speed(target: v, rate_profile: constant, duration: 4s)
        who.change_speed(target: w, rate_profile: constant, duration: 4s)

"""
    then = "inner(who: ego, v: ego.speed, w: 2 * ego.speed)"
    path = tmp_path / "a.osc"
    text = SCENARIO.format(values="", lane="1", speed="10mps", then=then)
    path.write_text(f"{HEAD}{inner}{text}", encoding="utf-8")
    found = Compilation(path, path.name, CompileOptions(target="xosc")).xml[-1]
    assert found.xml is None
    reasons = [entry.reason for entry in found.report.obstacles]
    assert len(reasons) == 2 and all("only known during the run" in each for each in reasons)
