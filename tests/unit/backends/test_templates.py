"""Templates place ready fragments; they never compute."""

import sys
from pathlib import Path

import jinja2
import pytest
from jinja2 import nodes

from osc2tx.backends.py_trees.compiled_templates import CompiledTemplates
from osc2tx.backends.py_trees.layout import environment, template_folder

TEMPLATES = sorted(path.name for path in template_folder().glob("*.j2"))
COMPUTING = (nodes.BinExpr, nodes.UnaryExpr, nodes.Getitem, nodes.Concat, nodes.Assign)


def parse(name: str) -> nodes.Template:
    env = environment()
    assert env.loader is not None
    source, _, _ = env.loader.get_source(env, name)
    return env.parse(source)


def test_there_are_templates() -> None:
    assert "module.py.j2" in TEMPLATES


@pytest.mark.parametrize("name", TEMPLATES)
def test_no_arithmetic_subscripts_or_assignments(name: str) -> None:
    tree = parse(name)
    # `and`/`or` decide about commas; they are BinExpr in Jinja's tree, so they are let through.
    found = [
        n for n in tree.find_all(COMPUTING) if not isinstance(n, nodes.And | nodes.Or | nodes.Not)
    ]
    assert not found


@pytest.mark.parametrize("name", TEMPLATES)
def test_no_method_calls(name: str) -> None:
    called = [call.node for call in parse(name).find_all(nodes.Call)]
    assert all(isinstance(callee, nodes.Name) for callee in called)


def test_undefined_names_are_errors() -> None:
    with pytest.raises(jinja2.UndefinedError):
        environment().get_template("module.py.j2").render()


# --- Compiled ------------------------------------------------------------------------------------


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a template, in which modules would be compiled."""
    monkeypatch.setattr(sys, "dont_write_bytecode", False)
    monkeypatch.setattr(sys, "pycache_prefix", None)
    (tmp_path / "a.j2").write_text("{{ 1 }} file")
    return tmp_path


def rendered(folder: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[str, int]:
    """Render the template; return its text and how often a template was compiled for it."""
    compiled: list[str] = []
    compile_template = jinja2.Environment._compile  # type: ignore[attr-defined]

    def counted(env: jinja2.Environment, source: str, filename: str) -> object:
        compiled.append(filename)
        return compile_template(env, source, filename)

    with monkeypatch.context() as patch:
        patch.setattr(jinja2.Environment, "_compile", counted)
        loader = jinja2.FileSystemLoader(folder)
        env = jinja2.Environment(loader=loader, bytecode_cache=CompiledTemplates(folder))
        return env.get_template("a.j2").render(), len(compiled)


def test_a_template_is_compiled_once(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert rendered(folder, monkeypatch) == ("1 file", 1)
    assert [each.suffix for each in (folder / "__pycache__").iterdir()] == [".j2c"]
    assert rendered(folder, monkeypatch) == ("1 file", 0)
    (folder / "a.j2").write_text("{{ 2 }} files")
    assert rendered(folder, monkeypatch) == ("2 files", 1)
    assert rendered(folder, monkeypatch) == ("2 files", 0)


def test_nothing_is_kept_where_no_module_is(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "dont_write_bytecode", True)
    assert rendered(folder, monkeypatch) == ("1 file", 1)
    assert not (folder / "__pycache__").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="permissions of POSIX")
def test_a_compiled_template_that_others_may_write_is_not_read(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rendered(folder, monkeypatch)
    (kept,) = (folder / "__pycache__").iterdir()
    kept.chmod(0o666)
    assert rendered(folder, monkeypatch) == ("1 file", 1)
