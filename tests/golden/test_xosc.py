"""Golden documents: each `xosc/NAME/input.osc` is one construct, `expected/` what becomes of it.

`scenario.xosc` is the document in 1.3, if there is one, `parameters.xosc` the one with the values
of open ranges, `report.json` the loss report. `versions.txt` says which versions can say it, and
what the others lack. A first line `# osc2tx: …` of a case names options: `one_of=first`,
`profile=esmini`, `dialect=carla`, `signal=go@1s`, `allow_approx`.
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from hashlib import sha256
from pathlib import Path

import pytest

from osc2tx.backends.xosc import XmlScenario, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.config import GivenOptions
from osc2tx.options import XML_VERSIONS, XmlVersion
from tests.unit.backends.xosc.checks import checker_issues
from tests.unit.backends.xosc.documents import graded_documents, module_of
from tests.unit.backends.xosc.kept_runs import FOLDER

HERE = Path(__file__).parent / "xosc"
CASES = sorted(path.parent for path in HERE.glob("*/input.osc"))
MARK = "# osc2tx: "
Golden = Callable[[str | None, Path], None]


def given(text: str) -> GivenOptions:
    """Return the options that the first line of a case names."""
    first = text.partition("\n")[0]
    words = first.removeprefix(MARK).split() if first.startswith(MARK) else []
    pairs = dict(word.partition("=")[::2] for word in words)
    return GivenOptions(
        dialect=pairs.get("dialect"),
        one_of=pairs.get("one_of"),
        xml_profile=pairs.get("profile"),
        allow_approx=True if "allow_approx" in pairs else None,
        signal=(pairs["signal"],) if "signal" in pairs else None,
    )


@cache
def compilation_of(case: Path) -> Compilation:
    """Return the compilation of a case, under the name of its folder."""
    path = case / "input.osc"
    options = GivenOptions(target="xosc").over(given(path.read_text(encoding="utf-8")))
    return Compilation(path, f"{case.name}.osc", options.complete())


def written(case: Path, version: XmlVersion, *, allow_approx: bool = False) -> XmlScenario:
    """Return the document of the last scenario of a case."""
    compilation = compilation_of(case)
    stated = compilation.options.xml
    allowed = allow_approx or stated.allow_approx
    options = replace(stated, version=version, allow_approx=allowed)
    return graded_documents(compilation, options)[-1]


def verdict(case: Path, version: XmlVersion) -> str:
    """Return whether a version can say a case, and if not, the first reason."""
    found = written(case, version)
    if found.xml is not None:
        return "exact"
    obstacle = found.report.obstacles[0]
    return f"{obstacle.grade.value}: {obstacle.message}"


def losses(found: XmlScenario) -> list[dict[str, str]]:
    """Return what the report lists."""
    return [] if found.report_json is None else list(json.loads(found.report_json)["losses"])


def name(case: Path) -> str:
    return case.name


def test_there_are_cases() -> None:
    assert len(CASES) >= 40


@pytest.mark.parametrize("case", CASES, ids=name)
def test_the_document(case: Path, golden: Golden) -> None:
    found = written(case, "1.3")
    texts = {
        "scenario.xosc": found.xml,
        "parameters.xosc": found.parameters,
        "report.json": found.report_json,
    }
    for file, text in texts.items():
        golden(text, case / "expected" / file)


@pytest.mark.slow
@pytest.mark.parametrize("case", CASES, ids=name)
def test_which_version_can_say_it(case: Path, golden: Golden) -> None:
    lines = [f"{version}  {verdict(case, version)}\n" for version in XML_VERSIONS]
    golden("".join(lines), case / "expected" / "versions.txt")


@pytest.mark.parametrize("case", CASES, ids=name)
def test_what_is_exact_stays_so_where_approximations_are_allowed(case: Path) -> None:
    found = written(case, "1.3")
    if found.xml is not None:
        compilation = compilation_of(case)
        options = replace(compilation.options.xml, allow_approx=True)
        *_, allowed = emit(module_of(compilation), options, compilation.path.parent)
        assert (allowed.xml, allowed.parameters) == (found.xml, found.parameters)


@pytest.mark.parametrize("case", CASES, ids=name)
def test_the_quality_checker_has_no_objection(case: Path, tmp_path: Path) -> None:
    """Nor has it in other versions: `tests/xosc/test_parity.py`, which looks at all of them."""
    found = written(case, "1.3", allow_approx=True)
    for text in (found.xml, found.parameters):
        if text is not None:
            assert checker_issues(text, tmp_path) == []


def digests() -> str:
    """Return what is written for each case, as digests."""
    made = ((case, written(case, "1.3", allow_approx=True)) for case in CASES)
    texts = (
        (case.name, repr((each.xml, each.parameters, each.report_json))) for case, each in made
    )
    return "".join(f"{name} {sha256(text.encode()).hexdigest()}\n" for name, text in texts)


@pytest.mark.slow
def test_the_same_bytes_in_every_process() -> None:
    """Neither the seed of hashes nor the folder count; the other one carries out its own runs."""
    environment = {name: text for name, text in os.environ.items() if name != FOLDER}
    done = subprocess.run(
        [sys.executable, "-c", "from tests.golden import test_xosc; print(test_xosc.digests())"],
        env={**environment, "PYTHONHASHSEED": "1", "PYTHONPATH": str(Path(__file__).parents[2])},
        cwd=HERE,
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stdout == f"{digests()}\n"


@pytest.mark.parametrize("case", CASES, ids=name)
def test_reports_say_where(case: Path) -> None:
    """What is lost stands in the source, and there is a reason for it."""
    text = (case / "input.osc").read_text(encoding="utf-8")
    for loss in losses(written(case, "1.3")):
        assert loss["text"].removesuffix(" …") in text
        assert all(label in text for label in loss["within"].split("."))
        assert loss["reason"]
        assert loss["grade"] != "approximated" or loss["bound"]
