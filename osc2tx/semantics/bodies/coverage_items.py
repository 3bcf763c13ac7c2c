"""Coverage items: arguments of `cover` and `record`, and the items of a type (§7.5)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import pairwise

from osc2tx.semantics.conversions import dimension_of, is_numeric
from osc2tx.semantics.resolution import Environment, Resolution
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import TypeSymbol
from osc2tx.semantics.types import ERROR, FLOAT, ListType, RangeType, Type
from osc2tx.semantics.units import constant_number
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

ARGUMENTS = (
    "name", "expression", "unit", "range", "every", "buckets", "event", "text", "items",
    "ignore", "illegal", "disable", "target", "override",
)  # fmt: skip
DEFAULT_EVENT = "end"


@dataclass(frozen=True, slots=True)
class Item:
    """A declared item.

    Attributes:
        name: Its name in overrides and crosses.
        node: Its declaration.
        arguments: The arguments of the declaration, by name of the parameter.
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
        """The sampled expression; `None` for a cross of other items."""
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


Arguments = Mapping[str, ast.Expression]


def check_slices(r: Resolution, arguments: Arguments, item: Type, env: Environment) -> None:
    """Check the arguments that select and group values."""
    for other in ("range", "every"):
        if "buckets" in arguments and other in arguments:
            r.report("OSC412", arguments[other].span, f"`buckets` and `{other}` exclude each other")
    if "range" in arguments:
        _check_range(r, arguments["range"], item, env)
    if "every" in arguments:
        _check_every(r, arguments["every"], item, env)
    if "buckets" in arguments:
        _check_buckets(r, arguments["buckets"], item, env)


def _check_range(r: Resolution, value: ast.Expression, item: Type, env: Environment) -> None:
    type_ = r.type_of(value, env)
    if isinstance(type_, RangeType):
        _check_boundary(r, value, type_.element, item, "`range`")
    elif type_ != ERROR:
        r.report("OSC301", value.span, f"`range` must be a range, not `{type_}`")


def _check_every(r: Resolution, value: ast.Expression, item: Type, env: Environment) -> None:
    _check_boundary(r, value, r.type_of(value, env), item, "`every`")
    width = constant_number(r, value)
    if width is not None and width <= 0:
        r.report("OSC412", value.span, "the width of a slice must be positive")


def _check_buckets(r: Resolution, value: ast.Expression, item: Type, env: Environment) -> None:
    type_ = r.type_of(value, env)
    if not isinstance(type_, ListType):
        if type_ != ERROR:
            r.report("OSC301", value.span, f"`buckets` must be a list, not `{type_}`")
        return
    _check_boundary(r, value, type_.element, item, "`buckets`")
    if not isinstance(value, ast.ListLiteral):
        return
    if len(value.elements) < 2:
        r.report("OSC412", value.span, "buckets lie between two boundaries or more")
    for first, second in pairwise(value.elements):
        lower, upper = constant_number(r, first), constant_number(r, second)
        if lower is not None and upper is not None and upper < lower:
            r.report("OSC412", second.span, "the boundaries of buckets must not descend")
            return


def _check_boundary(
    r: Resolution, value: ast.Expression, given: Type, item: Type, what: str
) -> None:
    """Check that a boundary has the dimension of the item, or is a number in its unit."""
    if ERROR in (given, item):
        return
    if not is_numeric(item):
        r.report("OSC412", value.span, f"{what} sorts numbers, not `{item}`")
    elif not is_numeric(given):
        r.report("OSC301", value.span, f"{what} takes numbers, not `{given}`")
    elif dimension_of(given) not in (dimension_of(FLOAT), dimension_of(item)):
        r.report("OSC302", value.span, f"{what} is given in `{given}`, the item in `{item}`")
