"""`--target` and the options of OpenSCENARIO XML: what is made, said and returned."""

import json
import shutil
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

from osc2tx.building.written_digests import read_digests
from osc2tx_shared.map_files import DEFAULT_MAP, SHIPPED
from tests.unit.building.projects import listing
from tests.unit.cli.shell import Shell

HEAD = "import osc.standard.all\n\nnamespace null use std, stdtypes\n\n"
DRIVE = """scenario {name}:
    ego: vehicle
    do ego.drive(duration: 3s) with:
        speed(30kph)
"""
COMPUTED = """scenario computed:
    ego, other: vehicle
    do ego.drive() with:
        speed(30kph)
        until ego.speed > 2 * other.speed
"""
NEARLY = """scenario nearly:
    ego: vehicle
    do ego.drive(duration: 3s) with:
        speed(30kph)
        until ego.speed >= 50kph
"""
LOGICAL = """scenario logical:
    ego: vehicle
    v: speed with:
        keep(it in [10mps..20mps])
    do ego.drive(duration: 3s) with:
        speed(v)
"""
OUTSIDE = """scenario outside:
    ego: vehicle
    event go
    do ego.drive() with:
        speed(30kph)
        until @go
"""


MIGRATED = Path(__file__).parents[2] / "golden/semantics/scenario_runner/scenario.osc"


@pytest.fixture
def shell(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Shell:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / ".cache"))
    return Shell(capsys, tmp_path)


def made(shell: Shell) -> list[str]:
    return listing(shell.folder / "out")


def report(shell: Shell, name: str) -> dict[str, Any]:
    text = (shell.folder / f"out/{name}.xosc.report.json").read_text()
    found: dict[str, Any] = json.loads(text)
    return found


def version(shell: Shell, name: str) -> str:
    """Return the version that a document names."""
    header = etree.parse(shell.folder / f"out/{name}.xosc").find("FileHeader")
    assert header is not None
    return f"{header.attrib['revMajor']}.{header.attrib['revMinor']}"


def test_by_default_there_is_xml_where_it_is_exact(shell: Shell) -> None:
    shell.write("in/a.osc", HEAD + DRIVE.format(name="a"))
    shell.write("in/b.osc", HEAD + COMPUTED)
    ended = shell("build", "in", "-o", "out")
    assert (ended.code, ended.err) == (0, "")
    assert ended.out.splitlines() == [
        "XML for 1 of 2 scenarios; the reports state the reasons",
        "2 modules in out: 6 files written; 0 errors, 0 warnings",
    ]
    assert [name for name in made(shell) if ".xosc" in name] == [
        "a.xosc",
        "b.computed.xosc.report.json",
    ]
    assert report(shell, "b.computed")["written"] is False


def test_the_summary_is_remembered(shell: Shell) -> None:
    shell.write("in/b.osc", HEAD + COMPUTED)
    first, second = (shell("build", "in", "-o", "out").out for _ in range(2))
    assert first.splitlines()[0] == second.splitlines()[0]
    assert "0 files written" in second


def test_where_xml_is_asked_for_its_lack_is_an_error(shell: Shell) -> None:
    shell.write("in/a.osc", HEAD + DRIVE.format(name="a"))
    shell.write("in/b.osc", HEAD + COMPUTED)
    ended = shell("build", "in", "-o", "out", "--target", "xosc")
    assert ended.code == 3
    assert "in/b.osc:9:15: error[OSC514]" in ended.err
    lines = ended.out.splitlines()
    assert lines[0].startswith("a.osc: a: OpenSCENARIO XML 1.3: ") and "exact" in lines[0]
    assert lines[1].startswith("b.osc: computed: no OpenSCENARIO XML 1.3: ")
    assert "1 inexpressible" in lines[1]
    assert made(shell) == ["a.xosc", "b.computed.xosc.report.json"]


def test_only_modules(shell: Shell) -> None:
    shell.write("in/a.osc", HEAD + DRIVE.format(name="a"))
    assert shell("build", "in", "-o", "out", "--target", "py").code == 0
    assert made(shell) == ["a.map.json", "a.py"]


