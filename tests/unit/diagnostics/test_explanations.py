"""What is said about the codes is true: the examples are compiled."""

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from osc2tx.cli import cli
from osc2tx.cli.reporting import Session
from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import CODES, Severity
from osc2tx.diagnostics.codes import Explanation
from osc2tx.options import CompileOptions
from osc2tx_runtime.errors import NOT_MET, PARTLY_MET, RUN_FAILED, ScenarioError

PRELUDE = "import osc.standard.all\n\nnamespace null use std, stdtypes\n\n"
WITHOUT_TEXT = {
    "OSC101",
    "OSC105",
    "OSC115",
    "OSC324",
    "OSC517",
    "OSC518",
    "OSC804",
    "OSC805",
    "OSC806",
    "OSC807",
    "OSC808",
}  # too long to write down, or not about a text


def codes_of(explanation: Explanation, text: str, folder: Path) -> dict[str, Severity]:
    """Return what the compiler says about an example, without the two lines all of them need."""
    is_whole = "import" in text or "namespace" in text
    (folder / "limits.osc").touch()  # one example imports it
    path = folder / "example.osc"
    path.write_text(text if is_whole else PRELUDE + text, encoding="utf-8")
    options = CompileOptions(
        explanation.standard,  # type: ignore[arg-type]
        explanation.dialect,  # type: ignore[arg-type]
        target=explanation.target,  # type: ignore[arg-type]
    )
    compilation = Compilation(path, path.name, options)
    compilation.check()
    return {report.code: report.severity for report in compilation.diagnostics}


def codes_of_run(explanation: Explanation, text: str, folder: Path) -> dict[str, Severity]:
    """Return the codes of a run of an example: of the error that ends it, and of warnings."""
    path = folder / "example.osc"
    path.write_text(PRELUDE + text, encoding="utf-8")
    said = CliRunner().invoke(cli, ["run", str(path)], standalone_mode=False, obj=Session())
    line = rf"^ *{re.escape(str(path))}:\d+:\d+: (error|warning)\[(OSC\d+)\]"
    found = {code: Severity(severity) for severity, code in re.findall(line, said.output, re.M)}
    assert (said.return_value == 0) == (Severity.ERROR not in found.values()), said.output
    return found


def test_errors_of_runs_have_codes() -> None:
    kinds = [ScenarioError, *ScenarioError.__subclasses__()]
    own = {kind.code for kind in kinds if kind.__module__ == ScenarioError.__module__}
    assert sorted(own | {RUN_FAILED, NOT_MET, PARTLY_MET}) == [
        code for code in CODES if code.startswith("OSC8")
    ]


def test_a_code_has_an_example_and_a_remedy() -> None:
    for code, known in CODES.items():
        explanation = known.explanation
        assert explanation is not None, f"write a section [{code}] in osc2tx/diagnostics/texts"
        assert explanation.remedy.endswith("."), code
        assert explanation.faulty.strip(), code
        assert explanation.fixed.strip() or code in WITHOUT_TEXT, code


EXAMPLES = sorted(set(CODES) - WITHOUT_TEXT)


@pytest.mark.parametrize("code", EXAMPLES)
def test_the_faulty_text_shows_the_code_and_the_mended_does_not(code: str, tmp_path: Path) -> None:
    explanation = CODES[code].explanation
    assert explanation is not None
    find = codes_of_run if code.startswith("OSC8") else codes_of
    shown = find(explanation, explanation.faulty, tmp_path)
    assert code in shown
    assert errors(shown, code) <= {code}
    left = find(explanation, explanation.fixed, tmp_path)
    assert code not in left
    assert not errors(left, code)


def errors(found: dict[str, Severity], code: str) -> set[str]:
    """Return the errors; those of the backend count only in the examples about it."""
    family = "OSC5" if not code.startswith("OSC5") else "none"
    return {
        name
        for name, severity in found.items()
        if severity is Severity.ERROR and not name.startswith(family)
    }


def test_the_files_hold_no_other_codes() -> None:
    import tomllib

    folder = Path(__file__).parents[3] / "osc2tx/diagnostics/texts"
    for path in folder.iterdir():
        for code in tomllib.loads(path.read_text(encoding="utf-8")):
            assert code in CODES
            assert path.name == f"{code[3]}xx.toml"
