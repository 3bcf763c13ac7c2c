"""Calls of methods: of the scenario, of types, and defined by the user Python code."""

import importlib
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx_runtime import RunSettings, Scenario, ScenarioError
from osc2tx_runtime.errors import SettingsError
from tests.end_to_end.harness import asam, run

Load = Callable[[GeneratedModule], type[Scenario]]

HEAD = """import osc.standard.all

namespace null use std, stdtypes

extend vehicle:
    def doubled() -> speed is expression speed * 2.0

scenario base_of_calls:
    def limit() -> speed is undefined
    def half(v: speed, by: float = 2.0) -> speed is expression v / by

scenario calls inherits base_of_calls:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    event done
    def limit() -> speed is only expression 40kph
    def note(v: speed, text: string = "on the way") is external python(module: "notes_of_test")
    def twice(x: float) -> float is external python(module: "notes_of_test", name: "double")
"""
ALLOWED = ("notes_of_test.note", "notes_of_test.double")


@pytest.fixture
def notes(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[tuple[float, str]]]:
    """Yield what the user's module is called with."""
    folder = tmp_path / "python"
    folder.mkdir()
    (folder / "notes_of_test.py").write_text(
        "seen = []\n"
        "def note(v, text):\n"
        "    seen.append((v, text))\n"
        "def double(x):\n"
        "    if x == 1.0:\n"
        "        return 'two'\n"
        "    return 12 / (x - 3.0) * 0 + 2 * x\n",
        encoding="utf-8",
    )
    monkeypatch.syspath_prepend(folder)
    module = importlib.import_module("notes_of_test")
    yield module.seen
    del sys.modules["notes_of_test"]


@pytest.fixture
def calls(load: Load, tmp_path: Path) -> Callable[[str], type[Scenario]]:
    def compile_one(body: str) -> type[Scenario]:
        return load(emit(asam(HEAD + body, tmp_path)))

    return compile_one


BODY = """    on @done:
        call note(ego.speed, text: "done")
    do serial:
        call note(limit())
        ego.drive(duration: 1s) with:
            speed(half(limit(), by: 4.0))
        wait ego.doubled() > 15kph and twice(2.0) == 4.0
        emit done
        wait elapsed(1s)
"""


def test_methods_compute_what_they_say(
    calls: Callable[[str], type[Scenario]], notes: list[tuple[float, str]]
) -> None:
    trace = run(calls(BODY), RunSettings(allow_external=ALLOWED))
    assert trace.status == "success"
    assert trace.state("ego", 0.5)["v"] == pytest.approx(40 / 3.6 / 4)
    assert [text for _, text in notes] == ["on the way", "done"]
    assert [v for v, _ in notes] == pytest.approx([40 / 3.6, 40 / 3.6 / 4])


def test_code_of_the_user_needs_permission(
    calls: Callable[[str], type[Scenario]], notes: list[tuple[float, str]]
) -> None:
    with pytest.raises(SettingsError, match=r"--allow-external notes_of_test\.double") as error:
        run(calls(BODY), RunSettings(allow_external=ALLOWED[:1]))
    assert error.value.source == "case.osc:19"
    assert notes == []


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("3.0", "notes_of_test.double raised ZeroDivisionError"),
        ("1.0", "notes_of_test.double returns a str, not a float"),
    ],
)
def test_errors_of_the_user_name_the_method(
    calls: Callable[[str], type[Scenario]],
    notes: list[tuple[float, str]],
    value: str,
    message: str,
) -> None:
    body = f"    do serial:\n        wait twice({value}) > 1.0\n"
    with pytest.raises(ScenarioError, match=message):
        run(calls(body), RunSettings(allow_external=ALLOWED))
    assert notes == []


def test_a_function_that_is_not_there(calls: Callable[[str], type[Scenario]]) -> None:
    reason = r"no function notes_of_test\.note: ModuleNotFoundError: No module"
    with pytest.raises(ScenarioError, match=reason) as error:
        run(calls(BODY), RunSettings(allow_external=ALLOWED))
    assert error.value.source == "case.osc:18"


OWN_TYPES = """import osc.standard.all

namespace null use std, stdtypes

struct limits:
    low: speed
    high: speed = 50kph
    keep(low < high)
    def middle() -> speed is expression (low + it.high) / 2.0

actor coach inherits vehicle:
    seats: int
    keep(default seats == 30)
    def share() -> speed is expression seats * 1kph

actor long_coach inherits coach:
    def share() -> speed is only expression seats * 2kph

scenario own_types:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: coach
    other: long_coach
    l: limits with:
        keep(it.low == 10kph)
    do parallel:
        ego.drive(duration: 1s) with:
            speed(VALUE)
        other.drive()
"""


@pytest.mark.parametrize(
    ("value", "kph"),
    [
        ("l.middle()", 30),
        ("ego.share()", 30),
        ("other.share()", 60),
        ("ego.is(long_coach) ? 5kph : 6kph", 6),
        ("other.is(coach) ? 5kph : 6kph", 5),
    ],
)
def test_methods_of_own_types(load: Load, tmp_path: Path, value: str, kph: float) -> None:
    trace = run(load(emit(asam(OWN_TYPES.replace("VALUE", value), tmp_path))))
    assert trace.state("ego", 0.5)["v"] == pytest.approx(kph / 3.6)


def test_constraints_of_own_types_hold(load: Load, tmp_path: Path) -> None:
    text = OWN_TYPES.replace("VALUE", "l.middle()").replace("it.low == 10kph", "it.low == top")
    text = text.replace("    ego: coach\n", "    top: speed = 10kph\n    ego: coach\n")
    scenario = load(emit(asam(text, tmp_path)))
    assert run(scenario).state("ego", 0.5)["v"] == pytest.approx(30 / 3.6)
    with pytest.raises(ScenarioError, match=r"`l\.low < l\.high` does not hold") as error:
        run(scenario, RunSettings(set={"top": 20.0}))
    assert error.value.source == "case.osc:8"
