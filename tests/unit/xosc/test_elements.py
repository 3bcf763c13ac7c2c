"""What type checkers see of the elements is what the table says."""

import runpy
from pathlib import Path
from typing import Any

import pytest

from osc2tx.xosc import elements as xml

REPOSITORY = Path(__file__).parents[3]


@pytest.fixture(scope="module")
def tool() -> dict[str, Any]:
    return runpy.run_path(str(REPOSITORY / "tools" / "make_xosc_elements.py"))


@pytest.mark.parametrize(
    ("name", "make"), [("elements.pyi", "elements"), ("literals.py", "literals")]
)
def test_the_stub_is_up_to_date(tool: dict[str, Any], name: str, make: str) -> None:
    shipped = (REPOSITORY / "osc2tx" / "xosc" / name).read_text(encoding="utf-8")
    assert tool[make]() == shipped


def test_only_elements_of_the_standard_have_a_class() -> None:
    with pytest.raises(AttributeError, match="no <Hologram>"):
        xml.Hologram  # type: ignore[attr-defined]  # noqa: B018
