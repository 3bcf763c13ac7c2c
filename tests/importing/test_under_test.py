"""Actors with controllers are systems under test: the report says so, and `--ego` drives them."""

import json
from pathlib import Path

import pytest

from tests.importing.documents import at_time, document, event, imported, speed_change
from tests.importing.test_command import command, written

CONTROLLER = '<Controller name="Alks"><Properties/></Controller>'
OBJECT_CONTROLLER = f"<ObjectController>{CONTROLLER}</ObjectController>"
ASSIGNED = f"""<ControllerAction><AssignControllerAction>{CONTROLLER}</AssignControllerAction>
  </ControllerAction>"""
ACTIVATED = '<ControllerAction><ActivateControllerAction longitudinal="{}"/></ControllerAction>'
DRIVER = """from osc2tx_runtime import Control

class Braking:
    def step(self, seen, dt):
        return Control(acceleration=-1.0)
"""


def with_object_controller(text: str) -> str:
    return text.replace(
        "</Vehicle></ScenarioObject>", f"</Vehicle>{OBJECT_CONTROLLER}</ScenarioObject>", 1
    )


@pytest.mark.parametrize(
    ("action", "under_test"),
    [
        (ASSIGNED, ["other"]),
        (ACTIVATED.format("true"), ["other"]),
        (ACTIVATED.format("false"), []),
        (speed_change("20"), []),
    ],
)
def test_controllers_in_the_run(action: str, under_test: list[str]) -> None:
    found = imported(document(event("Given", action, at_time("1"))))
    assert json.loads(found.report.to_json())["under_test"] == under_test


def test_a_controller_of_an_entity() -> None:
    found = imported(with_object_controller(document("")))
    assert json.loads(found.report.to_json())["under_test"] == ["ego"]


def speeds(trace: Path, actor: str) -> dict[float, float]:
    """Return the speeds of an actor by their times."""
    lines = map(json.loads, trace.read_text(encoding="utf-8").splitlines())
    return {
        line["t"]: line["v"] for line in lines if line["kind"] == "state" and line["actor"] == actor
    }


def test_a_driver_drives_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It starts at the place and speed of the document, and brakes by 1 m/s^2 from there."""
    written(tmp_path, "my_drivers.py", DRIVER)
    monkeypatch.syspath_prepend(tmp_path)
    faster = event("Faster", speed_change("20", "5"), at_time("1"))
    source = written(tmp_path, "two_cars.xosc", with_object_controller(document(faster)))
    result = command("import", source, "-o", tmp_path)
    assert result.return_value == 0
    assert "under test: ego" in result.output
    assert "--ego ego=MODULE:CLASS" in result.output
    scenario, trace = tmp_path / "two_cars.osc", tmp_path / "trace.jsonl"
    words = ("run", scenario, "--expect", "--ego", "ego=my_drivers:Braking", "--trace", trace)
    result = command(*words)
    assert result.return_value == 0, result.output
    ego = speeds(trace, "ego")
    assert (ego[0.0], ego[4.0], ego[10.0]) == pytest.approx((20.0, 16.0, 10.0))
    assert speeds(trace, "other")[7.0] == pytest.approx(20.0)


def test_nothing_else_is_commanded_of_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What the document asks of the actor later is expected of the driver, which does not do it."""
    written(tmp_path, "my_other_drivers.py", DRIVER)
    monkeypatch.syspath_prepend(tmp_path)
    text = document(event("Faster", speed_change("25", "5"), at_time("1")))
    source = written(tmp_path, "two_cars.xosc", text)
    assert command("import", source, "-o", tmp_path).return_value == 0
    words = ("run", tmp_path / "two_cars.osc", "--ego", "other=my_other_drivers:Braking")
    result = command(*words)
    assert result.return_value != 0
    assert "other change_speed: other is under external control" in result.output
