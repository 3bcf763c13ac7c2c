"""Run options: what is read, and what is said about mistakes."""

from __future__ import annotations

from pathlib import Path

import pytest

from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.errors import InputError, SettingsError
from osc2tx_runtime.language.settings import RunSettings
from osc2tx_runtime.running.options import OPTIONS, read_options


def test_defaults() -> None:
    assert read_options({}) == RunSettings()
    assert read_options({"seed": None, "signal": []}) == RunSettings()


def test_every_option() -> None:
    read = read_options(
        {
            "map_path": ["maps", "more"],
            "world": "embedded",
            "control": ["external,npc=exact", "hero=driven"],
            "expect": "true",
            "physics": "fail",
            "signal": ["go@1s", "stop@500ms", "on@2.5"],
            "spawn": ["hero=16,-3,10"],
            "destination": ["hero=obstacle", "npc=1,2,3"],
            "set": ["v=12.5", "side=left"],
            "seed": "7",
            "dt": "0.01",
            "max-time": "2min",
            "trace": "a.jsonl",
            "report": "a.html",
        }
    )
    assert read == RunSettings(
        map_path=(Path("maps"), Path("more")),
        control={"": "external", "npc": "exact", "hero": "driven"},
        expect=True,
        physics="fail",
        signal={"go": 1.0, "stop": 0.5, "on": 2.5},
        spawn={"hero": ("16", -3, 10.0)},
        destination={"hero": "obstacle", "npc": "1,2,3"},
        set={"v": 12.5, "side": "left"},
        seed=7,
        dt=0.01,
        max_time=120.0,
        trace=Path("a.jsonl"),
        report=Path("a.html"),
    )


def test_the_table_fits_the_settings() -> None:
    fields = set(RunSettings.__dataclass_fields__)
    # A run finds out by itself which draw of its seed the map has room for.
    assert {option.field for option in OPTIONS} == fields - {"world_options", "draw", "draws"}


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("signal", "go", "--signal go: write NAME@SECONDS, as in --signal go_signal@1s"),
        ("signal", "go@soon", "`soon` is not a time: write seconds, as in --signal go_signal@1s"),
        ("signal", "go@-1", "the time is negative"),
        ("spawn", "hero", "write ACTOR=ROAD,LANE,S, as in --spawn hero=16,-3,10"),
        ("spawn", "hero=16,x,3", "a lane id and metres along the road"),
        ("destination", "hero=", "write ACTOR=ACTOR or ACTOR=ROAD,LANE,S"),
        ("set", "v12", "--set v12: write NAME=VALUE, as in --set v=12.5"),
        ("seed", "x", "--seed x: write a whole number"),
        ("dt", "0", "write a step length above zero"),
        ("max-time", "-3", "write seconds above zero"),
        ("colour", "red", "unknown option --colour"),
    ],
)
def test_messages(name: str, text: str, message: str) -> None:
    with pytest.raises(SettingsError) as caught:
        read_options({name: text})
    assert message in caught.value.message
    assert caught.value.exit_code == 2


def test_map_search(tmp_path: Path) -> None:
    town = tmp_path / "Town06.xodr"
    town.write_text("<OpenDRIVE/>")
    assert find_map("Town06", (tmp_path,)) == town
    assert find_map("other", (town,)) == town
    assert find_map("highway.xodr", ()).name == "highway.xodr"
    assert find_map(None, ()).name == "highway.xodr"
    with pytest.raises(InputError, match=r"map `Town9` not found in .*--map-path"):
        find_map("Town9", (tmp_path,))
    with pytest.raises(InputError, match="no such folder"):
        find_map("Town9", (tmp_path / "none",))
