"""Coverage and recording (§7.5)."""

from __future__ import annotations

from osc2tx.semantics.assign import check_condition
from osc2tx.semantics.conversions import dimension_of
from osc2tx.semantics.events import resolve_event_path
from osc2tx.semantics.resolution import Environment, Resolution, did_you_mean
from osc2tx.semantics.types import ERROR, PhysicalType, Type
from osc2tx.syntax import ast

ARGUMENTS = (
    "name", "expression", "unit", "range", "every", "buckets", "event", "text", "items",
    "ignore", "illegal", "disable", "target", "override",
)  # fmt: skip


def check_coverage(r: Resolution, node: ast.CoverageDeclaration, env: Environment) -> None:
    """Check `cover(…)` or `record(…)`."""
    arguments = _by_name(r, node)
    if "override" in arguments or "items" in arguments:
        item: Type = ERROR
    else:
        item = _item_type(r, arguments, env)
    _check_unit(r, node, arguments, item)
    if "buckets" in arguments:
        for other in ("range", "every"):
            if other in arguments:
                r.report(
                    "OSC412", arguments[other].span, f"`buckets` and `{other}` exclude each other"
                )
    if "event" in arguments:
        _check_event(r, arguments["event"], env)
    for name in ("range", "every", "buckets", "text", "disable", "target"):
        if name in arguments:
            r.type_of(arguments[name], env, item)
    inner = env if item == ERROR else env.with_it(item)
    for name in ("ignore", "illegal"):
        if name in arguments:
            check_condition(r, arguments[name], inner)


def _by_name(r: Resolution, node: ast.CoverageDeclaration) -> dict[str, ast.Expression]:
    found: dict[str, ast.Expression] = {}
    for index, argument in enumerate(node.arguments):
        name = argument.name.text if argument.name else "name"
        if argument.name is None and index > 0:
            r.report("OSC405", argument.span, f"`{node.kind}` takes one positional argument")
        elif name not in ARGUMENTS:
            r.report(
                "OSC402",
                argument.name.span if argument.name else argument.span,
                f"`{node.kind}` has no parameter `{name}`",
                help=did_you_mean(name, ARGUMENTS),
            )
        elif name in found:
            r.report("OSC403", argument.span, f"`{name}` is given twice")
        else:
            found[name] = argument.value
    return found


def _item_type(r: Resolution, arguments: dict[str, ast.Expression], env: Environment) -> Type:
    expression = arguments.get("expression")
    if expression is None:
        expression = arguments.get("name")
        if isinstance(expression, ast.StringLiteral):
            return ERROR
    return ERROR if expression is None else r.type_of(expression, env)


def _check_unit(
    r: Resolution,
    node: ast.CoverageDeclaration,
    arguments: dict[str, ast.Expression],
    item: Type,
) -> None:
    unit = arguments.get("unit")
    if unit is None:
        if isinstance(item, PhysicalType):
            r.report("OSC412", node.span, f"an item of type `{item}` needs `unit:`")
        return
    if not isinstance(unit, ast.NameExpression):
        r.report("OSC412", unit.span, "`unit` takes the name of a unit")
        return
    symbol = r.scope.unit_named(unit.name.text)
    if symbol is None:
        known = [u.name for u in r.scope.all_units()]
        r.report(
            "OSC209", unit.span, f"no unit `{unit.name}`", help=did_you_mean(unit.name.text, known)
        )
        return
    r.references[unit] = symbol
    if item != ERROR and dimension_of(item) != dimension_of(symbol.type):
        r.report("OSC302", unit.span, f"`{symbol.name}` is not a unit of `{item}`")


def _check_event(r: Resolution, event: ast.Expression, env: Environment) -> None:
    if isinstance(event, ast.NameExpression):
        resolve_event_path(r, event, env)
    else:
        r.report("OSC412", event.span, "the event must be a name of the enclosing type")
