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
    item: Type = ERROR
    if "override" in arguments:
        item = _overridden_type(r, arguments["override"], env)
    elif "items" not in arguments:
        item = _item_type(r, arguments, env)
    if "override" not in arguments:
        _check_unit(r, node, arguments, item)
    _check_rules(r, node, arguments, env)
    if "event" in arguments:
        _check_event(r, arguments["event"], env)
    for name in ("range", "every", "buckets", "text", "disable", "target"):
        if name in arguments:
            r.type_of(arguments[name], env, item)
    inner = env.with_it(item)
    for name in ("ignore", "illegal"):
        if name in arguments:
            check_condition(r, arguments[name], inner)


def _check_rules(
    r: Resolution,
    node: ast.CoverageDeclaration,
    arguments: dict[str, ast.Expression],
    env: Environment,
) -> None:
    for other in ("range", "every"):
        if "buckets" in arguments and other in arguments:
            r.report("OSC412", arguments[other].span, f"`buckets` and `{other}` exclude each other")
    if node.kind == "record" and "target" in arguments:
        r.report("OSC412", arguments["target"].span, "`target` belongs to `cover`")
    disable = arguments.get("disable")
    if disable is not None and not isinstance(disable, ast.BoolLiteral):
        r.report("OSC412", disable.span, "`disable` takes `true` or `false`")
    overridden = arguments.get("override")
    if overridden is not None:
        _check_override(r, arguments, overridden, env)


FIXED = ("name", "expression", "event", "unit")


def _check_override(
    r: Resolution,
    arguments: dict[str, ast.Expression],
    overridden: ast.Expression,
    env: Environment,
) -> None:
    """Check that an existing item of the same type is refined, and only what may change."""
    for fixed in FIXED:
        if fixed in arguments:
            r.report("OSC412", arguments[fixed].span, f"an override cannot change `{fixed}`")
    items = [_item_name(s) for s in env.owner.statements] if env.owner else []
    name = _text(overridden)
    if name is None or name not in items:
        r.report(
            "OSC412",
            overridden.span,
            f"no coverage item `{name or overridden.span.text}` in this type",
            help=did_you_mean(name or "", [item for item in items if item]),
        )


def _overridden_type(r: Resolution, overridden: ast.Expression, env: Environment) -> Type:
    for statement in env.owner.statements if env.owner else ():
        if isinstance(statement, ast.CoverageDeclaration):
            arguments = {a.name.text if a.name else "name": a.value for a in statement.arguments}
            if "override" not in arguments and _item_name(statement) == _text(overridden):
                return _item_type(r, arguments, env)
    return ERROR


def _item_name(statement: ast.Statement) -> str | None:
    if not isinstance(statement, ast.CoverageDeclaration):
        return None
    for argument in statement.arguments:
        if argument.name is None or argument.name.text == "name":
            return _text(argument.value)
    return None


def _text(expression: ast.Expression) -> str | None:
    match expression:
        case ast.NameExpression():
            return expression.name.text
        case ast.StringLiteral():
            return expression.value
        case _:
            return None


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
