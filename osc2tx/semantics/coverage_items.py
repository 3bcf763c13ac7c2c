"""Coverage items: arguments of `cover` and `record`, and the items of a type (§7.5)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import TypeSymbol
from osc2tx.syntax import ast
from osc2tx_classes import dataclass

ARGUMENTS = (
    "name", "expression", "unit", "range", "every", "buckets", "event", "text", "items",
    "ignore", "illegal", "disable", "target", "override",
)  # fmt: skip
DEFAULT_EVENT = "end"


@dataclass(frozen=True, slots=True)
class Item:
    """A declared item.

    Attributes:
        name: What overrides and crosses call it.
        node: Its declaration.
        arguments: What the declaration gives, by name of the parameter.
    """

    name: str
    node: ast.CoverageDeclaration
    arguments: Mapping[str, ast.Expression]

    @property
    def event(self) -> str:
        """The event that samples it; items of one event are one metric group."""
        return text_of(self.arguments.get("event")) or DEFAULT_EVENT

    @property
    def expression(self) -> ast.Expression | None:
        """What is sampled; `None` for a cross of other items."""
        if "items" in self.arguments:
            return None
        return self.arguments.get("expression", self.arguments["name"])


def items_of(owner: TypeSymbol | None) -> Iterator[Item]:
    """Yield the items that a type declares itself, overrides left aside."""
    for statement in owner.statements if owner is not None else ():
        match statement:
            case ast.CoverageDeclaration():
                yield from _items(statement)
            case ast.ParameterDeclaration(constraints=constraints, names=names):
                for constraint in constraints:
                    if isinstance(constraint, ast.CoverageDeclaration):
                        yield from _items(constraint, field=names[0].text)
            case _:
                continue


def all_items_of(owner: TypeSymbol | None) -> Iterator[Item]:
    """Yield the items of a type, then those of its supertypes."""
    for ancestor in supertypes(owner) if owner is not None else ():
        yield from items_of(ancestor)


def _items(node: ast.CoverageDeclaration, field: str | None = None) -> Iterator[Item]:
    """Yield the item of a declaration; in the `with` of a field `it` is named like the field."""
    arguments = {a.name.text if a.name else "name": a.value for a in reversed(node.arguments)}
    given = arguments.get("name")
    name = field if isinstance(given, ast.ItExpression) else text_of(given)
    if name is not None and "override" not in arguments:
        yield Item(name, node, arguments)


def text_of(expression: ast.Expression | None) -> str | None:
    """Return the identifier that an argument consists of; a string serves as well."""
    match expression:
        case ast.NameExpression():
            return expression.name.text
        case ast.StringLiteral():
            return expression.value
        case _:
            return None
