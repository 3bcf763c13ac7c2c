"""Classes inherit what scenarios inherit; runs are the same as of classes that have all of it."""

from pathlib import Path

import pytest

from benchmarks.repository import make_repository
from osc2tx import ir
from osc2tx.backends.py_trees.emitter import emit
from osc2tx.building.jobs import find_jobs
from osc2tx.compilation.driver import Memory
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.module_loading import scenarios_of_module
from osc2tx_runtime import ScenarioError
from tests.end_to_end.importing_files import classes_in, compiled, trace_of, write

HEAD = "import osc.standard.all\nnamespace null use std, stdtypes\n"

TOWN = """
scenario town:
    road: map with:
        keep(it.map_file == "crossing.xodr")
    # The car under test
    ego: vehicle with:
        keep(it.vehicle_category == car)
    v_ego: speed with:
        keep(it in [20kph..40kph])
    v_half: speed = v_ego * 0.5
    near: length = 12m
    tag: string = "none"
    event fast is rise(ego.speed > 30kph)
    cover(ego_speed, expression: ego.speed, unit: kph, range: [0..60], every: 5, event: end)
    keep(v_half < 50kph)
"""

# Scenarios, and what `declare` of the class of the last one consists of.
CASES = {
    "adds members": (
        """
scenario cruise inherits town:
    # How long
    t: time = 3s
    do go: ego.drive(duration: t) with:
        speed(v_half)
""",
        """
        super().declare()
        # How long
        self.t = self.parameter("t", 3 * s, unit="s")
""",
    ),
    "narrows a range and fixes values": (
        """
scenario cruise inherits town:
    # Fast enough
    keep(v_ego in [30kph..35kph])
    keep(near == 8m)
    keep(default tag == "y")
    do go: ego.drive(duration: 2s) with:
        speed(v_ego)
""",
        """
        # Fast enough
        self.narrow_to("v_ego", within(30 * kph, 35 * kph))
        self.fix_to("near", 8 * m)
        self.narrow_to("tag", "y")
        super().declare()
""",
    ),
    "fixes a field of an object": (
        """
scenario cruise inherits town:
    keep(ego.bounding_box.length == 4m)
    do go: ego.drive(duration: 2s) with:
        speed(v_ego)
""",
        """
        self.fix_to("ego", Vehicle(vehicle_category="car", length=4 * m))
        super().declare()
""",
    ),
    "a value that depends on others of the base": (
        """
scenario cruise inherits town:
    keep(near == 2 * v_ego * 1s)
    do go: ego.drive(duration: 2s) with:
        speed(v_ego)
""",
        """
        self.fix_to("near", lambda: 2 * self.v_ego * (1 * s))
        super().declare()
""",
    ),
    "a value that depends on a constant which the base declares below it": (
        """
scenario cruise inherits town:
    keep(v_ego == near / 1s)
    # Very near
    keep(near == 8m)
    do go: ego.drive(duration: 2s) with:
        speed(v_ego)
""",
        """
        # Very near
        self.near = 8 * m
        self.fix_to("v_ego", self.near / (1 * s))
        self.fix_to("near", self.near)
        super().declare()
""",
    ),
    "a range that depends on a new parameter": (
        """
scenario cruise inherits town:
    most: speed = 25kph
    keep(v_ego in [22kph..most])
    do go: ego.drive(duration: 2s) with:
        speed(v_ego)
""",
        """
        self.most = self.parameter("most", 25 * kph, unit="kph")
        self.narrow_to("v_ego", within(22 * kph, self.most))
        super().declare()

        self.keep(20 * kph <= self.v_ego <= 40 * kph)
""",
    ),
    "several levels, the last one counts": (
        """
scenario slow inherits town:
    keep(v_ego in [20kph..30kph])
    do go: ego.drive(duration: 2s) with:
        speed(v_ego)

scenario slower inherits slow:
    keep(v_ego in [20kph..22kph])

scenario cruise inherits slower:
    keep(v_ego == 21kph)
""",
        """
        self.fix_to("v_ego", 21 * kph)
        super().declare()
""",
    ),
    "a condition": (
        """
enum surface: [dry, wet]

scenario drive_on inherits town:
    ground: surface

scenario cruise inherits drive_on(ground == wet):
    keep(v_ego == 21kph)
    do go: ego.drive(duration: 2s) with:
        speed(v_ego)
""",
        """
        self.fix_to("v_ego", 21 * kph)
        self.fix_to("ground", "wet")
        super().declare()
""",
    ),
    "reactions beside the behavior of the base": (
        """
scenario drive inherits town:
    event seen
    do serial:
        first: ego.drive(duration: 2s) with:
            speed(v_ego)
        emit seen

scenario cruise inherits drive:
    event done
    on @seen:
        emit done
""",
        """
        super().declare()
        self.done = Event()
""",
    ),
}


