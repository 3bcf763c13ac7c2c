"""Writes the actions of the library as typed methods: `osc2tx_runtime/domain/methods/`.

A file for each kind of actors, read from the registry: signature and docstring of the class that
carries an action out, and the modifiers that it takes; the section of the standard is from the
catalogue. A test compares.
"""

from __future__ import annotations

import ast
import builtins
import inspect
import re
import sys
import textwrap
from collections.abc import Iterator, Sequence
from importlib import import_module
from pathlib import Path
from typing import Any, get_args, get_origin

import black

from osc2tx.backends.py_trees.naming import class_name
from osc2tx.catalogue import catalogue
from osc2tx_runtime.domain.actions.movement.modifiable import ModifiableAction
from osc2tx_runtime.domain.modifiers import MODIFIERS as KINDS
from osc2tx_runtime.domain.modifiers import groups
from osc2tx_runtime.language.actions.registry import Method, methods

FOLDER = Path(__file__).parents[1] / "runtime_lib/osc2tx_runtime/domain/methods"
MADE = "made by tools/make_actor_methods.py"

STARTS = "StartModifier"
"""Modifiers that actions take `at: start` alone."""

GROUPS: dict[str, tuple[type, ...]] = {
    name: get_args(getattr(groups, name))
    for name in ("SpeedModifier", "SideModifier", "TurnModifier", "PathModifier", STARTS)
}
"""Modifiers that actions take together."""

WIDTH = 92  # of docstrings in methods
ENTRY = r"    (\*{0,2}\w+):"
"""Begin of an entry for an argument in a docstring."""

Imports = dict[str, set[str]]
"""Modules to the names that a file takes of them."""


def render() -> dict[Path, str]:
    """Return the texts of all files."""
    starting = {kind for kind in KINDS.values() if kind.facts.rules.starts}
    if starting != set(GROUPS[STARTS]):
        sys.exit(f"{STARTS} are others: {sorted(kind.__name__ for kind in starting)}")
    kinds = sorted({method.kind for method in methods.all()})
    return {FOLDER / f"{kind}.py": _methods_of(kind) for kind in kinds}


def _methods_of(kind: str) -> str:
    found = [method for method in methods.all() if method.kind == kind]
    imports: Imports = {
        "osc2tx_runtime.language.tree.base": {"Behaviour"},
        "osc2tx_runtime.language.tree.duration_limits": {"Duration"},
    }
    bodies = ["\n".join(_method(method, imports)) for method in found]
    name = f"{class_name(kind)}Methods"
    lines = [
        f"    from {module} import {', '.join(sorted(names))}"
        for module, names in sorted(imports.items())
        if names
    ]
    if not lines[0].startswith("    from osc2tx_runtime"):  # the standard library stands apart
        lines.insert(1, "")
    return _formatted(
        f'"""Actions of the actor type `{kind}`; {MADE}."""\n',
        "# The registry executes these declarations.",
        '# mypy: disable-error-code="empty-body"\n',
        "from __future__ import annotations\n",
        "from typing import TYPE_CHECKING\n",
        "from osc2tx_runtime.language.actions.registry import carried_out\n",
        "if TYPE_CHECKING:",
        *lines,
        f"\n@carried_out\nclass {name}:",
        f'    """Actions of the actor type `{kind}`."""\n',
        *bodies,
    )


def _formatted(*lines: str) -> str:
    return black.format_str("\n".join(lines) + "\n", mode=black.Mode(line_length=100))


# --- one method ----------------------------------------------------------------------------------


def _method(method: Method, imports: Imports) -> Iterator[str]:
    taken = " | ".join(_modifiers(method.factory, imports))
    own = _parameters(method.factory, imports)
    label = f"label: str | {taken} | None = None" if taken else "label: str | None = None"
    modifiers = f"*modifiers: {taken}" if taken else "*"
    listed = ("self", label, "/", modifiers, *own, "duration: Duration | None = None")
    yield f"    def {method.name}({', '.join(listed)}) -> Behaviour:"
    yield from (f"        {line}".rstrip() for line in _docstring(method))
    yield ""


def _modifiers(factory: type[Any], imports: Imports) -> Iterator[str]:
    """Yield the types of modifiers that an action takes: groups of them, then single ones."""
    taken = set(factory.accepts)
    left, names = set(taken), []
    for name, group in GROUPS.items():
        if name != STARTS and set(group) <= taken and left & set(group):
            names.append(name)
            left -= set(group)
    if issubclass(factory, ModifiableAction) and not set(GROUPS[STARTS]) <= taken:
        names.append(STARTS)
        left -= set(GROUPS[STARTS])
    imports.setdefault(groups.__name__, set()).update(names)
    for kind in left:
        imports.setdefault(kind.__module__, set()).add(kind.__name__)
    yield from (*names, *sorted(kind.__name__ for kind in left))


