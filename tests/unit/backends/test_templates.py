"""Templates place ready fragments; they never compute."""

import jinja2
import pytest
from jinja2 import nodes

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
