"""No argument of an action or modifier of motion is refused without need, or fails its run."""

from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.catalogue import catalogue
from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import Severity
from osc2tx.options import CompileOptions
from osc2tx_runtime import RunSettings, Scenario, run_scenario

Load = Callable[[GeneratedModule], type[Scenario]]
MOTION = ("movable_object.", "vehicle.", "person.walk")
WITHOUT_MOTION = {"connect_trailer", "disconnect_trailer", "set_lights"}
OPTIONS = CompileOptions(standard="2.2")


def texts_of(name: str) -> str:
    return (Path(__file__).parent / "motion" / f"{name}.txt").read_text(encoding="utf-8")


TYPES, CAST = texts_of("types"), texts_of("scenario")
TABLE = [
    [column.strip() for column in line.split("|")]
    for line in texts_of("arguments").splitlines()
    if line and not line.startswith("#")
]
ROWS = [row for row in TABLE if len(row) == 3]
REFUSED = [row for row in TABLE if len(row) == 4]


def scenario(name: str, statement: str) -> str:
    """The scenario of a row."""
    indent = " " * 12
    parts = statement.split("; ")
    lines: list[str] = []
    for part in parts:
        head, found, modifier = part.partition(" with: ")
        inside = bool(lines) and " with:" in "".join(lines) and "." not in part.partition("(")[0]
        lines.append(f"    {part}" if inside else head + (" with:" if found else ""))
        if found:
            lines.append(f"    {modifier}")
    return CAST.format(name=name, statement=f"\n{indent}".join(lines))


@cache
def modules(folder: Path) -> Compilation:
    """One file with the scenarios of all rows."""
    path = folder / "motion.osc"
    texts = (scenario(f"row_{i}", statement) for i, (_, _, statement) in enumerate(ROWS))
    path.write_text(TYPES + "".join(texts), encoding="utf-8")
    return Compilation(path, path.name, OPTIONS)


@pytest.fixture(scope="module")
def classes(tmp_path_factory: pytest.TempPathFactory, load: Load) -> dict[str, type[Scenario]]:
    compilation = modules(tmp_path_factory.mktemp("motion"))
    assert compilation.ir is not None, [
        d for d in compilation.diagnostics if d.severity is Severity.ERROR
    ]
    found = load(emit(compilation.ir))
    module = __import__(found.__module__)
    return {
        value.name: value
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, Scenario) and not value.is_abstract()
    }


@pytest.mark.slow
@pytest.mark.parametrize("row", range(len(ROWS)), ids=lambda i: f"{ROWS[i][0]}-{i}")
def test_it_is_carried_out(row: int, classes: dict[str, type[Scenario]]) -> None:
    result = run_scenario(classes[f"row_{row}"], RunSettings(max_time=20.0, seed=row))
    assert (result.status, result.reason) == ("success", ""), ROWS[row][2]


@pytest.mark.parametrize("row", REFUSED, ids=lambda row: row[0])
def test_it_is_refused(row: list[str], tmp_path: Path) -> None:
    path = tmp_path / "case.osc"
    path.write_text(TYPES + scenario("row", row[2]), encoding="utf-8")
    compilation = Compilation(path, path.name, OPTIONS)
    assert compilation.module is None
    codes = [d.code for d in compilation.diagnostics if d.severity is Severity.ERROR]
    assert codes == [row[3]]


def test_every_argument_has_a_row() -> None:
    """All that the runtime lists for motion is tried."""
    library = catalogue()
    wanted = {
        (name.partition(".")[2], argument)
        for name, entry in library.actions.items()
        if name.startswith(MOTION)
        for argument in entry.arguments
    }
    wanted |= {
        (name, argument)
        for name in {name for name, *_ in ROWS} & set(library.modifiers)
        for argument in library.modifiers[name].parameters
        if (name, argument) not in DIALECT
    }
    tried = {(name, each) for name, arguments, *_ in TABLE for each in arguments.split()}
    assert not {pair for pair in wanted - tried if pair[0] not in WITHOUT_MOTION}


DIALECT = {
    *(("position", each) for each in ("x", "y", "z", "h", "frame")),
    *(("speed", each) for each in ("rate_profile", "rate_peak")),
}
"""Parameters of the dialect `carla`."""