def _parameters(factory: type[Any], imports: Imports) -> Iterator[str]:
    """Yield the parameters of an action as it writes them, but for those that all have."""
    owner = next(kind for kind in factory.__mro__ if "__init__" in vars(kind))
    given, known = _type_arguments(factory, owner), _imported(owner)
    (init,) = ast.parse(inspect.cleandoc(inspect.getsource(vars(owner)["__init__"]))).body
    assert isinstance(init, ast.FunctionDef)
    for argument, default in zip(init.args.kwonlyargs, init.args.kw_defaults, strict=True):
        if argument.arg in ("duration", "label"):
            continue
        assert argument.annotation is not None
        for node in (each for each in ast.walk(argument.annotation) if isinstance(each, ast.Name)):
            if node.id in given:
                known[given[node.id].__name__] = given[node.id].__module__
                node.id = given[node.id].__name__
            if node.id not in known and not hasattr(builtins, node.id):
                sys.exit(f"{owner.__name__}: {node.id} belongs into a module below the actors")
            if node.id in known:
                imports.setdefault(known[node.id], set()).add(node.id)
        value = "" if default is None else f" = {ast.unparse(default)}"
        yield f"{argument.arg}: {ast.unparse(argument.annotation)}{value}"


def _type_arguments(factory: type, owner: type) -> dict[str, type]:
    """Return what stands for the type parameters of a generic base of an action."""
    parameters = [each.__name__ for each in getattr(owner, "__parameters__", ())]
    bases = (base for kind in factory.__mro__ for base in getattr(kind, "__orig_bases__", ()))
    arguments = next((get_args(base) for base in bases if get_origin(base) is owner), ())
    return dict(zip(parameters, arguments, strict=True))


def _imported(owner: type) -> dict[str, str]:
    """Return where the module of a class takes its names from, also those for types alone."""
    module = import_module(owner.__module__)
    found: dict[str, str] = {}
    for node in ast.walk(ast.parse(inspect.getsource(module))):
        if isinstance(node, ast.ImportFrom) and not node.level and node.module:
            found.update(dict.fromkeys((alias.name for alias in node.names), node.module))
    return found


# --- its docstring -------------------------------------------------------------------------------


def _docstring(method: Method) -> Iterator[str]:
    """Yield the docstring of the class with the section, without entries that the method lacks."""
    head, *rest = (inspect.getdoc(method.factory) or "").splitlines()
    rest = list(_without(rest, ("actor", "**options")))
    while rest and rest[-1] in ("", "Args:"):
        rest.pop()
    section = catalogue().actions[f"{method.kind}.{method.name}"].section
    if section and len(f'"""{head} (§{section})"""') <= WIDTH:
        head = f"{head.removesuffix('.')} (§{section})."
    elif section:
        rest = ["", f"Section §{section}.", *rest]
    yield f'"""{head}' if rest else f'"""{head}"""'
    if rest:
        yield from (*_filled(rest), '"""')


def _filled(lines: Sequence[str]) -> Iterator[str]:
    """Yield the lines again, wrapped to the width of a method."""
    paragraph: list[str] = []
    for line in lines:
        if not line or re.match(ENTRY, line) or line == "Args:":
            yield from _fill(paragraph)
            paragraph = []
        if line:
            paragraph.append(line)
        else:
            yield ""
    yield from _fill(paragraph)


def _fill(paragraph: Sequence[str]) -> Iterator[str]:
    if paragraph:
        indent = re.match(" *", paragraph[0])[0]  # type: ignore[index]
        text = " ".join(line.strip() for line in paragraph)
        below = indent if len(indent) == 0 else f"{indent}    "
        yield from textwrap.wrap(text, WIDTH, initial_indent=indent, subsequent_indent=below)


def _without(lines: Sequence[str], names: tuple[str, ...]) -> Iterator[str]:
    """Yield the lines but the entries of some arguments, with their continuation lines."""
    skips = False
    for line in lines:
        entry = re.match(ENTRY, line)
        if entry or not line.startswith("     "):
            skips = entry is not None and entry[1] in names
        if not skips:
            yield line


if __name__ == "__main__":
    for path, text in render().items():
        path.write_text(text, encoding="utf-8")
