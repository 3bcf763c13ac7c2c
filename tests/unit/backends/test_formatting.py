"""The text of a module is what black makes of it, and black passes over it no more than it must."""

from collections.abc import Callable

import black
import pytest

from osc2tx.backends.py_trees.formatting import LINE_LENGTH, format_module
from osc2tx.diagnostics import InternalCompilerError

MODE = black.Mode(line_length=LINE_LENGTH, target_versions={black.TargetVersion.PY311})
LONG = ", ".join(f"argument_{n}=value.of('{n}')" for n in range(6))

TEXTS = {
    "white space and quotes": ("x = f(\n'a',\n  'b'\n)\n", 1),
    "a comma that stays": (f"x = f(\n{LONG},\n)\n", 1),
    "a comma that black adds": (f"x = f({LONG})\n", 2),
    "parentheses that go": ("from a import (b, c)\n", 2),
    "in its style already": ('x = f("a")\n', 1),
}


@pytest.fixture
def passes(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The texts that black's two-pass function is asked for."""
    found: list[str] = []
    both: Callable[..., str] = black.format_str

    def noted(text: str, *, mode: black.Mode) -> str:
        found.append(text)
        return both(text, mode=mode)

    monkeypatch.setattr(black, "format_str", noted)
    return found


@pytest.mark.parametrize("name", TEXTS)
def test_as_black_does_it(name: str, passes: list[str]) -> None:
    text, count = TEXTS[name]
    formatted = format_module(text)
    assert len(passes) == count - 1
    assert formatted == black.format_str(text, mode=MODE)


def test_without_that_function_of_black(monkeypatch: pytest.MonkeyPatch) -> None:
    text, _ = TEXTS["a comma that black adds"]
    expected = format_module(text)
    monkeypatch.delattr(black, "_format_str_once")
    assert format_module(text) == expected


def test_what_is_no_python_is_a_bug() -> None:
    with pytest.raises(InternalCompilerError):
        format_module("def def\n")