def declared_in(python: str, name: str) -> str:
    """Return the body of `declare` of a class, without its docstring."""
    text = python.partition(f"class {name}(")[2].partition("\n\n\n")[0]
    body = text.partition('"""Cast, events and values')[2].partition('."""')[2]
    return body.partition("\n\n    def ")[0] + "\n"


@pytest.mark.parametrize("case", CASES)
def test_a_class_has_its_own_members(case: str, tmp_path: Path) -> None:
    source, expected = CASES[case]
    write(tmp_path, a=HEAD + TOWN + source)
    module = compiled(tmp_path / "a.osc").module
    assert module is not None
    assert declared_in(module.python, "Cruise").strip() == expected.strip()


@pytest.mark.parametrize("case", CASES)
def test_runs_are_those_of_whole_classes(case: str, tmp_path: Path) -> None:
    write(tmp_path, a=HEAD + TOWN + CASES[case][0])
    compilation = compiled(tmp_path / "a.osc")
    assert compilation.ir is not None and compilation.module is not None
    with scenarios_of_module(emit(ir.without_bases(compilation.ir))) as scenarios:
        expected = {name: trace_of(each) for name, each in scenarios.items()}
    with scenarios_of_module(compilation.module) as scenarios:
        assert "town" not in scenarios, "it has no behavior"
        found = {name: trace_of(each) for name, each in scenarios.items()}
    assert found == expected
    assert "cruise" in found


def test_a_base_in_another_file_is_imported(tmp_path: Path) -> None:
    write(tmp_path, lib__town=HEAD + TOWN)
    derived = CASES["narrows a range and fixes values"][0]
    write(tmp_path, a=f'import "lib/town.osc"\n{HEAD}{derived}')
    compilation = compiled(tmp_path / "a.osc")
    assert compilation.ir is not None and compilation.module is not None
    assert "from lib.town import Town\n" in compilation.module.python
    assert classes_in(compilation.module.python) == ["Cruise"]
    with scenarios_of_module(emit(ir.without_bases(compilation.ir))) as scenarios:
        expected = trace_of(scenarios["cruise"])
    with scenarios_of_module(compilation.module, sibling_modules(compilation)) as scenarios:
        assert trace_of(scenarios["cruise"]) == expected


def test_a_base_whose_file_leaves_a_field_open_is_imported(tmp_path: Path) -> None:
    """Only the importing file mentions the field: the class of the base does without it."""
    base = "struct case:\n    id: string\n\nscenario straight inherits town:\n    about: case\n"
    derived = """
scenario cruise inherits straight:
    keep(about.id == "REQ-7")
    do go: ego.drive(duration: 2s) with:
        speed(v_ego)

scenario open inherits straight:
    is_known: bool = (about.id != "")
    do go: ego.drive(duration: 2s) with:
        speed(v_ego)
"""
    write(tmp_path, lib__town=HEAD + TOWN + "\n" + base)
    write(tmp_path, a=f'import "lib/town.osc"\n{HEAD}{derived}')
    compilation = compiled(tmp_path / "a.osc")
    assert compilation.module is not None
    assert classes_in(compilation.module.python) == ["Cruise", "Open"]
    assert 'self.fix_to("about", Case(id="REQ-7"))' in compilation.module.python
    assert 'self.required("about.id", str)' in compilation.module.python
    with scenarios_of_module(compilation.module, sibling_modules(compilation)) as scenarios:
        assert trace_of(scenarios["cruise"])


