"""Coverage and recording (§7.5): overrides are merged, slices become numbers in the item's unit."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.lowering.behavior.composed_behaviors import Composed
from osc2tx.lowering.behavior.triggers import declares_event, event_of_object
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.coverage.buckets import Sampled, with_buckets
from osc2tx.lowering.coverage.owners import CoverageOwner, coverage_owners
from osc2tx.lowering.value_types import lower_unit, number_in
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import to_si
from osc2tx.semantics.bodies.coverage_items import Item, text_of
from osc2tx.semantics.types import ERROR
from osc2tx.syntax import ast

MOMENTS = {"start": ir.Moment.START, "end": ir.Moment.END, "fail": ir.Moment.FAIL}


def lower_coverage(ctx: LoweringContext, scenario: Composed) -> tuple[ir.Coverage, ...]:
    """Return the items of a scenario and of its objects that are not switched off."""
    lowered: dict[str, Sampled] = {}
    for owner in coverage_owners(ctx, scenario):
        overrides = dict(_overrides(owner))
        for item in owner.items():
            arguments = {**item.arguments, **overrides.get(item.name, {})}
            if _is_true(arguments.get("disable")):
                continue
            sampled = _lower(owner, item, arguments)
            if sampled is None:
                continue
            name = sampled.coverage.name
            if lowered.setdefault(name, sampled) is not sampled:
                _report_name(ctx, item)
    return tuple(with_buckets(ctx, scenario, list(lowered.values())))


def _report_name(ctx: LoweringContext, item: Item) -> None:
    ctx.unsupported(
        "OSC501",
        item.node.span,
        f"another item has the name `{item.name}`, sampled by another event",
        help=f"give it a name of its own: `{item.node.kind}(…, expression: {item.name})`",
    )


def _overrides(
    owner: CoverageOwner,
) -> Iterator[tuple[str, dict[str, ast.Expression]]]:
    """Yield the arguments of overrides, by item; the last one of an argument counts (§7.5.6)."""
    merged: dict[str, dict[str, ast.Expression]] = {}
    for ancestor in reversed(owner.lineage):
        for statement in ancestor.statements:
            if isinstance(statement, ast.CoverageDeclaration):
                given = {a.name.text: a.value for a in statement.arguments if a.name is not None}
                name = text_of(given.pop("override", None))
                if name is not None:
                    merged.setdefault(name, {}).update(given)
    yield from merged.items()


def _lower(
    owner: CoverageOwner, item: Item, arguments: dict[str, ast.Expression]
) -> Sampled | None:
    ctx, node, source = owner.ctx, item.node, item.expression
    crossed = arguments.get("items")
    elements = crossed.elements if isinstance(crossed, ast.ListLiteral) else ()
    items = tuple(name for e in elements if (name := text_of(e)) is not None)
    # One event samples all items of a cross (§7.5.4).
    members = owner.items() if items else ()
    group = [i.arguments.get("event") for i in members if i.name in items]
    event = _event(ctx, arguments.get("event", group[0] if group else None))
    expression = None
    if source is not None:
        inner = _it_of(owner, item)
        expression = lower_expression(inner, source)
    if event is None or (source is not None and expression is None):
        return None
    unit = ctx.model.symbol_of(arguments["unit"]) if "unit" in arguments else None
    unit = unit if isinstance(unit, sym.UnitSymbol) else None
    number = _Numbers(ctx, unit)
    target = number.of(arguments.get("target"))
    coverage = ir.Coverage(
        kind=node.kind,
        name=f"{owner.prefix}{item.name}",
        span=node.span,
        expression=expression,
        items=tuple(f"{owner.prefix}{each}" for each in items),
        event=event,
        unit=None if unit is None else lower_unit(unit),
        within=number.range_of(arguments.get("range")),
        every=number.of(arguments.get("every")),
        buckets=number.list_of(arguments.get("buckets")),
        ignore=_filter(ctx, item, expression, arguments.get("ignore")),
        illegal=_filter(ctx, item, expression, arguments.get("illegal")),
        target=None if target is None else int(target),
        text=_text(arguments.get("text")),
        comments=statement_comments(node),
    )
    type_ = ERROR if source is None else ctx.model.type_of(source)
    return Sampled(item, coverage, type_, unit, arguments.get("ignore"), owner)


def _it_of(owner: CoverageOwner, item: Item) -> LoweringContext:
    """Return the context of an item in the `with` of a field: `it` is the field."""
    field = owner.field(item.name)
    node = None if field is None else field.node
    if field and isinstance(node, ast.ParameterDeclaration) and item.node in node.constraints:
        return owner.ctx.with_it(owner.value_of(field, item))
    return owner.ctx


def _event(ctx: LoweringContext, event: ast.Expression | None) -> ir.EventRef | ir.Moment | None:
    if event is None:
        return ir.Moment.END
    symbol = ctx.model.symbol_of(event)
    if isinstance(symbol, sym.EventSymbol) and declares_event(symbol):
        if isinstance(symbol.owner, sym.ActorSymbol | sym.StructSymbol):
            return event_of_object(ctx, event, symbol)
        return ir.EventRef(span=event.span, name=symbol.name)
    if symbol is not None and symbol.name in MOMENTS and symbol.name != "fail":
        return MOMENTS[symbol.name]
    ctx.unsupported("OSC501", event.span, f"`{event.span.text}` cannot sample an item yet")
    return None


def _filter(
    ctx: LoweringContext,
    item: Item,
    sampled: ir.Expression | None,
    condition: ast.Expression | None,
) -> ir.Expression | None:
    """Lower a condition over an item; its name and `it` are its value."""
    if condition is None or sampled is None:
        return None
    element = ir.Element(span=condition.span, type=sampled.type, depth=0)
    return lower_expression(ctx.with_it(element).with_local(item.name, element), condition)


def _is_true(expression: ast.Expression | None) -> bool:
    return isinstance(expression, ast.BoolLiteral) and expression.value


def _text(expression: ast.Expression | None) -> str:
    return expression.value if isinstance(expression, ast.StringLiteral) else ""


class _Numbers:
    """Reads the numbers of slices: plain ones count in the unit, others are converted to it.

    Whole numbers stay whole, also in compiled code, which makes a `float` of what is called one.
    """

    def __init__(self, ctx: LoweringContext, unit: sym.UnitSymbol | None) -> None:
        self._ctx = ctx
        self._unit = unit

    def of(self, node: ast.Expression | None) -> int | float | None:
        """Return a number; rejects values that are not constant at compile time."""
        match node:
            case None:
                return None
            case ast.IntegerLiteral():
                return node.value
            case ast.FloatLiteral():
                return node.value
            case ast.Unary(operator=ast.UnaryOperator.NEGATE, operand=operand):
                number = self.of(operand)
                return None if number is None else -number
            case ast.PhysicalLiteral(value=value):
                si = to_si(float(value), self._ctx.model.units[node])
                if self._unit is None:
                    return si
                return number_in(self._unit, si)
            case _:
                self._ctx.unsupported(
                    "OSC501", node.span, "slices of an item take plain numbers only"
                )
                return None

    def range_of(self, node: ast.Expression | None) -> tuple[int | float, int | float] | None:
        """Return a range."""
        if not isinstance(node, ast.RangeLiteral):
            self.of(node)
            return None
        lower, upper = self.of(node.lower), self.of(node.upper)
        if lower is None or upper is None:
            return None
        return (lower, upper) if lower <= upper else (upper, lower)

    def list_of(self, node: ast.Expression | None) -> tuple[int | float, ...]:
        """Return the numbers of a list."""
        if not isinstance(node, ast.ListLiteral):
            self.of(node)
            return ()
        numbers = (self.of(element) for element in node.elements)
        return tuple(number for number in numbers if number is not None)
