"""Of a module's statements black is asked for those that it may write otherwise, and no others."""

import re
import tomllib
from collections.abc import Callable
from pathlib import Path

import black
import pytest

from osc2tx.backends.py_trees.formatting import LINE_LENGTH, format_module
from osc2tx.diagnostics import InternalCompilerError

MODE = black.Mode(line_length=LINE_LENGTH, target_versions={black.TargetVersion.PY311})
ROOT = Path(__file__).parents[3]
LONG = ", ".join(f"argument_{n}=value.of({n})" for n in range(6))

TEXTS = {
    "in its style already": ('x = f("a")\n', 0),
    "quotes": ("x = 'a'\ny = 'b'\nz = 1\n", 2),
    "a comma that stays": ("x = f(a,)\n", 1),
    "a comma that black adds": (f"x = f({LONG})\n", 1),
    "characters of two columns": (f'x = f("{"字" * 40}", "{"字" * 6}")\n', 1),
    "a long line in a method": (f"class A:\n    def f(self):\n        return f({LONG})\n", 1),
    "a long signature": (f"class A:\n    def f(self, *, {LONG}):\n        return [0, 1]\n", 1),
    "a decorated class": (f"@f({LONG})\nclass A:\n    x = 'a'\n", 1),
    "a slice": ("x = a[b + 1:c]\n", 1),
    "a part beside a comment": ("x = f(\n    # why\n    -3.5 * kph\n)\n", 1),
    "comments of any length": (f"# '{LONG}'\nx = f(\n    # '{LONG}'\n    a,\n)\n", 0),
    "a docstring": (f'class A:\n    """Do not: \'{LONG}\'.\n\n    {LONG}\n    """\n', 0),
    "an indented docstring": ('class A:\n    """A.\n        b\n    """\n', 1),
}


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The texts that black is asked for."""
    found: list[str] = []
    format_str: Callable[..., str] = black.format_str

    def noted(text: str, *, mode: black.Mode) -> str:
        found.append(text)
        return format_str(text, mode=mode)

    monkeypatch.setattr(black, "format_str", noted)
    return found


@pytest.mark.parametrize("name", TEXTS)
def test_as_black_does_it(name: str, asked: list[str]) -> None:
    text, count = TEXTS[name]
    formatted = format_module(text)
    assert len(asked) == count
    assert formatted == black.format_str(text, mode=MODE)


def test_lint_asks_black_for_what_is_committed() -> None:
    """`make lint` looks at all modules; that takes as long as many tests."""
    modules = [*ROOT.glob("generated/**/*.py"), *ROOT.glob("tests/golden/py_trees/*/expected/*.py")]
    assert len(modules) > 100
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["black"]
    assert settings.pop("line-length") == LINE_LENGTH
    excluded = re.compile(settings.pop("extend-exclude"))
    assert settings == {}
    assert not [path for path in modules if excluded.search(path.as_posix())]


def test_what_is_no_python_is_a_bug() -> None:
    with pytest.raises(InternalCompilerError):
        format_module("def def\n")
