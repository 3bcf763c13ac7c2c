"""The page of codes is the registry's."""

import runpy
from pathlib import Path

from osc2tx.diagnostics import CODES
from osc2tx.diagnostics.codes import find_code, meant_code

REPOSITORY = Path(__file__).parents[3]


def test_the_page_is_up_to_date() -> None:
    tool = runpy.run_path(str(REPOSITORY / "tools/make_diagnostics_doc.py"))
    page = (REPOSITORY / "docs/diagnostics.md").read_text(encoding="utf-8")
    assert tool["render"]() == page, "run `make docs-diagnostics`"


def test_the_page_has_an_anchor_for_each_code() -> None:
    page = (REPOSITORY / "docs/diagnostics.md").read_text(encoding="utf-8")
    for code in CODES:
        assert page.count(f'<a id="{code.lower()}"></a>') == 1


def test_slugs_name_one_code() -> None:
    assert len({entry.slug for entry in CODES.values()}) == len(CODES)
    for entry in CODES.values():
        assert find_code(entry.code.lower()) is find_code(entry.slug.upper()) is entry


def test_what_was_meant() -> None:
    assert meant_code("0SC202") == "OSC202"
    assert meant_code("unknwon-type") == "unknown-type"
    assert meant_code("zzz") is None
