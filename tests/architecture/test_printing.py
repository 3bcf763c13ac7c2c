"""All that is printed goes through `osc2tx_shared.text`, which cleans it."""

import ast

from tests.architecture.module_graph import COMPILER, REPOSITORY, RUNTIME, files_of

RULES = RUNTIME.parent / "osc2tx_shared" / "rules"
FILES = files_of(COMPILER) + files_of(RUNTIME) + files_of(RULES)
PRINTS = {"print", "echo", "secho", "pprint", "print_exc", "print_exception", "print_stack"}
STREAMS = {"stdout", "stderr", "__stdout__", "__stderr__"}


def prints(tree: ast.AST) -> list[int]:
    """Return the lines of calls that print, and of what is done with standard streams."""
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            name = getattr(node.func, "id", getattr(node.func, "attr", ""))
            found += [node.lineno] * (name in PRINTS)
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Attribute):
            is_stream = getattr(node.value.value, "id", "") == "sys" and node.value.attr in STREAMS
            found += [node.lineno] * is_stream
    return found


def test_nothing_else_prints() -> None:
    trees = ((path, ast.parse(path.read_text(encoding="utf-8"))) for path in FILES)
    found = {path.relative_to(REPOSITORY).as_posix(): prints(tree) for path, tree in trees}
    assert {path: lines for path, lines in found.items() if lines} == {}


def test_a_module_that_prints_is_found() -> None:
    text = "print(1)\nclick.echo(2)\nsys.stdout.write('3')\nsay('4')\n"
    assert prints(ast.parse(text)) == [1, 2, 3]
