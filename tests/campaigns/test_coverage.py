"""Buckets, holes and grades of a campaign, against what one can count by hand."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from osc2tx.campaigns.coverage import Bucket, Item, coverage_of, items_of
from osc2tx.campaigns.store import Store
from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from tests.campaigns.kit import DRIVES, Here, plan_of, run

HEAD = """import osc.standard

enum light: [red, amber, green]

scenario top:
    a: speed with:
        keep(it in [0mps..10mps])
    b: speed with:
        keep(it in [0mps..10mps])
    n: int with:
        keep(it in [1..4])
    colour: light
    wet: bool
    w: float
    keep(w in [0.0..1.0])
"""


def model_of(items: str, folder: Path) -> dict[str, dict[str, object]]:
    """Return the items of the coverage model, as the build writes it."""
    path = folder / "input.osc"
    path.write_text(HEAD + items + DRIVES, encoding="utf-8")
    outputs = Compilation(path, path.name, CompileOptions()).module_outputs()
    (text,) = [each.text for each in outputs if each.suffix == ".coverage.json"]
    return {item["name"]: item for item in json.loads(text)["scenarios"]["top"]}


def pairs(item: dict[str, object]) -> list[tuple[float, float]]:
    buckets = item["buckets"]
    assert isinstance(buckets, list)
    return [(each["low"], each["high"]) for each in buckets]


def test_buckets_by_default(tmp_path: Path) -> None:
    """§7.5.7: truth values, members, whole numbers up to a byte; least, three thirds, greatest."""
    items = "".join(f"    cover({name})\n" for name in ("n", "colour", "wet", "w"))
    found = model_of(items + "    cover(a, unit: kph)\n", tmp_path)
    assert found["wet"]["buckets"] == [{"value": False}, {"value": True}]
    assert found["colour"]["buckets"] == [{"value": v} for v in ("red", "amber", "green")]
    assert found["n"]["buckets"] == [{"value": v} for v in (1, 2, 3, 4)]
    thirds = [(0, 0), (0, 1 / 3), (1 / 3, 2 / 3), (2 / 3, 1), (1, 1)]
    assert pairs(found["w"]) == [pytest.approx(each) for each in thirds]
    assert pairs(found["a"]) == [pytest.approx((36 * x, 36 * y)) for x, y in thirds]


def test_buckets_that_are_said(tmp_path: Path) -> None:
    found = model_of(
        "    cover(a, unit: mps, range: [0..10], every: 4)\n"
        "    cover(b, unit: mps, buckets: [0, 1, 5, 10])\n"
        "    cover(slow, expression: a, unit: mps, every: 4)\n"
        "    cover(some, expression: n, ignore: it > 2)\n"
        "    cover(now, expression: ego.speed, unit: mps)\n",
        tmp_path,
    )
    assert pairs(found["a"]) == [(0, 4), (4, 8), (8, 10)]
    assert pairs(found["b"]) == [(0, 1), (1, 5), (5, 10)]
    assert pairs(found["slow"]) == [(0, 4), (4, 8), (8, 12)]
    assert found["some"]["buckets"] == [{"value": 1}, {"value": 2}]
    assert "buckets" not in found["now"]


def test_what_constraints_make_impossible(tmp_path: Path) -> None:
    """`a + 4 <= b` in 0..10: a is at most 6, b at least 4; the upper end of a bucket is open."""
    found = model_of(
        "    keep(a + 4mps <= b)\n    keep(colour != amber)\n    keep(wet => n >= 3)\n"
        "    cover(a, unit: mps, range: [0..10], every: 2)\n"
        "    cover(b, unit: mps, range: [0..10], every: 2)\n"
        "    cover(colour)\n    cover(wet)\n    cover(n)\n"
        "    cover(both, items: [a, b])\n    cover(rain, items: [wet, n])\n",
        tmp_path,
    )
    assert found["a"]["impossible"] == [[4]]
    assert found["b"]["impossible"] == [[0], [1]]
    assert found["colour"]["impossible"] == [[1]]
    cells = {(i, j) for i in range(5) for j in range(5)}
    possible = {(i, j) for i, j in cells if 2 * i + 4 < 2 * j + 2 or (j == 4 and i <= 3)}
    impossible = found["both"]["impossible"]
    assert isinstance(impossible, list)
    assert cells - {tuple(cell) for cell in impossible} == possible
    assert found["rain"]["impossible"] == [[1, 0], [1, 1]]


def test_no_model_without_items(tmp_path: Path) -> None:
    path = tmp_path / "input.osc"
    path.write_text(HEAD + DRIVES, encoding="utf-8")
    outputs = Compilation(path, path.name, CompileOptions()).module_outputs()
    assert [each.suffix for each in outputs] == [".py", ".map.json"]


def test_the_grade_is_the_share_of_buckets_with_their_hits(tmp_path: Path) -> None:
    """Counted again from the parameters of the rows, without buckets."""
    text = (
        HEAD + "    keep(a < b)\n    cover(a, unit: mps, range: [0..10], every: 2)\n"
        "    cover(b, unit: mps, range: [0..10], every: 2, target: 4)\n    cover(colour)\n"
        "    cover(both, items: [a, b])\n" + DRIVES
    )
    store = tmp_path / "c.campaign"
    run(plan_of(text), store, "random", 25, Here())
    with Store(store) as opened:
        items = coverage_of(opened)
        rows = [each["parameters"] for each in opened.runs()]
    in_bucket = [(int(row["a"] // 2), int(row["b"] // 2)) for row in rows]
    assert {cell: n for cell, n in items["both"].hits.items() if n} == {
        cell: in_bucket.count(cell) for cell in in_bucket
    }
    of_b = [b for _, b in in_bucket]
    enough = sum(of_b.count(index) >= 4 for index in range(5))
    assert items["b"].grade == pytest.approx(100 * enough / 5)
    assert len(items["b"].holes()) == 5 - enough
    assert items["colour"].grade == 100.0 * len({row["colour"] for row in rows}) / 3
    # 15 of the 25 pairs can be: on and above the diagonal.
    assert items["both"].possible == 15
    assert items["both"].grade == pytest.approx(100 * len(set(in_bucket)) / 15)
    assert all(i <= j for i, j in items["both"].holes())


def test_items_of_invoked_scenarios_have_a_path() -> None:
    text = """import osc.standard

