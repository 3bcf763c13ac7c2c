"""Coverage and recording (§7.5)."""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from osc2tx.diagnostics import Label
from osc2tx.diagnostics.fixes import Help, Remedy, insert, write
from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.semantics.assignability import check_condition, check_value
from osc2tx.semantics.bodies.constraints import paths_of, root_of
from osc2tx.semantics.bodies.coverage_items import (
    ARGUMENTS,
    Item,
    all_items_of,
    check_slices,
    items_of,
    text_of,
)
from osc2tx.semantics.bodies.events import resolve_event_path
from osc2tx.semantics.conversions import dimension_of
from osc2tx.semantics.resolution import Environment, Resolution
from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import EnumMemberSymbol, ParameterSymbol, TypeSymbol
from osc2tx.semantics.types import (
    ERROR,
    STRING,
    UINT,
    EnumType,
    ErrorType,
    PhysicalType,
    PrimitiveType,
    Type,
)
from osc2tx.syntax import ast

FIXED = ("name", "expression", "event", "unit")
Arguments = Mapping[str, ast.Expression]


def check_coverage(r: Resolution, node: ast.CoverageDeclaration, env: Environment) -> None:
    """Check `cover(…)` or `record(…)`."""
    arguments = _by_name(r, node)
    if "override" in arguments:
        name, item = _check_override(r, arguments, env)
    elif "items" in arguments:
        name, item = text_of(arguments.get("name")), ERROR
        _check_cross(r, node, arguments, env)
    else:
        name, item = text_of(arguments.get("name")), _item_type(r, arguments, env)
        _check_unit(r, node, arguments, item)
    _check_unique(r, node, env)
    _check_simple(r, node, arguments, env)
    check_slices(r, arguments, item, env)
    for key in ("ignore", "illegal"):
        if key in arguments:
            _check_filter(r, arguments[key], name, item, env)


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
                help=name_meant(argument.name.span, ARGUMENTS) if argument.name else None,
            )
        elif name in found:
            r.report("OSC403", argument.span, f"`{name}` is given twice")
        else:
            found[name] = argument.value
    if "name" not in found and "override" not in found:
        r.report("OSC404", node.span, f"`{node.kind}` lacks its argument `name`")
    return found


def _check_unique(r: Resolution, node: ast.CoverageDeclaration, env: Environment) -> None:
    """Check that no other item of its metric group has the name: overrides go by it (§7.5.6)."""
    for item, first in _repeated(env.owner).get(id(node), ()):
        r.report(
            "OSC412",
            node.span,
            f"item `{item.name}` of event `{item.event}` is declared twice",
            labels=[Label(first.node.span, "first declared here")],
        )


@lru_cache(maxsize=1)  # all items of a type are checked one after the other
def _repeated(owner: TypeSymbol | None) -> Mapping[int, list[tuple[Item, Item]]]:
    """Return by declaration the items that are declared before, each with the first one."""
    earlier: dict[tuple[str, str], Item] = {}
    found: dict[int, list[tuple[Item, Item]]] = {}
    lineage = () if owner is None else reversed(list(supertypes(owner)))
    for item in (each for type_ in lineage for each in items_of(type_)):
        first = earlier.setdefault((item.name, item.event), item)
        if first is not item:
            found.setdefault(id(item.node), []).append((item, first))
    return found


def _item_type(r: Resolution, arguments: Arguments, env: Environment) -> Type:
    """Type the sampled expression: one value, of the field of that name by default."""
    name = arguments.get("name")
    expression = arguments.get("expression", name)
    if name is not None and text_of(name) is None and not isinstance(name, ast.ItExpression):
        r.report(
            "OSC412",
            name.span,
            "the name of an item is an identifier",
            help=_named(name) if name is expression else None,
        )
    if expression is None or (expression is name and isinstance(name, ast.StringLiteral)):
        return ERROR
    type_ = r.type_of(expression, env)
    if isinstance(type_, PrimitiveType | PhysicalType | EnumType | ErrorType):
        return type_
    r.report("OSC412", expression.span, f"an item samples one value, not `{type_}`")
    return ERROR


def _named(value: ast.Expression) -> Remedy:
    """Return the remedy that gives an item a name: that of the member which it samples."""
    text = value.span.text
    name = text.replace(".", "_")
    if not name.isidentifier():
        return Remedy(f"write `<name>, expression: {text}`")
    return write(value.span, f"{name}, expression: {text}", is_safe=False)


def _with_unit(r: Resolution, node: ast.CoverageDeclaration, type_: PhysicalType) -> Help:
    """Return the remedy that adds the SI unit of an item."""
    units = (each for each in r.scope.all_units() if each.type == type_)
    names = [each.name for each in units if (each.factor, each.offset) == (1.0, 0.0)]
    if not names or not node.arguments:
        return None
    unit = min(names, key=lambda name: (len(name), name))
    return insert(node.arguments[-1].span, f", unit: {unit}", f"add `unit: {unit}`", is_safe=False)