def test_a_field_that_invoking_files_read_is_required(tmp_path: Path) -> None:
    base = "struct case:\n    v: speed\n\nscenario straight inherits town:\n    about: case\n"
    base += "    do go: ego.drive(duration: 1s)\n"
    top = "\nscenario top:\n    other: vehicle\n    do serial:\n        x: straight()\n"
    top += "        other.drive(duration: 1s) with:\n            speed(x.about.v)\n"
    write(tmp_path, lib__town=HEAD + TOWN + "\n" + base)
    write(tmp_path, a=f'import "lib/town.osc"\n{HEAD}{top}')
    compilation = compiled(tmp_path / "a.osc")
    assert compilation.module is not None
    siblings = sibling_modules(compilation)
    refused = pytest.raises(ScenarioError, match=r"leaves x\.about\.v open")
    with scenarios_of_module(compilation.module, siblings) as scenarios, refused:
        trace_of(scenarios["top"])


def test_a_repository_runs_as_whole_classes_do(tmp_path: Path) -> None:
    """Two scenarios of each family: bases and moves of libraries, fixed and open values."""
    make_repository(tmp_path, 16)
    memory: Memory = {}
    derived = 0
    for job in find_jobs([tmp_path / "scenarios"], GivenOptions(), ConfigFiles()):
        compilation = job.compilation(memory)
        if compilation.ir is None or compilation.module is None:
            continue
        with scenarios_of_module(emit(ir.without_bases(compilation.ir))) as scenarios:
            expected = {name: trace_of(each) for name, each in scenarios.items()}
        siblings = sibling_modules(compilation)
        with scenarios_of_module(compilation.module, siblings) as scenarios:
            for name, each in scenarios.items():
                assert trace_of(each) == expected[name], name
        derived += sum(bool(each.base) for each in compilation.ir.scenarios)
    assert derived >= 16


def test_an_edit_of_the_base_changes_the_module_of_the_base(tmp_path: Path) -> None:
    write(tmp_path, lib__town=HEAD + TOWN)
    write(tmp_path, a=f'import "lib/town.osc"\n{HEAD}{CASES["adds members"][0]}')
    before = compiled(tmp_path / "a.osc").module
    write(tmp_path, lib__town=HEAD + TOWN.replace("[20kph..40kph]", "[10kph..40kph]"))
    after = compiled(tmp_path / "a.osc").module
    assert before is not None and after is not None
    assert after.python == before.python


def test_a_range_of_the_base_is_not_stated_again_for_what_is_known(tmp_path: Path) -> None:
    """Also of a value that follows from one which the base declares below it."""
    own = "a value that depends on a constant which the base declares below it"
    write(tmp_path, lib__town=HEAD + TOWN)
    write(tmp_path, a=f'import "lib/town.osc"\n{HEAD}{CASES[own][0]}')
    before = compiled(tmp_path / "a.osc").module
    write(tmp_path, lib__town=HEAD + TOWN.replace("[20kph..40kph]", "[10kph..40kph]"))
    after = compiled(tmp_path / "a.osc").module
    assert before is not None and after is not None
    assert after.python == before.python


LATER = """
scenario pair:
    ego: vehicle
    a: length with:
        keep(it in [1m..5m])
    b: length with:
        keep(it in [1m..9m])

scenario cruise inherits pair:
    keep(a == b + 1m)
    do ego.drive(duration: 1s) with:
        speed(20kph)
"""


def test_a_class_stands_for_itself_if_its_base_cannot_come_first(tmp_path: Path) -> None:
    """`a` is computed from `b`, which the base declares below it."""
    write(tmp_path, a=HEAD + LATER)
    module = compiled(tmp_path / "a.osc").module
    assert module is not None
    assert "class Cruise(Scenario):" in module.python
    assert "self.a = self.b + 1 * m" in module.python


def test_a_scenario_without_behavior_cannot_run(tmp_path: Path) -> None:
    write(tmp_path, a=HEAD + TOWN)
    compilation = compiled(tmp_path / "a.osc")
    assert compilation.module is not None
    assert "create_root" not in compilation.module.python
    with scenarios_of_module(compilation.module) as scenarios:
        assert scenarios == {}
