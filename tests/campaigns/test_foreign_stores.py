"""Stores of strangers, and stores that something happened to: a message, and nothing elsewhere."""

from __future__ import annotations

import csv
import json
import os
import sqlite3
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from osc2tx.campaigns import CampaignError
from osc2tx.campaigns.export import export_rows, write_text
from osc2tx.campaigns.junit import render_junit
from osc2tx.campaigns.replay import replay_row
from osc2tx.campaigns.report import render_report
from osc2tx.campaigns.store import Store
from osc2tx.campaigns.summary import results_of, summary_of
from osc2tx_runtime.campaigns import Modules
from osc2tx_runtime.errors import SettingsError
from osc2tx_shared.own_folders import CAMPAIGN, FRESH
from tests.campaigns.kit import MIXED, TRIANGLE, Here, digest, plan_of, run


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    place = tmp_path_factory.mktemp("stores") / "store"
    run(plan_of(TRIANGLE, "min_gap"), place, "random", 4, Here())
    with sqlite3.connect(place) as base:
        base.execute("pragma journal_mode = delete")
    base.close()
    return place.read_bytes()


@pytest.fixture
def place(tmp_path: Path, whole: bytes) -> Path:
    place = tmp_path / "store"
    place.write_bytes(whole)
    return place


def change(place: Path, statement: str, *values: object) -> None:
    with sqlite3.connect(place) as base:
        base.execute(statement, values)
    base.close()


def change_plan(place: Path, edit: Callable[[dict[str, object]], object]) -> None:
    with Store(place) as store:
        plan = store.plan
    edit(plan)
    change(place, "update campaign set value = ? where name = 'plan'", json.dumps(plan))


def use_all(place: Path) -> None:
    """Read all that commands read of a store."""
    with Store(place) as store:
        assert store.wanted == 4
        results = results_of(store)
        summary_of(results)
        render_report(results, None)
        export_rows(store, place.with_suffix(".csv"))
        replay_row(store, 1, None, None)
    run(plan_of(TRIANGLE, "min_gap"), place, "random", 5, Here())


@pytest.mark.parametrize(
    "name",
    ["../x.py", "/tmp/x.py", "a/../../x.py", "..\\x.py", "C:\\x.py", "c:x.py", "", "a//b.py", "."],
)
def test_modules_stay_in_their_folder(name: str, place: Path, tmp_path: Path) -> None:
    with pytest.raises(SettingsError, match="is not the path of a module"):
        Modules({"case.py": "", name: "print()"})
    change_plan(place, lambda plan: plan["files"].update({name: "print()"}))  # type: ignore[attr-defined]
    before = sorted(tmp_path.iterdir())
    with Store(place) as store, pytest.raises(SettingsError, match="is not the path of a module"):
        replay_row(store, 1, None, None)
    assert sorted(tmp_path.iterdir()) == before


def test_the_module_itself_stays_too() -> None:
    modules = Modules({"case.py": ""})
    with pytest.raises(SettingsError, match="is not a module of the campaign"):
        modules.load("../case.py")
    modules.close()


DAMAGES = {
    "run": (
        *("shares", "given", "parameters", "measures", "violations"),
        *("steps", "time", "status", "seconds"),
    ),
    "sample": ("line",),
}
JUNK = ("", "[1]", '{"min_gap": "x"}', "no json", "nan", '{"a": ', b"\xff\xfe")


@pytest.mark.parametrize("junk", JUNK)
@pytest.mark.parametrize(
    ("table", "column"), [(table, name) for table, names in DAMAGES.items() for name in names]
)
def test_damaged_rows_are_named(place: Path, table: str, column: str, junk: object) -> None:
    change(place, f"update {table} set {column} = ? where number = 1", junk)
    try:
        use_all(place)
    except CampaignError as error:
        assert str(place) in str(error)
    except SettingsError as error:  # a value that the scenario does not have
        assert column == "given" and error.message
    else:
        assert column == "status"  # any text may be one