def _check_unit(
    r: Resolution, node: ast.CoverageDeclaration, arguments: Arguments, item: Type
) -> None:
    unit = arguments.get("unit")
    if unit is None:
        if isinstance(item, PhysicalType):
            message = f"an item of type `{item}` needs `unit:`"
            r.report("OSC412", node.span, message, help=_with_unit(r, node, item))
        return
    if not isinstance(unit, ast.NameExpression):
        r.report("OSC412", unit.span, "`unit` takes the name of a unit")
        return
    symbol = r.scope.unit_named(unit.name.text)
    if symbol is None:
        known = [u.name for u in r.scope.all_units()]
        r.report(
            "OSC209", unit.span, f"no unit `{unit.name}`", help=name_meant(unit.name.span, known)
        )
        return
    r.references[unit] = symbol
    if item != ERROR and dimension_of(item) != dimension_of(symbol.type):
        r.report("OSC302", unit.span, f"`{symbol.name}` is not a unit of `{item}`")


def _check_simple(
    r: Resolution, node: ast.CoverageDeclaration, arguments: Arguments, env: Environment
) -> None:
    """Check the arguments that do not depend on the sampled value."""
    if "event" in arguments:
        _check_event(r, arguments["event"], env)
    if "text" in arguments:
        check_value(r, arguments["text"], STRING, env, "`text`")
    if "target" in arguments:
        check_value(r, arguments["target"], UINT, env, "`target`")
        if node.kind == "record":
            r.report("OSC412", arguments["target"].span, "`target` belongs to `cover`")
    disable = arguments.get("disable")
    if disable is not None and not isinstance(disable, ast.BoolLiteral):
        r.report("OSC412", disable.span, "`disable` takes `true` or `false`")


def _check_event(r: Resolution, event: ast.Expression, env: Environment) -> None:
    if isinstance(event, ast.NameExpression):
        resolve_event_path(r, event, env)
    else:
        r.report(
            "OSC412",
            event.span,
            "the event must be a name of the enclosing type",
            help=f"declare one: `event <name> is @{event.span.text}`",
        )


def _check_cross(
    r: Resolution, node: ast.CoverageDeclaration, arguments: Arguments, env: Environment
) -> None:
    """Check a cross of items: they exist, and one event samples them all (§7.5.4)."""
    items = arguments["items"]
    if not isinstance(items, ast.ListLiteral):
        r.report("OSC412", items.span, "`items` takes a list of names of items")
        return
    known = {item.name: item for item in all_items_of(env.owner) if item.node is not node}
    event = text_of(arguments.get("event"))
    for element in items.elements:
        item = known.get(text_of(element) or "")
        if item is None:
            _report_no_item(r, element, known)
            continue
        event = event or item.event
        if item.event != event:
            r.report(
                "OSC412",
                element.span,
                f"`{item.name}` is sampled by `{item.event}`, not by `{event}`",
                help="one event samples all items of a cross: state `event:` for them accordingly,"
                " or declare an item with the same `expression:` and the other event",
            )


def _report_no_item(r: Resolution, name: ast.Expression, known: Mapping[str, Item]) -> None:
    text = text_of(name)
    r.report(
        "OSC412",
        name.span,
        f"no coverage item `{text or name.span.text}` in this type",
        help=name_meant(name.span, known),
    )


def _check_override(
    r: Resolution, arguments: Arguments, env: Environment
) -> tuple[str | None, Type]:
    """Check that an item of the same type is refined, in arguments that may change (§7.5.6)."""
    for fixed in FIXED:
        if fixed in arguments:
            r.report("OSC412", arguments[fixed].span, f"an override cannot change `{fixed}`")
    overridden = arguments["override"]
    known = {item.name: item for item in items_of(env.owner)}
    item = known.get(text_of(overridden) or "")
    if item is None:
        _report_no_item(r, overridden, known)
        return None, ERROR
    expression = item.expression
    if expression is None or isinstance(expression, ast.StringLiteral):
        return item.name, ERROR
    return item.name, r.type_of(expression, env)


def _check_filter(
    r: Resolution, expression: ast.Expression, name: str | None, item: Type, env: Environment
) -> None:
    """Check `ignore` and `illegal`: a condition over the item and constants alone."""
    value = ParameterSymbol(
        name=name or "", namespace=env.context.namespace, span=expression.span, type=item
    )
    check_condition(r, expression, env.with_it(item).with_locals([value]))
    for path in paths_of(expression):
        root = root_of(path)
        symbol = r.references.get(root)
        if isinstance(root, ast.NameExpression) and not (
            symbol is None or symbol is value or isinstance(symbol, EnumMemberSymbol)
        ):
            r.report(
                "OSC412",
                root.span,
                f"only the item and constants may be used here, not `{symbol.name}`",
            )
            return
