"""Write out the value classes of a copy of osc2tx, so that mypyc makes structs of them.

    python tools/native_classes.py FOLDER

mypyc compiles a class with our decorator (`osc2tx_shared.classes`) to a class of Python, whose
fields compiled code reads as slowly as the interpreter. Here each of them gets its constructor,
comparison and hash in writing, and a call of `complete` behind it, which adds the rest of what the
decorator does. The modules are those that the `pyproject.toml` of FOLDER has mypyc compile.
"""

from __future__ import annotations

import ast
import builtins
import sys
import tomllib
from collections.abc import Iterator, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1]))

from tools.value_classes import (
    DECORATOR,
    Field,
    Module,
    Sources,
    ValueClass,
    field_lines,
    needs_dict,
)

IMPORTS = """\
from typing import TYPE_CHECKING

from mypy_extensions import mypyc_attr
from osc2tx_shared.classes import complete as _complete
"""
NATIVE = "@mypyc_attr(allow_interpreted_subclasses=True)"
"""Of all native classes: so `__new__` does not call the constructor either, as pickling needs."""

NOT_NATIVE = "@mypyc_attr(native_class=False)"
BUILT_IN = {"dict", "float", "int", "list", "str", "tuple"}


class Rewriting:
    """The new text of one module."""

    def __init__(self, module: Module) -> None:
        """Take the module; it is changed when `text` is asked for."""
        self._module = module
        self._lines = list(module.lines)
        self._imports: dict[str, str] = {}  # of names that inherited defaults mention
        self._typing: dict[str, str] = {}  # of names that inherited annotations mention

    def text(self) -> str:
        """Return the text, with all classes written out."""
        classes = {each.node.lineno: each for each in self._module.classes.values()}
        plain = {each.lineno: each for each in self._module.plain}
        for line in sorted(classes | plain, reverse=True):
            if line in classes:
                self._write(classes[line])
            else:
                self._lines[line - 1 : line - 1] = self._mark(plain[line])
        if classes or plain:
            self._add_imports()
        return "\n".join(self._lines) + "\n"

    def _mark(self, node: ast.ClassDef) -> Sequence[str]:
        """Return what mypyc has to know about a class that is no value class."""
        bases = {ast.unparse(base).partition("[")[0] for base in node.bases}
        if bases & BUILT_IN or needs_dict(node):
            return [NOT_NATIVE]
        known = {each.name for each in self._module.plain} | {"Exception", "Generic"}
        return [NATIVE] if bases <= known else []  # others are enumerations, protocols and the like

    def _write(self, cls: ValueClass) -> None:
        """Replace a value class with one that is written out."""
        decorators = [ast.unparse(each) for each in cls.node.decorator_list]
        first = min(each.lineno for each in cls.node.decorator_list) - 1
        if cls.needs_dict:
            self._lines.insert(first, NOT_NATIVE)
            return
        kept = [f"@{each}" for each in decorators if not each.startswith(DECORATOR)]
        self._lines[first : cls.node.end_lineno] = [
            *(NATIVE, *kept),
            *self._lines[cls.node.lineno - 1 : cls.node.body[0].lineno - 1],
            *self._body(cls),
            "",
            *(f"    {line}" for line in self._methods(cls)),
            "",
            self._completion(cls),
        ]

    def _body(self, cls: ValueClass) -> Iterator[str]:
        """Yield the lines of the body of a class; fields lose their defaults."""
        fields = {line.lineno: line for line in field_lines(cls.node)}
        position = cls.node.body[0].lineno
        for start, line in fields.items():
            yield from self._lines[position - 1 : start - 1]
            yield f"    {ast.unparse(line.target)}: {ast.unparse(line.annotation)}"
            position = (line.end_lineno or start) + 1
        yield from self._lines[position - 1 : cls.node.end_lineno]

    def _methods(self, cls: ValueClass) -> Iterator[str]:
        compared = [f"self.{each.name}" for each in cls.fields if each.is_("compare")]
        if "__init__" not in cls.methods:
            yield from self._constructor(cls)
        if cls.is_("eq") and "__eq__" not in cls.methods:
            name = cls.node.name
            yield "def __eq__(self, other: object) -> bool:"
            yield f"    if not isinstance(other, {name}) or type(other) is not type(self):"
            yield "        return NotImplemented"
            yield f"    return {' and '.join(_equal(each) for each in compared) or True}"
        if cls.is_("eq") and cls.is_("frozen") and "__hash__" not in cls.methods:
            yield "def __hash__(self) -> int:"
            yield f"    return hash(({', '.join(compared)}))"

    def _constructor(self, cls: ValueClass) -> Iterator[str]:
        positional, named, body = ["self"], ["*"], []
        for each in cls.fields:
            made = f"({self._here(each, each.factory)})()" if each.factory else None
            default = self._here(each, each.default) if each.default else None
            if not each.is_("init"):
                if made or default:
                    body.append(f"self.{each.name} = {made or default}")
                continue
            said = f"{each.name}: {self._here(each, each.annotation, is_type=True)}"
            said += " | None = None" if made else f" = {default}" if default else ""
            (named if each.is_named else positional).append(said)
            value = f"{made} if {each.name} is None else {each.name}" if made else each.name
            body.append(f"self.{each.name} = {value}")
        if cls.has_post_init:
            body.append("self.__post_init__()")
        parameters = ", ".join(positional + (named if len(named) > 1 else []))
        yield f"def __init__({parameters}) -> None:"
        yield from (f"    {line}" for line in body or ["pass"])

    def _completion(self, cls: ValueClass) -> str:
        """Return the call that adds what the decorator would have added."""
        declared = []
        for each in cls.fields:
            given = {name: str(value) for name, value in each.settings.items()}
            given["kw_only"] = str(each.is_named)
            if each.default:
                given["default"] = self._here(each, each.default)
            if each.factory:
                given["default_factory"] = self._here(each, each.factory)
            shown = ", ".join(f"{name!r}: {value}" for name, value in given.items())
            declared.append(f"{each.name!r}: ({ast.unparse(each.annotation)!r}, {{{shown}}})")
        options = ", ".join(f"{name}={cls.is_(name)}" for name in ("frozen", "eq", "repr"))
        return f"_complete({cls.node.name}, {{{', '.join(declared)}}}, {options})"

    def _here(self, each: Field, expression: ast.expr, *, is_type: bool = False) -> str:
        """Return an expression of a field as this module can write it: names are imported."""
        if each.module is self._module:
            return ast.unparse(expression)
        imports = self._typing if is_type else self._imports
        copy = ast.parse(ast.unparse(expression), mode="eval")
        return ast.unparse(_Imported(each.module, self._module, imports).visit(copy))

    def _add_imports(self) -> None:
        future = self._lines.index("from __future__ import annotations")
        self._lines[future + 1 : future + 1] = IMPORTS.splitlines()
        tree = ast.parse("\n".join(self._lines))
        imports = [each for each in tree.body if isinstance(each, ast.Import | ast.ImportFrom)]
        last = imports[-1].end_lineno or 0
        typing = ["if TYPE_CHECKING:", *(f"    {each}" for each in self._typing.values())]
        self._lines[last:last] = [*self._imports.values(), *(typing if self._typing else [])]