def test_approximations_have_to_be_accepted(shell: Shell) -> None:
    shell.write("in/a.osc", HEAD + NEARLY)
    asked = ("build", "in", "-o", "out", "--target", "xosc", "--xml-version", "1.0")
    refused = shell(*asked)
    assert refused.code == 3
    assert "error[OSC515]" in refused.err and "`--allow-approx` accepts this" in refused.err
    assert "a.nearly.xosc" not in made(shell)
    assert shell(*asked, "--allow-approx").code == 0
    assert 'revMinor="0"' in (shell.folder / "out/a.nearly.xosc").read_text()
    losses = report(shell, "a.nearly")["losses"]
    assert {loss["construct"]: loss["grade"] for loss in losses} == {
        "`>=`": "approximated",
        "until": "approximated",  # 1.0 cannot tell that the run fails
    }


def test_options_are_part_of_what_is_remembered(shell: Shell) -> None:
    shell.write("in/a.osc", HEAD + DRIVE.format(name="a"))
    shell("build", "in", "-o", "out")
    assert "1 file written" in shell("build", "in", "-o", "out", "--xml-version", "1.1").out
    assert 'revMinor="1"' in (shell.folder / "out/a.xosc").read_text()
    assert "0 files written" in shell("build", "in", "-o", "out", "--xml-version", "1.1").out


def test_settings(shell: Shell) -> None:
    shell.write("in/osc2tx.toml", 'xml_version = "1.1"\n[scenarios.b]\ntarget = "py"\n')
    shell.write("in/a.osc", HEAD + DRIVE.format(name="a"))
    shell.write("in/b.osc", HEAD + DRIVE.format(name="b"))
    assert shell("build", "in", "-o", "out").code == 0
    assert "b.computed.xosc" not in made(shell)
    assert version(shell, "a") == "1.1"


def test_signals_of_a_run_are_those_of_the_document(shell: Shell) -> None:
    shell.write("in/a.osc", HEAD + OUTSIDE)
    shell("build", "in", "-o", "out")
    assert "signal_go" not in (shell.folder / "out/a.outside.xosc").read_text()
    shell.write("in/osc2tx.toml", '[scenarios.a.run]\nsignal = ["go@1500ms"]\n')
    shell("build", "in", "-o", "out")
    assert 'value="1.5"' in (shell.folder / "out/a.outside.xosc").read_text()
    shell("build", "in", "-o", "out", "--signal", "go@2s")
    assert 'value="1.5"' not in (shell.folder / "out/a.outside.xosc").read_text()


@pytest.mark.parametrize("option", [("--signal", "go"), ("--spawn", "ego=1"), ("--signal", "@1s")])
def test_options_without_sense(shell: Shell, option: tuple[str, str]) -> None:
    shell.write("in/a.osc", HEAD + OUTSIDE)
    ended = shell("build", "in", "-o", "out", "--target", "xosc", *option)
    assert ended.code == 3
    assert option[0] in ended.err and "OSC514" in ended.err


def test_a_profile_that_reads_one_version_gets_it(shell: Shell) -> None:
    shell.write("in/a.osc", HEAD + DRIVE.format(name="a"))
    shell("build", "in", "-o", "out", "--xml-profile", "scenario_runner", "--allow-approx")
    assert version(shell, "a") == "1.0"
    ended = shell(
        "check",
        "in",
        "--target",
        "xosc",
        "--xml-profile",
        "scenario_runner",
        "--xml-version",
        "1.3",
    )
    assert ended.code == 3 and "scenario_runner reads OpenSCENARIO XML 1.0 only" in ended.err


def test_several_scenarios_have_a_document_each(shell: Shell) -> None:
    shell.write(
        "in/two-lanes.osc",
        HEAD + DRIVE.format(name="left") + "\n" + DRIVE.format(name="Left") + "\n" + LOGICAL,
    )
    shell("build", "in", "-o", "out", "--target", "xosc")
    assert [name for name in made(shell) if name.endswith(".xosc")] == [
        "two_lanes.Left_2.xosc",
        "two_lanes.left.xosc",
        "two_lanes.logical.params.xosc",
        "two_lanes.logical.xosc",
    ]
    text = (shell.folder / "out/two_lanes.logical.params.xosc").read_text()
    assert '<ScenarioFile filepath="two_lanes.logical.xosc"/>' in text


def test_a_library_makes_nothing(shell: Shell) -> None:
    shell.write("in/a.osc", "enum color: [red]\n")
    assert shell("build", "in", "-o", "out", "--target", "xosc").code == 0
    assert not (shell.folder / "out").exists() or made(shell) == []


