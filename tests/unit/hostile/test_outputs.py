"""Files of strangers do not decide where osc2tx writes, nor which code it runs."""

from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx import cli
from osc2tx.building.lock import only_build
from osc2tx.campaigns.store import CampaignError, Store
from tests.processes import forked
from tests.unit.building.projects import contents, drive, write

NAMED = """\
import osc.standard.all
namespace null use std, stdtypes

scenario |{name}|:
    car: vehicle
    do car.drive(duration: 1s)
"""


Call = Callable[..., tuple[int, str]]


def command(folder: Path, *arguments: str) -> tuple[int, str]:
    """Run a command in a folder; return its exit code and what it printed."""
    ended = forked(lambda: cli.main(arguments), folder=folder / "work")
    return ended.code, ended.out + ended.err


@pytest.fixture
def call(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Call:
    """Run commands in the folder `work`; nothing may come into being beside it."""
    monkeypatch.setenv("OSC2TX_NO_CACHE", "1")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "work"))
    drive(tmp_path / "work/a.osc")
    (tmp_path / "beside").mkdir()

    def called(*arguments: str) -> tuple[int, str]:
        before = outside(tmp_path)
        result = command(tmp_path, *arguments)
        assert outside(tmp_path) == before
        return result

    return called


def outside(folder: Path) -> dict[str, bytes]:
    return {k: v for k, v in contents(folder).items() if not k.startswith("work/")}


@pytest.mark.parametrize("out", ["../beside", "../new", "{folder}/new", "a/../../beside", "link"])
def test_settings_lead_no_output_out_of_the_project(call: Call, tmp_path: Path, out: str) -> None:
    (tmp_path / "work/link").symlink_to(tmp_path / "beside")
    write(tmp_path / "work/osc2tx.toml", f'out = "{out.format(folder=tmp_path)}"\n')
    code, printed = call("build", "a.osc")
    assert code == 2 and "out of the project" in printed
    assert command(tmp_path, "build", "a.osc", "-o", str(tmp_path / "beside"))[0] == 0


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("trace", '"../beside/x.jsonl"'),
        ("report", '"../beside/x.html"'),
        ("allow-external", '["os.system"]'),
        ("ego", '["car=os:system"]'),
    ],
)
@pytest.mark.parametrize("world", ["embedded", "carla"])
def test_settings_name_neither_code_nor_files_to_write(
    call: Call, tmp_path: Path, option: str, value: str, world: str
) -> None:
    table = f'[scenarios.a.run]\nworld = "{world}"\n{option} = {value}\n'
    write(tmp_path / "work/osc2tx.toml", table)
    for arguments in (("run", "a.osc", "--world", "embedded"), ("test", "a.osc")):
        code, printed = call(*arguments)
        assert code != 0 and option in printed and "Traceback" not in printed


def test_settings_connect_to_no_cluster(call: Call, tmp_path: Path) -> None:
    """A scheduler sends objects that run code when they are unpacked."""
    table = '[scenarios.a.campaign]\nengine = "dask://stranger:8786"\n'
    write(tmp_path / "work/osc2tx.toml", table)
    code, printed = call("campaign", "run", "a.osc", "--samples", "1")
    assert code == 2 and "unknown key `engine`" in printed


@pytest.mark.parametrize(
    "arguments",
    [
        ("build", "a.osc", "-o", "folder"),
        ("build", "a.osc", "-o", "folder/inner"),
        ("run", "a.osc", "--trace", "file"),
        ("run", "a.osc", "--report", "file"),
        ("run", "a.osc", "--trace", "folder/inner/x"),
        ("campaign", "run", "a.osc", "--samples", "1", "--store", "file"),
        ("test", "a.osc", "--junit", "file"),
        ("test", "a.osc", "--traces", "folder"),
        ("report", "run.jsonl", "-o", "file"),
        ("fmt", "linked.osc"),
    ],
    ids=" ".join,
)
def test_links_lead_no_output_out_of_the_folder(
    call: Call, tmp_path: Path, arguments: tuple[str, ...]
) -> None:
    work, beside = tmp_path / "work", tmp_path / "beside"
    assert call("run", "a.osc", "--trace", "run.jsonl")[0] == 0
    drive(beside / "other.osc")
    write(beside / "other.osc", (beside / "other.osc").read_text() + "\n\n\n")
    (work / "file").symlink_to(beside / "new")
    (work / "folder").symlink_to(beside)
    (work / "linked.osc").symlink_to(beside / "other.osc")
    code, printed = call(*arguments)
    assert code != 0 and f"a link leads to {beside}" in printed


def test_the_command_line_leads_anywhere(call: Call, tmp_path: Path) -> None:
    (tmp_path / "work/folder").symlink_to(tmp_path / "work/inner")
    assert call("run", "a.osc", "--trace", "folder/x.jsonl")[0] == 0
    assert (tmp_path / "work/inner/x.jsonl").is_file()
    assert command(tmp_path, "run", "a.osc", "--trace", "../beside/x.jsonl")[0] == 0
    assert command(tmp_path, "run", "a.osc", "--report", str(tmp_path / "beside/x.html"))[0] == 0


@pytest.mark.parametrize("name", ["../x", "/x", "../../beside/x", "..", "a\\\\b", "con"])
def test_names_of_scenarios_are_no_paths(call: Call, tmp_path: Path, name: str) -> None:
    write(tmp_path / "work/a.osc", NAMED.format(name=name))
    assert call("build", "a.osc", "-o", "out")[0] == 0
    assert call("test", "a.osc", "--traces", "traces")[0] == 0
    assert call("campaign", "run", "a.osc", "--samples", "1")[0] == 0
    assert len(list((tmp_path / "work").glob("*.campaign"))) == 1


def test_junit_replaces_only_itself(call: Call, tmp_path: Path) -> None:
    for _ in range(2):
        assert call("test", "a.osc", "--junit", "tests.xml")[0] == 0
    before = (tmp_path / "work/a.osc").read_bytes()
    code, printed = call("test", "a.osc", "--junit", "a.osc")
    assert code == 2 and "it is no junit" in printed
    assert (tmp_path / "work/a.osc").read_bytes() == before


def test_a_store_is_made_through_no_link(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "work").mkdir()
    (tmp_path / "work/store").symlink_to(tmp_path / "new")
    monkeypatch.chdir(tmp_path / "work")
    with pytest.raises(CampaignError, match="a link leads to"):
        Store(Path("store"), is_new=True)
    assert not (tmp_path / "new").exists()


def test_a_lock_is_taken_through_no_link(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("osc2tx.building.lock._folder", lambda: tmp_path / "locks")
    with only_build(tmp_path / "out", lambda process: None):
        (lock,) = (tmp_path / "locks").iterdir()
    victim = write(tmp_path / "victim", "mine\n")
    lock.unlink()
    lock.symlink_to(victim)
    with only_build(tmp_path / "out", lambda process: None):
        pass
    assert victim.read_text() == "mine\n"