@pytest.mark.parametrize("junk", (*JUNK, "{}", "null"))
@pytest.mark.parametrize("name", ["identity", "plan", "samples"])
def test_damaged_campaigns_are_named(place: Path, name: str, junk: object) -> None:
    change(place, "update campaign set value = ? where name = ?", junk, name)
    with pytest.raises(CampaignError, match="is damaged"):
        use_all(place)


@pytest.mark.parametrize("value", [None, 3, "x", [], {"a": 1}, [None], {"x": None}])
@pytest.mark.parametrize(
    "key", ["files", "module", "scenario", "options", "map_path", "measures", "fail_if", "digests"]
)
def test_damaged_plans_are_named(place: Path, key: str, value: object) -> None:
    change_plan(place, lambda plan: plan.update({key: value}))
    try:
        use_all(place)
    except CampaignError as error:
        assert str(place) in str(error)
    except SettingsError as error:
        assert error.message


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 0.9])
def test_files_that_are_cut_or_overwritten(place: Path, whole: bytes, share: float) -> None:
    at = int(len(whole) * share)
    for data in (whole[:at], whole[:at] + b"\xa5" * 2000 + whole[at + 2000 :]):
        place.write_bytes(data)
        try:
            use_all(place)
        except (CampaignError, SettingsError) as error:
            assert str(error)
        place.with_name("store-wal").unlink(missing_ok=True)


def test_a_store_that_is_deleted_meanwhile_is_told(tmp_path: Path) -> None:
    class Deleting(Here):
        def run(self, plan, rows):  # type: ignore[no-untyped-def]
            for found in super().run(plan, rows):
                (tmp_path / "store").unlink()
                yield found

    with pytest.raises(CampaignError, match="was removed or replaced"):
        run(plan_of(MIXED), tmp_path / "store", "random", 3, Deleting())


def test_a_full_disk_keeps_what_was_stored(tmp_path: Path) -> None:
    plan = plan_of(MIXED)
    run(plan, tmp_path / "store", "random", 3, Here())
    with Store(tmp_path / "store") as store:
        store._base._base.execute("pragma max_page_count = 1")
        with pytest.raises(CampaignError, match=r"store: .*full; rows .* before are kept"):
            for number in range(500):
                (found,) = next(Here().run(plan, iter([row(number + 10)])))
                store.add([found])
    run(plan, tmp_path / "whole", "random", 3, Here())
    with Store(tmp_path / "store") as store:
        assert {0, 1, 2} <= store.done()


def row(number: int):  # type: ignore[no-untyped-def]
    from osc2tx_runtime.campaigns import Row

    return Row(number, number)


