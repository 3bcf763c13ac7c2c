"""A thousand attacks from a seed: each output has the shape of that of a harmless twin."""

from __future__ import annotations

import json
from contextlib import redirect_stdout
from dataclasses import dataclass, field
from importlib import import_module
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from osc2tx.building.build import BuildOptions, build
from osc2tx.building.written_digests import DIGESTS_NAME
from osc2tx.compilation.driver import Compilation
from osc2tx.config import GivenOptions
from osc2tx.diagnostics import Diagnostic
from osc2tx.diagnostics.render import render_all, render_github, render_json, render_sarif
from osc2tx.diagnostics.report import make_report
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import CompileOptions, XmlOptions
from osc2tx_runtime import RunSettings, ScenarioError, run_scenario
from osc2tx_runtime.opendrive import MapError
from osc2tx_runtime.opendrive.road_map import read_map_text
from osc2tx_runtime.report.page import render_report
from osc2tx_runtime.report.tree_pictures import tree_svg, tree_text
from osc2tx_shared.text import put, visible
from tests.processes import forked
from tests.unit.building.projects import drive, write
from tests.unit.hostile.attacks import NAMES, POSITIONS, Attack, attacks
from tests.unit.hostile.shapes import (
    assert_calm,
    html_shape,
    json_shape,
    lines_shape,
    skeleton,
    xml_shape,
)
from tests.unit.hostile.texts import quoted

pytestmark = pytest.mark.slow
EXITS = {0, 1, 2, 3, 4, 5}

SOUND = """# {comment}
import osc.standard.all

namespace null use std, stdtypes

scenario |{scenario}|:
    road: map with:
        keep(it.map_file == "highway.xodr")
    |{parameter}|: speed
    keep(|{parameter}| in [20kph..30kph])
    |{field}|: string = {string}
    |{actor}|: vehicle
    event |{event}|
    # {comment}
    do |{label}|: serial:
        |{actor}|.assign_position() with:
            lane(2, at: start)
            position(100m, at: start)
            speed(5mps, at: start)
        # {comment}
        emit |{event}|
        |{action}|: |{actor}|.drive(duration: 200ms) with:
            speed(|{parameter}|)
        wait (|{field}| == {string})
"""
FAULTY = """import osc.standard.all

namespace null use std, stdtypes

scenario top: {allow}
    ego: |{undefined}|
    npc: vehicle
    do serial:
        npc.|{member}|()
        npc.drive(duration: 3s) with:
            speed(5{unit})
"""
HARMLESS = {
    **{name: f"harmless_{name}" for name in (*NAMES, "undefined", "member")},
    **{"string": quoted("harmless"), "comment": "harmless", "unit": "harmless", "allow": ""},
}


@dataclass
class Outputs:
    """All that becomes of a source."""

    python: list[str] = field(default_factory=list)
    documents: list[Any] = field(default_factory=list)
    xml: list[Any] = field(default_factory=list)
    json: list[Any] = field(default_factory=list)
    html: list[Any] = field(default_factory=list)
    lines: list[Any] = field(default_factory=list)
    codes: list[str] = field(default_factory=list)


def outputs_of(folder: Path, text: str, name: str = "source.osc") -> Outputs:
    path = folder / name
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    options = CompileOptions(xml=XmlOptions(allow_approx=True))
    compilation = Compilation(path, name, options)
    compilation.check()
    found = Outputs()
    add_reports(found, compilation.diagnostics, folder)
    module = compilation.module
    if module is None:
        return found
    for output in compilation.outputs():
        assert_calm(output.text, commands=True)
        if output.suffix.endswith(".py"):
            found.python = skeleton(output.text)
        elif output.suffix.endswith(".xosc"):
            found.documents.append(xml_shape(output.text))
        else:
            json_shape(output.text)
    with scenarios_of_module(module) as scenarios:
        for scenario in scenarios.values():
            root = scenario(RunSettings()).create_tree()
            drawn = printed(tree_text(root))
            assert_calm(drawn)
            found.lines.append(drawn.count("\n"))
            found.xml.append(xml_shape(tree_svg(root)))
            run = run_scenario(scenario, RunSettings(max_time=0.3))
            assert_calm(printed(visible(run.reason)))
            found.html.append(html_shape(render_report(run.trace_lines)))
            found.json.append([json_shape(line) for line in run.trace_lines])
    return found


def add_reports(found: Outputs, diagnostics: tuple[Diagnostic, ...], folder: Path) -> None:
    report = make_report(diagnostics, files=1, folder=folder)
    for color in (False, True):
        text = printed(render_all(report.diagnostics, color=color, folder=folder), colored=color)
        assert_calm(text, colored=color)
        found.lines.append(lines_shape(text) if not color else text.count("\n"))
    commands = render_github(report)
    assert_calm(commands, commands=True)
    found.lines.append([line.split(" ")[0] for line in commands.split("\n")])
    found.json.append(json_shape(render_sarif(report, version="1")))
    found.json.append(json_shape(render_json(report, version="1")))
    found.codes = [report.code for report in diagnostics]


