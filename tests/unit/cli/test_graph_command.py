"""`osc2tx graph` and `--affected-since`: who uses what, and what does a change reach?"""

import json
import subprocess
from pathlib import Path
from xml.etree import ElementTree

import pytest

from tests.unit.cli.shell import Shell

REPOSITORY = Path(__file__).parents[3]
USE = "\nnamespace null use std, stdtypes\n\n"
FILES = {
    "osc2tx.toml": 'sources = ["scenarios"]\nimport_paths = ["shared"]\nmap_paths = ["maps"]\n',
    "shared/oem/fleet.osc": "import osc.standard.all\n"
    + USE
    + """# Cars of the company
actor test_car inherits vehicle:
    seats: int = 5

actor city_car inherits test_car:
    doors: int = 3
""",
    "scenarios/lib/moves.osc": "import osc.standard.all\n"
    + USE
    + """modifier calm of vehicle.drive:
    top: speed = 30kph
    speed(top)

# Nobody uses it
modifier wild of vehicle.drive:
    speed(200kph)

scenario vehicle.pass_by:
    do serial:
        actor.drive(duration: 1s) with:
            calm()
""",
    "scenarios/lib/road.osc": "import oem.fleet\n"
    + USE
    + """#! allow OSC510: a base
scenario town:
    road: map with:
        keep(it.map_file == "town.xodr")
    ego: city_car
""",
    "scenarios/urban/pass.osc": 'import "../lib/road.osc"\nimport lib.moves\n'
    + USE
    + "scenario pass_by inherits town:\n    do serial:\n        ego.pass_by()\n",
    "scenarios/urban/stand.osc": "import lib.road\n"
    + USE
    + "scenario stand inherits town:\n    do serial:\n        ego.drive(duration: 1s)\n",
    "scenarios/free.osc": "import lib.moves\nimport oem.fleet\n"
    + USE
    + """scenario free:
    ego: test_car
    do serial:
        ego.drive(duration: 1s) with:
            calm(top: 50kph)
""",
}


@pytest.fixture
def project(shell: Shell) -> Shell:
    for name, text in FILES.items():
        shell.write(name, text)
    town = REPOSITORY / "runtime_lib/osc2tx_runtime/maps/highway.xodr"
    shell.write("maps/town.xodr", town.read_text(encoding="utf-8"))
    return shell


def test_a_scenario_and_what_it_uses(project: Shell) -> None:
    assert project("graph", "scenarios/urban/pass.osc").out == """\
scenario pass_by (urban/pass.osc)
├── scenario town (lib/road.osc)
│   ├── actor city_car (oem/fleet.osc)
│   │   └── actor test_car (oem/fleet.osc)
│   └── map town.xodr
└── scenario vehicle.pass_by (lib/moves.osc)
    └── modifier calm (lib/moves.osc)
"""


@pytest.mark.parametrize(
    ("wanted", "users"),
    [
        ("calm", {"vehicle.pass_by", "pass_by", "free"}),
        ("test_car", {"city_car", "town", "pass_by", "stand", "free"}),
        ("town.xodr", {"town", "pass_by", "stand"}),
        ("maps/town.xodr", {"town", "pass_by", "stand"}),
        ("shared/oem/fleet.osc", {"test_car", "town", "pass_by", "stand", "free"}),
        ("wild", set()),
    ],
)
def test_users(project: Shell, wanted: str, users: set[str]) -> None:
    lines = project("graph", "--reverse", wanted).out.splitlines()
    shown = {line.split(" (")[0].split()[-1] for line in lines}
    start = {"test_car", "city_car"} if wanted.endswith("fleet.osc") else {Path(wanted).name}
    assert shown == users | start
    document = json.loads(project("graph", "--reverse", wanted, "--output-format", "json").out)
    assert shown == {node["name"] for node in document["nodes"]}


def test_edges_lead_from_users(project: Shell) -> None:
    document = json.loads(project("graph", "free", "--output-format", "json").out)
    names = [node["name"] for node in document["nodes"]]
    edges = {(names[user], names[used]) for user, used in document["edges"]}
    assert edges == {("free", "test_car"), ("free", "calm")}
    dot = project("graph", "free", "--output-format", "dot").out
    assert '"scenario free (free.osc)" -> "modifier calm (lib/moves.osc)";' in dot


def test_the_sum_of_a_project(project: Shell) -> None:
    out = project("graph").out.splitlines()
    assert out[0] == "6 files: 5 scenarios, 2 actors, 2 modifiers, 1 map"
    assert "     5  use actor test_car (oem/fleet.osc)" in out
    assert "  none  use modifier wild (lib/moves.osc)" in out


