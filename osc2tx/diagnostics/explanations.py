"""Explanations of codes: a faulty text and how to fix it.

The texts are data, one file for each family of codes in `texts/`, and are only read when somebody
asks. A test compiles all of them: the faulty text shows the code, the fixed text does not.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from osc2tx_classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Explanation:
    """An example of a mistake.

    Attributes:
        remedy: What to do, one or two sentences.
        faulty: A source text with the mistake.
        fixed: The same text without it; empty where the mistake is not in the text.
        standard: Version of the standard that the example is about.
        dialect: Its dialect.
        target: What is made of it; some codes are only about one target.
    """

    remedy: str
    faulty: str
    fixed: str = ""
    standard: str = "2.1"
    dialect: str = "asam"
    target: str = "all"

    @property
    def options(self) -> str:
        """The options with which the example shows the code, as on the command line."""
        standard = f"--std {self.standard}" if self.standard != "2.1" else ""
        dialect = f"--dialect {self.dialect}" if self.dialect != "asam" else ""
        target = f"--target {self.target}" if self.target != "all" else ""
        return " ".join(option for option in (standard, dialect, target) if option)


def explanation_of(code: str) -> Explanation | None:
    """Return the explanation of a code; `None` if nobody has written one."""
    found = _family(code[3:4]).get(code)
    return None if found is None else Explanation(**found)


@cache
def _family(digit: str) -> Mapping[str, Mapping[str, Any]]:
    import tomllib  # only needed when somebody asks
    from importlib.resources import files

    path = files("osc2tx.diagnostics") / "texts" / f"{digit}xx.toml"
    return tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}