def printed(text: str, *, colored: bool = False) -> str:
    """Return what standard output gets of a text."""
    with redirect_stdout(StringIO()) as stream:
        put(text, colored=colored)
    return stream.getvalue()


def cases(*positions: str) -> list[Attack]:
    return [attack for position in positions for attack in attacks(position)]


@pytest.fixture(scope="module")
def twins(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Outputs]:
    """What harmless texts give: a name, and at each place one that is no name of Python."""
    folder = tmp_path_factory.mktemp("twins")
    texts = {"sound": SOUND.format(**HARMLESS), "faulty": FAULTY.format(**HARMLESS)}
    texts |= {name: SOUND.format(**{**HARMLESS, name: f"harmless {name}"}) for name in NAMES}
    return {key: outputs_of(folder, text) for key, text in texts.items()}


def filled(attack: Attack) -> dict[str, str]:
    text = quoted(attack.text) if attack.position == "string" else attack.text
    return {**HARMLESS, attack.position: text}


@pytest.mark.parametrize("attack", cases(*NAMES, "string", "comment"), ids=str)
def test_sound_sources(tmp_path: Path, twins: dict[str, Outputs], attack: Attack) -> None:
    found = outputs_of(tmp_path, SOUND.format(**filled(attack)))
    twin = twins["sound"]
    assert twin.python and twin.html
    if found.codes == twin.codes and found.python:
        if not found.documents:  # a text that XML cannot hold, or that means a parameter there
            found.documents = twin.documents
        assert found in (twin, twins.get(attack.position))
    else:  # two names are one, or it is no name after all: then there is no module
        assert not found.python and any(code.startswith("OSC") for code in found.codes)


@pytest.mark.parametrize("attack", cases("undefined", "member", "unit", "allow"), ids=str)
def test_faulty_sources(tmp_path: Path, twins: dict[str, Outputs], attack: Attack) -> None:
    comment = f"#! allow {attack.text}" if attack.position == "allow" else ""
    given = {**HARMLESS, attack.position: comment or attack.text}
    found = outputs_of(tmp_path, FAULTY.format(**given))
    assert not found.python
    if found.codes == twins["faulty"].codes:
        assert found.json[:1] == twins["faulty"].json[:1]


@pytest.mark.parametrize("attack", cases("raw"), ids=str)
def test_texts_that_are_no_source(tmp_path: Path, attack: Attack) -> None:
    found = outputs_of(tmp_path, f"scenario a:\n    x: string = {attack.text}\n{attack.text}\n")
    assert not any(code.startswith("OSC9") for code in found.codes)


# --- the command line ---


def said(folder: Path, *arguments: str, before: Any = bool) -> None:
    """Call osc2tx in a process of its own; what it prints is calm."""
    from osc2tx import cli

    def main() -> None:
        before()
        cli.main(list(arguments))

    ended = forked(main, folder=folder)
    assert ended.code in EXITS, ended.err
    assert "Traceback" not in ended.err
    github = "github" in arguments
    assert_calm(ended.out, commands=github)
    assert_calm(ended.err)