class _Imported(ast.NodeTransformer):
    """Names of another module, under the names that this module imports them with."""

    def __init__(self, origin: Module, here: Module, imports: dict[str, str]) -> None:
        self._origin, self._here, self._imports = origin, here, imports

    def visit_Name(self, node: ast.Name) -> ast.Name:
        if hasattr(builtins, node.id):
            return node
        module, name = self._origin.imports.get(node.id, (self._origin.name, node.id))
        if module == self._here.name or self._here.imports.get(node.id) == (module, name):
            return ast.Name(name if module == self._here.name else node.id)
        local = f"_{node.id}_of_{module.replace('.', '_')}"
        self._imports[local] = (
            f"from {module} import {name} as {local}" if name else f"import {module} as {local}"
        )
        return ast.Name(local)


def _equal(value: str) -> str:
    return f"{value} == {value.replace('self', 'other', 1)}"


def compiled_modules(folder: Path) -> list[str]:
    """Return the files that the build compiles, relative to the folder."""
    settings = tomllib.loads((folder / "pyproject.toml").read_text("utf-8"))
    hook = settings["tool"]["hatch"]["build"]["targets"]["wheel"]["hooks"]["custom"]
    return sorted(
        str(path.relative_to(folder).as_posix())
        for pattern in hook["include"]
        for path in folder.glob(pattern)
        if not any(path.match(excluded) for excluded in hook["exclude"])
    )


def rewrite(folder: Path) -> None:
    """Write out the value classes of the modules that the build compiles."""
    sources = Sources(folder / "osc2tx")
    compiled = {folder / name for name in compiled_modules(folder)}
    modules = [each for each in sources.modules.values() if each.path in compiled]
    for path, text in [(each.path, Rewriting(each).text()) for each in modules]:
        path.write_text(text, "utf-8")


if __name__ == "__main__":
    rewrite(Path(sys.argv[1]))
