"""Units: our factors and pint agree."""

import math
import subprocess
import sys

import pytest

from osc2tx.semantics import SemanticModel
from osc2tx.semantics.declarations.library import shared_library
from osc2tx.semantics.symbols import UnitSymbol
from osc2tx.semantics.units import to_si, to_si_with_pint
from osc2tx.syntax import ast
from tests.unit.semantics.support import build_text

UNITS = sorted(shared_library("2.1", "asam", "all").scope.all_units(), key=lambda unit: unit.name)


def only_unit(model: SemanticModel) -> tuple[ast.PhysicalLiteral, UnitSymbol]:
    return next(
        (literal, unit)
        for literal, unit in model.units.items()
        if literal.span.source is model.root.span.source
    )


@pytest.mark.parametrize("value", [0.0, 1.0, -3.25, 35.0, 12.42])
def test_pint_agrees_on_every_unit(value: float) -> None:
    for unit in UNITS:
        assert math.isclose(
            to_si(value, unit), to_si_with_pint(value, unit), rel_tol=1e-12, abs_tol=1e-12
        ), unit.name


@pytest.mark.parametrize(
    ("text", "expected"),
    [("35kph", 35 / 3.6), ("20celsius", 293.15), ("90deg", math.pi / 2), ("1mph", 0.44704)],
)
def test_values_in_si(text: str, expected: float) -> None:
    model, sink = build_text(f"import osc.standard\n\nscenario s:\n    keep({text} == {text})\n")
    assert not sink.has_errors
    literal, unit = only_unit(model)
    assert math.isclose(to_si(literal.value, unit), expected, rel_tol=1e-9)


def test_units_of_the_program_go_through_pint() -> None:
    model, sink = build_text(
        "type speed is SI(m: 1, s: -1)\n"
        "unit |km/h| of speed is SI(m: 1, s: -1, factor: 0.25, offset: 1.5)\n\n"
        "struct s:\n    v: speed = 10|km/h|\n"
    )
    assert not sink.has_errors
    literal, unit = only_unit(model)
    assert to_si(literal.value, unit) == 4.0


def test_checking_does_not_load_pint() -> None:
    program = (
        "import sys\n"
        "from tests.unit.semantics.support import build_text\n"
        "build_text('import osc.standard\\n\\nscenario s:\\n    v: speed = 3kph\\n')\n"
        "sys.exit('pint' in sys.modules or 'numpy' in sys.modules)\n"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