@pytest.fixture(scope="module")
def warm(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Load in this process what its copies would load each for itself."""
    folder = tmp_path_factory.mktemp("warm")
    outputs_of(folder, SOUND.format(**HARMLESS))
    drive(folder / "in/a.osc")
    build([folder / "in"], folder / "out", GivenOptions())
    for command in ("build", "check", "config", "explain", "run"):
        import_module(f"osc2tx.cli.{command}")


@pytest.fixture
def project(tmp_path: Path, warm: None) -> Path:
    drive(tmp_path / "in/a.osc")
    return tmp_path


@pytest.mark.parametrize("attack", cases("file", "folder"), ids=str)
def test_names_of_files_and_folders(project: Path, attack: Attack) -> None:
    name = f"{attack.text}.osc" if attack.position == "file" else f"{attack.text}/b.osc"
    try:
        path = write(project / "in" / name, FAULTY.format(**HARMLESS))
        drive(path.with_name(f"x{path.name}"))
    except (OSError, ValueError) as error:
        pytest.skip(f"this file system has no such names: {error}")
    before = {each for each in project.rglob("*") if "out" not in each.parts}
    said(project, "build", "in", "-o", "out", "--output-format", "github")
    said(project, "build", "in", "-o", "out", "--diff")
    assert {each for each in project.rglob("*") if "out" not in each.parts} == before


FORMS = (
    "out = {0}\n",
    "[scenarios.{0}.run]\nseed = 1\n",
    "{0} = 1\n",
    "[scenarios.a.run]\nset = [{0}]\n",
    "dialect = {0}\n",
)


@pytest.mark.parametrize("number, attack", list(enumerate(cases("setting"))), ids=str)
def test_settings(project: Path, number: int, attack: Attack) -> None:
    text = json.dumps(attack.text).replace("\x7f", "\\u007f")
    write(project / "in/osc2tx.toml", FORMS[number % len(FORMS)].format(text))
    said(project, "config", "in/a.osc")
    said(project, "check", "in", "--output-format", "github")


OPTIONS = (
    *("--set", "--signal", "--spawn", "--destination", "--seed", "--dt", "--max-time"),
    *("--scenario", "--map-path", "--allow-external", "--world", "--control", "--physics", "--std"),
)


@pytest.mark.parametrize("number, attack", list(enumerate(cases("option"))), ids=str)
def test_options(project: Path, number: int, attack: Attack) -> None:
    option = OPTIONS[number % len(OPTIONS)]
    text = attack.text.replace("\0", "")
    forms = (text, f"{text}=1", f"{text}@1s", f"ego={text}", f"{text},1,2")
    said(project, "run", "in/a.osc", option, forms[number % len(forms)])
    said(project, *(("explain", text) if number % 2 else (text,)))


MAP = """<OpenDRIVE><header revMajor="1"/>
<road id="{id}" name="{name}" length="{length}" junction="-1">
<planView><geometry s="0" x="0" y="0" hdg="0" length="100"><line/></geometry></planView>
<lanes><laneSection s="0"><right><lane id="{lane}" type="{type}">
<width sOffset="0" a="{width}" b="0" c="0" d="0"/></lane></right></laneSection></lanes>
</road></OpenDRIVE>"""
SOUND_MAP = {"id": "1", "name": "a", "length": "100", "lane": "-1", "type": "driving", "width": "3"}
NUMBERS = ["1_0", "\uff11", "nan", "inf", "1e999", "-3.5", "0x1", "", " ", "1e9", "9" * 400]


@pytest.mark.parametrize("number, attack", list(enumerate(cases("map"))), ids=str)
def test_maps(number: int, attack: Attack) -> None:
    from xml.sax.saxutils import quoteattr

    place = list(SOUND_MAP)[number % len(SOUND_MAP)]
    texts = [quoteattr(attack.text)[1:-1], attack.text, NUMBERS[number % len(NUMBERS)]]
    for text in texts:
        try:
            read_map_text(MAP.format(**{**SOUND_MAP, place: text}), attack.text)
        except MapError as error:
            assert_calm(printed(visible(str(error))))


@pytest.mark.parametrize("number, attack", list(enumerate(cases("trace"))), ids=str)
def test_traces(number: int, attack: Attack) -> None:
    def page(text: str) -> str:
        lines = [
            {"kind": "header", "version": 1, "scenario": text, "map": text, "dt": 0.05},
            {"t": 0.0, "kind": "action", "status": "start", "name": text, "actor": text},
            {"t": 0.0, "kind": "event", "name": text, "arguments": {text: text}},
            {"t": 0.0, "kind": text},
            {"kind": "result", "status": text, "reason": text, "steps": 1},
        ]
        raw = text if number % 2 else json.dumps(text)
        return render_report([*map(json.dumps, lines), raw])

    made = page(attack.text)
    assert html_shape(made) == html_shape(page("harmless"))
    assert_calm(made, commands=True)


@pytest.mark.parametrize("number, attack", list(enumerate(cases("output"))), ids=str)
def test_outputs_of_others(project: Path, number: int, attack: Attack) -> None:
    """What an output states of itself, and what is known of it, leads out of no folder."""
    stated = f'"""\nMade by osc2tx from {attack.text}: edit the scenario, not this module.\n"""\n'
    document = {"format": 1, "source": attack.text}
    digests = {"format": 2, "digests": {attack.text: [attack.text, "0"], "../a.py": ["a.osc"]}}
    texts = {
        "gone.py": stated,
        "gone.xosc.report.json": json.dumps(document),
        DIGESTS_NAME: json.dumps(digests),
    }
    for name, text in texts.items():
        place = project / "out" / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(text.encode("utf-8", "surrogatepass"))
    before = {each for each in project.rglob("*") if "out" not in each.parts}
    options = BuildOptions(prune=True, force=number % 2 == 0)
    build([project / "in"], project / "out", GivenOptions(), options)
    said(project, "build", "in", "-o", "out", "--prune")
    assert {each for each in project.rglob("*") if "out" not in each.parts} == before


@pytest.mark.parametrize("number, attack", list(enumerate(cases("own_action"))), ids=str)
def test_own_actions(capsys: pytest.CaptureFixture[str], number: int, attack: Attack) -> None:
    from osc2tx_runtime.running.main import main
    from tests.runtime.tree.test_own_code import raiser, scenario

    hooks: dict[str, Any] = {
        "on_start": raiser(RuntimeError(attack.text)),
        "on_update": lambda action: action.fail(attack.text),
        "on_stop": raiser(ScenarioError(attack.text, attack.text)),
    }
    name = list(hooks)[number % len(hooks)]
    own = scenario(**{name: hooks[name]})
    own.name = own.source = attack.text
    assert main(own, argv=["--max-time", "0.2"]) == 5
    with pytest.raises(SystemExit):
        main(own, argv=["--help"])
    with pytest.raises(SystemExit):
        main(own, argv=["--dt", "1", attack.text])
    for stream in capsys.readouterr():
        assert_calm(stream)


def test_there_are_a_thousand() -> None:
    assert sum(POSITIONS.values()) >= 1000
