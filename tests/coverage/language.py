"""The constructs of the language: every kind of node of the syntax tree, and what arguments say.

A construct builds if a file of this repository that has it makes a module. It is refused, in some
uses or in all, where a report of family 5 stands on it.
"""

from __future__ import annotations

import enum
import inspect
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from osc2tx.diagnostics import Severity, Span
from osc2tx.semantics.builtins import COMPOSITION_FIELDS, OVERLAP, OVERRIDE_MODE
from osc2tx.syntax import ast
from tests.coverage.sources import Source, children, goldens, scenarios, walk

# Parts of constructs, not constructs of their own.
PARTS = frozenset(
    {
        *("Argument", "BehaviorName", "EventSpecification", "ExportItem", "File", "Name"),
        *("NamedType", "Node", "ParameterSpecification", "SiExponent"),
    }
)
CHAPTERS: Mapping[str, str] = {
    "declarations": "Declarations",
    "members": "Members of declarations",
    "behaviors": "Behaviors",
    "types": "Types",
    "expressions": "Expressions",
}


@dataclass
class Construct:
    """A construct, and where it is.

    Attributes:
        chapter: Part of the language.
        name: What it is called.
        text: What it looks like.
        builds: Files that make a module, scenarios of the repository first.
        refused: Codes of reports on it.
    """

    chapter: str
    name: str
    text: str
    builds: list[str] = field(default_factory=list)
    refused: set[str] = field(default_factory=set)


def constructs() -> Sequence[Construct]:
    """Return all constructs, with what is found in the files of the repository."""
    found = {construct.name: construct for construct in _all()}
    for source in (*scenarios(), *goldens()):
        file = source.compilation.ast
        if file is None:
            continue
        if source.builds:
            for name in {name for node in walk(file) for name in _names(node)} & found.keys():
                found[name].builds.append(source.place)
        for code, span in _refusals(source):
            name = _construct_at(file, span, found)
            if name is not None:
                found[name].refused.add(code)
    return list(found.values())


def _all() -> Iterator[Construct]:
    for module, chapter in CHAPTERS.items():
        for name, kind in vars(ast).items():
            if not inspect.isclass(kind) or kind.__module__ != f"{ast.__name__}.{module}":
                continue
            if issubclass(kind, enum.Enum):
                for member in kind:
                    yield Construct(chapter, f"{name}.{member.name}", f"`{member.value}`")
            elif name not in PARTS and not kind.__subclasses__():
                yield Construct(chapter, name, (kind.__doc__ or "").partition("\n")[0])
    for kind in ("cover", "record"):
        yield Construct(CHAPTERS["members"], f"CoverageDeclaration.{kind}", f"`{kind}(…)`")
    for name in COMPOSITION_FIELDS:
        yield Construct(CHAPTERS["behaviors"], f"argument {name}", f"`parallel({name}: …)`")
    for name in OVERLAP.members:
        yield Construct(CHAPTERS["behaviors"], f"overlap {name}", f"`parallel(overlap: {name})`")
    for name in OVERRIDE_MODE.members:
        yield Construct(CHAPTERS["behaviors"], f"override {name}", f"`override(a, b, {name})`")


def _names(node: ast.Node) -> Iterator[str]:
    """Names of the constructs that a node is an example of."""
    yield type(node).__name__
    for value in children(node):
        if isinstance(value, enum.Enum):
            yield f"{type(value).__name__}.{value.name}"
    match node:
        case ast.CoverageDeclaration(kind=kind):
            yield f"CoverageDeclaration.{kind}"
        case ast.Composition(arguments=arguments):
            yield from (f"argument {argument.name.text}" for argument in _named(arguments))
            for argument in _named(arguments):
                if argument.name.text == "overlap":
                    yield f"overlap {argument.value.span.text}"
        case ast.ModifierApplication(modifier=ast.Name(text="override"), arguments=arguments):
            # the mode is the third argument, `on_start` if it is left out
            mode = arguments[2].value.span.text if len(arguments) > 2 else "on_start"
            yield f"override {mode}"


def _named(arguments: Iterable[ast.Argument]) -> Iterator[ast.Argument]:
    return (argument for argument in arguments if argument.name is not None)


def _refusals(source: Source) -> Iterator[tuple[str, Span]]:
    """Codes and places of what no backend can express."""
    own = source.compilation.source
    for report in source.compilation.diagnostics:
        refused = report.severity is Severity.ERROR and report.code.startswith("OSC5")
        if refused and report.primary is not None and report.primary.source is own:
            yield report.code, report.primary


def _construct_at(file: ast.File, span: Span, known: Mapping[str, Construct]) -> str | None:
    """Name of the smallest construct around a place."""
    around = [
        node
        for node in walk(file)
        if type(node).__name__ in known
        and node.span.start <= span.start
        and span.end <= node.span.end
    ]
    if not around:
        return None
    return type(min(around, key=lambda node: node.span.end - node.span.start)).__name__
