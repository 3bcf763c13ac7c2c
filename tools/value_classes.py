"""The value classes of the sources, as they are written: for `native_classes.py`."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

DECORATOR = "dataclass"
NEEDS_DICT = "__dict__"
"""A class in which this is said needs one: it stays a class of Python."""


@dataclass
class Field:
    """A field of a value class.

    Attributes:
        module: Where it is declared.
        name: Its name.
        annotation: Its type.
        default: Its default value, if it has one.
        factory: What makes its default value.
        settings: The other arguments of `field`, such as `repr`.
        is_named: Whether the constructor takes it as a named argument only.
    """

    module: Module
    name: str
    annotation: ast.expr
    default: ast.expr | None = None
    factory: ast.expr | None = None
    settings: dict[str, bool] = field(default_factory=dict)
    is_named: bool = False

    def is_(self, setting: str) -> bool:
        """Whether a setting of `field` holds that does so by default."""
        return self.settings.get(setting, True)


@dataclass
class ValueClass:
    """A class with our decorator: its options, and the fields of its own."""

    module: Module
    node: ast.ClassDef
    options: dict[str, bool]
    own: list[Field]

    @property
    def ancestors(self) -> list[ValueClass]:
        """The value classes that it inherits, the nearest first."""
        found: list[ValueClass] = []
        for base in self.node.bases:
            cls = self.module.value_class(base)
            if cls is not None:
                found += [cls, *cls.ancestors]
        return found

    @property
    def fields(self) -> list[Field]:
        """All fields, inherited ones first."""
        found: dict[str, Field] = {}
        for cls in (*reversed(self.ancestors), self):
            found |= {each.name: each for each in cls.own}
        return list(found.values())

    def is_(self, option: str) -> bool:
        """Whether an option of the decorator holds."""
        return self.options.get(option, option in ("eq", "repr"))

    @property
    def methods(self) -> set[str]:
        """The names of its own methods."""
        return {each.name for each in self.node.body if isinstance(each, ast.FunctionDef)}

    @property
    def has_post_init(self) -> bool:
        """Whether its constructor ends with a call of `__post_init__`."""
        return any("__post_init__" in cls.methods for cls in (self, *self.ancestors))

    @property
    def needs_dict(self) -> bool:
        """Whether it, or a class that it inherits, must stay a class of Python."""
        return any(needs_dict(cls.node) for cls in (self, *self.ancestors))


class Module:
    """A module: its classes, and where its names come from.

    Attributes:
        name: Its full name.
        path: Its file.
        lines: The lines of its text.
        imports: For imported names, the module and the name there; no name for a module itself.
        classes: Its value classes, by name.
        plain: Its other classes without decorators.
    """

    def __init__(self, sources: Sources, name: str, path: Path) -> None:
        """Read the file."""
        self._sources = sources
        self.name, self.path = name, path
        text = path.read_text("utf-8")
        self.lines = text.splitlines()
        self.imports: dict[str, tuple[str, str]] = {}
        self.classes: dict[str, ValueClass] = {}
        self.plain: list[ast.ClassDef] = []
        tree = ast.parse(text)
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom):
                above = name.split(".")[: -node.level] if node.level else []  # of no package
                origin = ".".join([*above, node.module or ""])
                for item in node.names:
                    self.imports[item.asname or item.name] = (origin, item.name)
            elif isinstance(node, ast.Import):
                for item in node.names:
                    self.imports[item.asname or item.name] = (item.name, "")
        for node in tree.body:
            if isinstance(node, ast.ClassDef):
                self._add(node)

    def _add(self, node: ast.ClassDef) -> None:
        if not node.decorator_list and not node.keywords:
            self.plain.append(node)
        for decorator in node.decorator_list:
            call = decorator if isinstance(decorator, ast.Call) else None
            if ast.unparse(call.func if call else decorator) == DECORATOR:
                options = _truths(call.keywords if call else [])
                own = [_field(self, line, options) for line in field_lines(node)]
                self.classes[node.name] = ValueClass(self, node, options, own)

    def value_class(self, expression: ast.expr) -> ValueClass | None:
        """Return the value class that an expression names in this module."""
        if isinstance(expression, ast.Subscript):
            expression = expression.value
        if isinstance(expression, ast.Attribute) and isinstance(expression.value, ast.Name):
            package = ".".join(self.imports[expression.value.id])
            inner = self._sources.modules.get(package)
            return inner._named(expression.attr) if inner else None
        return self._named(expression.id) if isinstance(expression, ast.Name) else None

    def _named(self, name: str) -> ValueClass | None:
        if name in self.classes or name not in self.imports:
            return self.classes.get(name)
        origin, original = self.imports[name]
        inner = self._sources.modules.get(origin)
        return inner._named(original) if inner else None


class Sources:
    """The modules of a package, by their full names."""

    def __init__(self, package: Path) -> None:
        """Read all modules."""
        self.modules: dict[str, Module] = {}
        for path in sorted(package.rglob("*.py")):
            parts = path.relative_to(package.parent).with_suffix("").parts
            name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
            self.modules[name] = Module(self, name, path)


def needs_dict(node: ast.ClassDef) -> bool:
    """Whether a class says that its instances have a `__dict__`."""
    return NEEDS_DICT in ast.unparse(node)


def field_lines(node: ast.ClassDef) -> Iterator[ast.AnnAssign]:
    """Yield the declarations of fields in the body of a class."""
    for line in node.body:
        if isinstance(line, ast.AnnAssign) and not ast.unparse(line.annotation).startswith(
            "ClassVar"
        ):
            yield line


def _field(module: Module, line: ast.AnnAssign, options: dict[str, bool]) -> Field:
    assert isinstance(line.target, ast.Name)
    found = Field(module, line.target.id, line.annotation, line.value)
    if isinstance(line.value, ast.Call) and ast.unparse(line.value.func) == "field":
        given = {each.arg: each.value for each in line.value.keywords}
        found.default = given.get("default")
        found.factory = given.get("default_factory")
        found.settings = _truths(
            each for each in line.value.keywords if not str(each.arg).startswith("default")
        )
    found.is_named = found.settings.pop("kw_only", options.get("kw_only", False))
    return found


def _truths(keywords: Iterable[ast.keyword]) -> dict[str, bool]:
    return {each.arg or "": bool(ast.literal_eval(each.value)) for each in keywords}