def test_a_document_that_cannot_be_made_any_more_is_removed(shell: Shell) -> None:
    shell.write("in/a.osc", HEAD + DRIVE.format(name="a"))
    shell("build", "in", "-o", "out")
    shell.write("in/a.osc", HEAD + COMPUTED)
    ended = shell("build", "in", "-o", "out", "--check")
    assert "out/a.xosc: is orphaned: a.osc does not produce this file\n" in ended.err
    ended = shell("build", "in", "-o", "out")
    assert "1 removed" in ended.out
    assert "a.xosc" not in made(shell) and "a.computed.xosc.report.json" in made(shell)


def test_files_that_nobody_asked_for_are_no_orphans(shell: Shell) -> None:
    shell.write("in/a.osc", HEAD + DRIVE.format(name="a"))
    shell("build", "in", "-o", "out")
    everything = made(shell)
    for target in ("py", "xosc"):
        ended = shell("build", "in", "-o", "out", "--target", target, "--prune")
        assert (ended.code, ended.err) == (0, "")
    assert made(shell) == everything
    assert ["a.map.json", *read_digests(shell.folder / "out")] == everything


def test_a_changed_map_is_noticed(shell: Shell) -> None:
    keep = '    road: map with:\n        keep(it.map_file == "mine.xodr")\n'
    text = DRIVE.format(name="a").replace("    ego", keep + "    ego", 1)
    shell.write(
        "in/a.osc",
        HEAD
        + text.replace(
            "speed(30kph)",
            "lane(2, at: start)\n" "        position(20m, at: start)\n        speed(30kph)",
        ),
    )
    asked = ("build", "in", "-o", "out", "--target", "xosc")
    assert shell(*asked).code == 3
    shutil.copy(SHIPPED / DEFAULT_MAP, shell.folder / "in/mine.xodr")
    assert shell(*asked).code == 0
    assert 'filepath="mine.xodr"' in (shell.folder / "out/a.xosc").read_text()


def test_check_reports_losses_and_writes_nothing(shell: Shell) -> None:
    shell.write("in/b.osc", HEAD + COMPUTED)
    assert shell("check", "in").code == 0
    ended = shell("check", "in", "--target", "xosc", "--output-format", "json")
    assert ended.code == 3
    (found,) = json.loads(ended.out)["diagnostics"]
    assert found["code"] == "OSC514"
    assert not (shell.folder / "out").exists()


def test_emit_prints_the_document(shell: Shell) -> None:
    shell.write("a.osc", HEAD + DRIVE.format(name="a"))
    ended = shell("build", "a.osc", "--emit", "xosc")
    assert ended.code == 0
    assert ended.out.startswith('<?xml version="1.0" encoding="UTF-8"?>\n<OpenSCENARIO>')
    shell.write("b.osc", HEAD + COMPUTED)
    refused = shell("build", "b.osc", "--emit", "xosc")
    assert (refused.code, refused.out) == (3, "")
    assert "OSC514" in refused.err


def test_what_only_a_dialect_has_is_refused(shell: Shell) -> None:
    """The scenario has modifiers that the library does not know; its XML is refused, not broken."""
    shutil.copy(MIGRATED, shell.folder / "a.osc")
    ended = shell("build", "a.osc", "-o", "out", "--dialect", "carla", "--target", "xosc")
    assert ended.code == 3
    assert "internal error" not in ended.err
    assert "set_color" in ended.err


@pytest.mark.parametrize(
    ("scenarios", "names"),
    [
        (("left",), {"two_lanes.left"}),
        (("left", "right"), {"two_lanes.left", "two_lanes.right"}),
        (("right", "left"), {"two_lanes.left", "two_lanes.right"}),
        (("left", "two_lanes"), {"two_lanes.left", "two_lanes"}),
        (("top", "left"), {"two_lanes.left", "two_lanes.top"}),
        (("left", "Left"), {"two_lanes.left", "two_lanes.Left_2"}),
    ],
)
def test_documents_are_named_by_file_and_scenario(
    shell: Shell, scenarios: tuple[str, ...], names: set[str]
) -> None:
    """So another scenario of the file renames no document."""
    shell.write("in/two-lanes.osc", HEAD + "\n".join(DRIVE.format(name=n) for n in scenarios))
    shell("build", "in", "-o", "out", "--target", "xosc")
    assert {name.removesuffix(".xosc") for name in made(shell) if name.endswith(".xosc")} == names
    text = (shell.folder / "out/two_lanes.left.xosc").read_text()
    assert 'description="left"' in text
