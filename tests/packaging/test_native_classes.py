"""Value classes that are written out for mypyc are what the decorator makes of them."""

import ast
import importlib.util
import pickle
import sys
from collections.abc import Iterator
from dataclasses import fields
from pathlib import Path
from types import ModuleType

import pytest

from osc2tx_shared.classes import replace
from tools.native_classes import compiled_modules, rewrite

ROOT = Path(__file__).parents[2]
SETTINGS = """\
[tool.hatch.build.targets.wheel.hooks.custom]
include = ["osc2tx/written/*.py"]
exclude = []
"""
HEAD = """\
from __future__ import annotations
from dataclasses import field
from osc2tx_shared.classes import dataclass
"""
BASE = """\
DEFAULT = 7
class Unit: pass
@dataclass(slots=True, kw_only=True, eq=False)
class Base:
    '''The base.'''
    unit: Unit | None = None
    number: int = DEFAULT
    def double(self) -> int:
        return 2 * self.number
"""
USE = """\
from {package}.base import Base
@dataclass(slots=True)
class Derived(Base):
    name: str
    # Made for each.
    names: list[str] = field(default_factory=list, repr=False)
    memo: int = field(default=0, compare=False, init=False)
@dataclass(slots=True)
class Checked:
    number: int
    def __post_init__(self) -> None:
        if self.number < 0:
            raise ValueError(self.number)
@dataclass(frozen=True, slots=True)
class Fixed:
    first: int
    second: str = ""
@dataclass(frozen=True)
class Kept:
    number: int
    def names(self) -> list[str]:
        return list(self.__dict__)
class Text(str): pass
"""


@pytest.fixture
def modules(tmp_path: Path) -> Iterator[tuple[ModuleType, ModuleType, str]]:
    """Return the classes with the decorator, those written out, and the text of the latter."""
    (tmp_path / "pyproject.toml").write_text(SETTINGS, "utf-8")
    for folder in ("decorated", "written"):
        package = tmp_path / "osc2tx" / folder
        package.mkdir(parents=True)
        (package / "base.py").write_text(HEAD + BASE, "utf-8")
        (package / "use.py").write_text(HEAD + USE.format(package=f"osc2tx.{folder}"), "utf-8")
    rewrite(tmp_path)
    before = dict(sys.modules)
    made = []
    for folder in ("decorated", "written"):
        for stem in ("base", "use"):
            name = f"osc2tx.{folder}.{stem}"
            path = tmp_path / "osc2tx" / folder / f"{stem}.py"
            spec = importlib.util.spec_from_file_location(name, path)
            assert spec is not None and spec.loader is not None
            sys.modules[name] = importlib.util.module_from_spec(spec)
            spec.loader.exec_module(sys.modules[name])
        made.append(sys.modules[name])
    yield made[0], made[1], path.read_text("utf-8")
    for name in sys.modules.keys() - before.keys():
        del sys.modules[name]


def test_the_decorator_is_gone(modules: tuple[ModuleType, ModuleType, str]) -> None:
    _decorated, written, text = modules
    assert "__init__" in vars(written.Derived)
    assert text.count("@dataclass") == 1, "the one that needs a __dict__"
    assert "@mypyc_attr(native_class=False)\n@dataclass(frozen=True)\nclass Kept" in text
    assert "@mypyc_attr(native_class=False)\nclass Text(str)" in text


def test_constructors_are_the_same(modules: tuple[ModuleType, ModuleType, str]) -> None:
    said = []
    for module in modules[:2]:
        one, other = module.Derived("a"), module.Derived("b", ["c"], number=3)
        assert one.names is not module.Derived("a").names
        said.append((repr(one), repr(other), other.names, one.memo, other.double()))
        with pytest.raises(TypeError):
            module.Derived("a", [], 3)
        with pytest.raises(ValueError, match="-1"):
            module.Checked(-1)
    assert said[0] == said[1]


def test_comparison_and_fields_are_the_same(modules: tuple[ModuleType, ModuleType, str]) -> None:
    for module in modules[:2]:
        one = module.Derived("a")
        changed = module.Derived("a")
        changed.memo = 5
        assert one == changed
        assert one != replace(one, number=8)
        assert one != module.Checked(1)
        assert module.Derived.__hash__ is None
        assert [each.name for each in fields(one)] == ["unit", "number", "name", "names", "memo"]
        assert [each.type for each in fields(one)][:2] == ["Unit | None", "int"]
        assert pickle.loads(pickle.dumps(changed)).memo == 5


def test_a_frozen_class_is_hashed_by_its_fields(
    modules: tuple[ModuleType, ModuleType, str],
) -> None:
    text = modules[2]
    assert "return hash((self.first, self.second))" in text
    assert "return self.first == other.first and self.second == other.second" in text
    assert "frozen=True" in text


def test_the_build_compiles_what_it_says() -> None:
    found = compiled_modules(ROOT)
    assert "osc2tx/semantics/symbols.py" in found
    assert "osc2tx/syntax/_antlr/OpenSCENARIO2.py" in found
    assert "osc2tx/syntax/packed_ast.py" not in found


def test_no_compiled_module_has_a_cached_property() -> None:
    """mypyc makes a plain property of it: what is asked often is computed each time."""
    found = [
        path
        for path in compiled_modules(ROOT)
        if "@cached_property" in (ROOT / path).read_text("utf-8")
    ]
    assert not found


def test_no_compiled_module_looks_into_a_tuple_with_unpacked_parts() -> None:
    """mypyc ends with an internal error at `x in (*some, other)`."""
    found = [
        f"{path}:{node.lineno}"
        for path in compiled_modules(ROOT)
        for node in ast.walk(ast.parse((ROOT / path).read_text("utf-8")))
        if isinstance(node, ast.Compare)
        and any(isinstance(operator, ast.In | ast.NotIn) for operator in node.ops)
        and any(
            isinstance(part, ast.Starred)
            for place in node.comparators
            if isinstance(place, ast.Tuple | ast.List)
            for part in place.elts
        )
    ]
    assert not found