def test_the_picture_of_the_documentation(project: Shell) -> None:
    """Files from left to right, those that nothing uses by folder."""
    svg = project("graph", "--output-format", "svg").out
    shown = REPOSITORY / "docs/images/graph.svg"
    assert svg == shown.read_text(encoding="utf-8")
    space = "{http://www.w3.org/2000/svg}"
    texts = {
        next(iter(each.itertext())): float(each.attrib["x"])
        for each in ElementTree.fromstring(svg).iter(f"{space}text")
    }
    assert texts["urban (2 files)"] == texts["free.osc"]
    assert texts["urban (2 files)"] < texts["lib/road.osc"] < texts["oem/fleet.osc"]


def test_a_name_that_there_is_not(project: Shell) -> None:
    ended = project("graph", "clam")
    assert ended.code == 2
    assert "the project has no `clam`; did you mean `calm`?" in ended.err
    ended = project("graph", "--reverse")
    assert (ended.code, "--reverse is for a name" in ended.err) == (2, True)


# --- changes --------------------------------------------------------------------------------------


def git(folder: Path, *arguments: str) -> None:
    subprocess.run(
        ["git", "-c", "user.name=a", "-c", "user.email=a@b", *arguments],
        cwd=folder,
        check=True,
        capture_output=True,
    )


@pytest.fixture
def committed(project: Shell) -> Shell:
    git(project.folder, "init", "-q")
    git(project.folder, "add", "-A")
    git(project.folder, "commit", "-qm", "first")
    return project


def edit(project: Shell, name: str, old: str, new: str) -> None:
    text = (project.folder / name).read_text(encoding="utf-8")
    assert old in text
    project.write(name, text.replace(old, new))


def affected(project: Shell) -> set[str]:
    ended = project("graph", "--affected-since", "HEAD", "--output-format", "json")
    return {Path(each["file"]).name for each in json.loads(ended.out)["affected"]}


EVERYTHING = {"road.osc", "moves.osc", "pass.osc", "stand.osc", "free.osc"}


@pytest.mark.parametrize(
    ("name", "old", "new", "reached"),
    [
        ("scenarios/lib/moves.osc", "# Nobody uses it", "# Nobody", {"moves.osc"}),
        ("scenarios/lib/moves.osc", "200kph", "210kph", {"moves.osc"}),
        ("scenarios/lib/moves.osc", "30kph", "31kph", {"moves.osc", "pass.osc", "free.osc"}),
        ("shared/oem/fleet.osc", "# Cars", "# All cars", set()),
        ("shared/oem/fleet.osc", "= 5", "= 4", {"road.osc", "pass.osc", "stand.osc", "free.osc"}),
        ("shared/oem/fleet.osc", "= 3", "= 4", {"road.osc", "pass.osc", "stand.osc"}),
        (
            "maps/town.xodr",
            "</OpenDRIVE>",
            "<!---->\n</OpenDRIVE>",
            {"road.osc", "pass.osc", "stand.osc"},
        ),
        ("osc2tx.toml", "sources", "std = '2.2'\nsources", EVERYTHING),
        ("scenarios/free.osc", "50kph", "51kph", {"free.osc"}),
    ],
)
def test_what_an_edit_reaches(
    committed: Shell, name: str, old: str, new: str, reached: set[str]
) -> None:
    assert affected(committed) == set()
    edit(committed, name, old, new)
    assert affected(committed) == reached


def test_line_ends_of_a_working_copy_are_no_change(committed: Shell) -> None:
    for path in committed.folder.glob("scenarios/**/*.osc"):
        path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    assert affected(committed) == set()


def test_a_file_that_hides_another_one(committed: Shell) -> None:
    """`import lib.road` finds the file beside the source first."""
    committed.write("scenarios/urban/lib/road.osc", FILES["scenarios/lib/road.osc"])
    assert affected(committed) == {"road.osc", "stand.osc"}
    git(committed.folder, "add", "-A")
    git(committed.folder, "commit", "-qm", "hides")
    (committed.folder / "scenarios/urban/lib/road.osc").unlink()
    assert affected(committed) == {"stand.osc"}


def test_commands_take_only_what_is_affected(committed: Shell) -> None:
    ended = committed("check", "--affected-since", "HEAD")
    assert (ended.code, ended.out) == (0, "checked 0 files: 0 errors, 0 warnings\n")
    edit(committed, "scenarios/free.osc", "50kph", "51kph")
    assert "checked 1 file:" in committed("check", "--affected-since", "HEAD").out
    committed("build", "-o", "generated", "--affected-since", "HEAD")
    made = {path.name for path in (committed.folder / "generated").rglob("*.py")}
    assert made == {"free.py", "moves.py", "fleet.py"}  # and the modules that it imports
    ended = committed("test", "--affected-since", "HEAD~99")
    assert ended.code == 2
    assert "git knows no revision 'HEAD~99'" in ended.err


def test_folders_without_a_repository(project: Shell) -> None:
    ended = project("check", "--affected-since", "HEAD")
    assert ended.code == 2
    assert "is in no git repository" in ended.err