def test_a_locked_store_is_told(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    connect = sqlite3.connect
    monkeypatch.setattr(
        "sqlite3.connect", lambda path, timeout, **rest: connect(path, timeout=0.1, **rest)
    )
    other = connect(place, isolation_level=None)
    other.execute("begin exclusive")
    with pytest.raises(CampaignError, match="database is locked; rows"):
        use_all(place)
    other.execute("rollback")
    other.close()
    use_all(place)


def test_a_store_in_a_folder_that_cannot_be_written(
    place: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is read without a file beside it, and takes no rows."""
    with sqlite3.connect(place) as base:
        base.execute("pragma journal_mode = wal")
    base.close()
    access = os.access
    monkeypatch.setattr("os.access", lambda path, mode: path != place.parent and access(path, mode))
    names = sorted(each.name for each in place.parent.iterdir())
    with Store(place) as store:
        assert store.done() == {0, 1, 2, 3}
        assert sorted(each.name for each in place.parent.iterdir()) == names
    for name in ("store", "other"):
        with pytest.raises(CampaignError, match=f"{name}: its folder is read-only"):
            Store(place.with_name(name), is_new=True)
    assert sorted(each.name for each in place.parent.iterdir()) == names


def test_a_folder_in_place_of_a_store(tmp_path: Path) -> None:
    with pytest.raises(CampaignError, match=str(tmp_path)):
        Store(tmp_path, is_new=True)


def test_comments_make_no_other_campaign(tmp_path: Path) -> None:
    plan = replace(plan_of(MIXED), digests=True)
    commented = {
        name: f"# A remark\n\n{text}" if name.endswith(".py") else text
        for name, text in plan.files.items()
    }
    run(plan, tmp_path / "one", "random", 2, Here())
    run(replace(plan, files=commented), tmp_path / "one", "random", 4, Here())
    run(plan, tmp_path / "whole", "random", 4, Here())
    assert digest(tmp_path / "one") == digest(tmp_path / "whole")
    other = {**commented, "case.py": commented["case.py"] + "\nX = 1\n"}
    with pytest.raises(CampaignError, match="modules was"):
        run(replace(plan, files=other), tmp_path / "one", "random", 5, Here())


def test_folders_of_killed_processes_are_removed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    held = Modules({"case.py": ""})
    left, young, others = (
        tmp_path / name for name in (f"{CAMPAIGN}left", f"{CAMPAIGN}new", "other")
    )
    for folder in (left, young, others):
        folder.mkdir()
        (folder / "case.py").write_text("")
    old = time.time() - 2 * FRESH
    for folder in (left, others, Path(held._folder.name)):
        os.utime(folder, (old, old))
    link = tmp_path / f"{CAMPAIGN}link"
    link.symlink_to(others)
    Modules({}).close()
    assert not left.exists()
    assert young.exists() and others.exists() and Path(held._folder.name).exists()
    assert (others / "case.py").exists()
    held.close()


@pytest.mark.parametrize("text", ["=1+1", "@SUM(1)", "+1", "-x", "\t=1", "\r=1"])
def test_tables_hold_no_formulas(place: Path, text: str) -> None:
    values = json.dumps({"note": text, "offset": -2.5, text: "plain"})
    change(place, "update run set parameters = ?, reason = ?", values, text)
    with Store(place) as store:
        export_rows(store, place.with_suffix(".csv"))
    with place.with_suffix(".csv").open(newline="") as file:
        for found in csv.DictReader(file):
            assert found["parameter note"] == f"'{text}" == found["reason"]
            assert float(found["parameter offset"]) == -2.5
            assert not any(name.startswith(("=", "+", "-", "@", "\t", "\r")) for name in found)


def test_other_files_are_not_overwritten(place: Path, tmp_path: Path) -> None:
    """Tables replace tables; a scenario, a map and the store itself stay."""
    for name, text in {"rows.csv": "a,b\n1,2\n", "rows.jsonl": '{"kind":"header"}\n'}.items():
        target = tmp_path / name
        target.write_text(text)
        with Store(place) as store:
            with pytest.raises(CampaignError, match="it is no table; name another one"):
                export_rows(store, target)
            assert target.read_text() == text
            target.unlink()
            assert export_rows(store, target) == export_rows(store, target) == 4
    for what in ("report", "summary", "junit"):
        before = place.read_bytes()
        with pytest.raises(CampaignError, match=f"it is no {what}; name another one"):
            write_text(what, place, "x")
        assert place.read_bytes() == before


def test_what_a_campaign_writes_may_be_replaced(place: Path, tmp_path: Path) -> None:
    with Store(place) as store:
        results = results_of(store)
    texts = {
        "report": render_report(results, None),
        "summary": json.dumps(summary_of(results), indent=1) + "\n",
        "junit": render_junit([results]),
    }
    for what, text in texts.items():
        for _ in range(2):
            write_text(what, tmp_path / what, text)


def test_an_empty_table_has_a_header(tmp_path: Path, place: Path) -> None:
    change(place, "delete from run")
    with Store(place) as store:
        assert export_rows(store, tmp_path / "rows.csv") == 0
        assert export_rows(store, tmp_path / "rows.csv") == 0
    assert (tmp_path / "rows.csv").read_text() == "number,seed,status,reason,time\n"