scenario vehicle.step:
    v: speed = 20kph
    cover(v, unit: kph, range: [0..40], every: 10)
    do drive(duration: 0.1s)

scenario top:
    n: int with:
        keep(it in [1..2])
    cover(n)
    ego: vehicle
    do serial:
        one: ego.step(v: 10kph)
        ego.step(v: 30kph)
"""
    found = items_of(plan_of(text))
    assert list(found) == ["one.v", "step.v", "n"]
    assert [str(each) for each in found["one.v"].buckets] == ["0..10", "10..20", "20..30", "30..40"]


def test_items_of_objects_are_graded_for_each_object(tmp_path: Path) -> None:
    """Counted again from the parameters of the rows; `keep` narrows what one of them can be."""
    text = f"""import osc.standard

struct box:
    weight: mass with:
        keep(it in [0kg..40kg])
    cover(weight, unit: kg, range: [0..40], every: 10)

actor robot:
    load: box
    gear: int with:
        keep(it in [1..4])
    cover(gear)
    record(lifted, expression: load.weight, unit: kg)

scenario top:
    one: robot
    two: robot with:
        keep(it.gear <= 2)
    spare: box with:
        keep(it.weight >= 20kg)
{DRIVES}"""
    run(plan_of(text), tmp_path / "s", "random", 12, Here())
    with Store(tmp_path / "s") as opened:
        items = coverage_of(opened)
        rows = [each["parameters"] for each in opened.runs()]
    possible = {"one.gear": 4, "two.gear": 2, "one.load.weight": 4, "two.load.weight": 4}
    possible["spare.weight"] = 2
    assert {name: items[name].possible for name in possible} == possible
    for name, buckets in possible.items():
        width = 10 if name.endswith("weight") else 1
        seen = {int(row[name] // width) for row in rows}
        assert items[name].grade == 100.0 * len(seen) / buckets
    assert items["one.lifted"].grade is None
    assert sum(items["one.lifted"].hits.values()) in (0, 12)


@pytest.mark.parametrize(
    ("value", "index"),
    [
        (0.0, 0),
        (0.1, 1),
        (5.0, 2),
        (4.999999999999, 2),
        (9.9, 2),
        (10, 3),
        (10.1, None),
        (-1, None),
    ],
)
def test_boundaries_belong_to_the_bucket_above(value: float, index: int | None) -> None:
    buckets = (Bucket(0, 0, label="min"), Bucket(0, 5), Bucket(5, 10), Bucket(10, 10, label="max"))
    assert Item("x", "cover", "end", buckets=buckets).position(value) == index


def test_what_is_recorded_or_without_buckets_is_not_graded() -> None:
    buckets = (Bucket(value=False), Bucket(value=True))
    assert Item("x", "record", "end", buckets=buckets).grade is None
    assert Item("x", "cover", "end").grade is None
    assert Item("x", "cover", "end", buckets=buckets).grade == 0.0
