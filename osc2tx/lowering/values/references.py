"""Names and paths, resolved to fields, parameters, labels and objects."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.analysis.constraints.parameter_lookup import is_actor
from osc2tx.diagnostics import Span
from osc2tx.lowering.behavior.composed_behaviors import is_composed
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.declarations.global_names import field_name, global_name
from osc2tx.lowering.declarations.map_fields import is_given_by_map
from osc2tx.lowering.value_types import PLAIN, SCENARIO, lower_type
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.scope import is_subtype
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace


def lower_name(
    ctx: LoweringContext, node: ast.EnumLiteral | ast.NameExpression, type_: ir.ValueType
) -> ir.Expression | None:
    """Lower a single name."""
    match ctx.model.symbol_of(node):
        case sym.EnumMemberSymbol(value=value, enum=enum):
            # Members of equal value are one (§7.3.3), with the name of the first.
            name = next(m.name for m in enum.members.values() if m.value == value)
            enum_type = ir.ValueType(ir.Kind.ENUM, enum.name)
            return ir.EnumValue(span=node.span, type=enum_type, member=name, value=value)
        case sym.FieldSymbol(node=None, name="actor") if ctx.actor is not None:
            return replace(ctx.actor, span=node.span)
        case sym.FieldSymbol() as field if field in ctx.attached:
            name = ctx.attached[field]
            return ir.FieldRef(span=node.span, type=type_, name=name, is_variable=True)
        case sym.FieldSymbol() as field if (meant := alias_of(ctx, field)) is not None:
            return ctx.lower(meant)
        case sym.FieldSymbol() if (given := _given(ctx, node)) is not None:
            return replace(given, span=node.span)
        case sym.FieldSymbol(node=None, name="actor"):
            return ir.FieldRef(span=node.span, type=type_, name="actor")
        case sym.FieldSymbol() as member if (base := _base_of(ctx, member)) is not None:
            return member_of(ctx, base, member, node.span)
        case sym.FieldSymbol(owner=owner, name=name) as own if is_composed(owner):
            changes = isinstance(own.default, ast.SampleExpression)
            return ir.FieldRef(span=node.span, type=type_, name=name, is_variable=changes)
        case sym.FieldSymbol(owner=None) as shared if shared.node is not None:
            return ir.FieldRef(span=node.span, type=type_, name=global_name(ctx, shared))
        case sym.ParameterSymbol(name=name) if name in ctx.locals:
            return replace(ctx.locals[name], span=node.span)
        case sym.ParameterSymbol(name=name):
            return ir.ParameterRef(span=node.span, type=type_, name=name)
        case _:
            ctx.unsupported("OSC503", node.span, f"`{node.span.text}` cannot be used here yet")
            return None


def alias_of(ctx: LoweringContext, field: sym.FieldSymbol) -> ast.Expression | None:
    """Return the target of a field that is only another name for it, and is not declared itself.

    This is another actor (`other: vehicle = npc`) unless an invocation passes one, or a quantity
    that a dialect names by a string.
    """
    if isinstance(field.default, ast.StringLiteral):
        return ctx.model.quantities.get(field.default)
    return None if field in ctx.program.handed_in else other_actor(ctx, field)


def other_actor(ctx: LoweringContext, field: sym.FieldSymbol) -> ast.NameExpression | None:
    """Return the actor that is the default of an actor, or that a constraint equates with it."""
    if not isinstance(field.type, types.ActorType):
        return None
    if isinstance(field.default, ast.NameExpression):
        return field.default
    same = ctx.same_actors.get(field)
    return None if same is None else same.name


def lower_member(
    ctx: LoweringContext,
    node: ast.MemberAccess,
    base: ast.Expression,
    name: ast.Name,
    type_: ir.ValueType,
) -> ir.Expression | None:
    """Lower `base.name`."""
    event = ctx.state.event_fields.get(id(ctx.model.symbol_of(base)))
    if event is not None:
        path, owner = event
        return ir.EventArgument(
            span=node.span, type=type_, event=path, parameter=name.text, owner=owner
        )
    field = ctx.model.symbol_of(node)
    if not isinstance(field, sym.FieldSymbol):
        ctx.unsupported("OSC503", node.span, f"`{node.span.text}` cannot be used here yet")
        return None
    label = ctx.model.symbol_of(base)
    if isinstance(label, sym.LabelSymbol):
        return _of_label(ctx, node, label, field, type_)
    key = ctx.place.locate(node) if ctx.place is not None else None
    if is_actor(field):  # `it.actor`
        if key is not None and isinstance(key[0], sym.FieldSymbol) and not is_actor(key[0]):
            return lower_key(ctx, key, node.span)
        if ctx.actor is not None:
            return replace(ctx.actor, span=node.span)
    if key is not None and not isinstance(key[0], sym.FieldSymbol):
        return lower_key(ctx, key, node.span)
    lowered = ctx.lower(base)
    if isinstance(field.owner, sym.BehaviorSymbol) and type_.kind not in PLAIN:
        ctx.unsupported(
            "OSC501",
            node.span,
            f"`{node.span.text}` has no value: nothing invokes `{base.span.text}`",
            help="read plain values of it only, or declare the object in the scenario",
        )
        return None
    return None if lowered is None else member_of(ctx, lowered, field, node.span)


def _of_label(
    ctx: LoweringContext,
    node: ast.MemberAccess,
    label: sym.LabelSymbol,
    field: sym.FieldSymbol,
    type_: ir.ValueType,
) -> ir.Expression | None:
    """Return a parameter of a labelled member: the given value, or its choice."""
    given = ctx.state.given.get((label.node, field))
    if given is not None:
        return replace(given, span=node.span)
    binding = ctx.model.bindings.get(label.node)
    if binding is not None and is_composed(binding.callee) and field.owner:
        return ir.InvokedValue(span=node.span, type=type_, label=label.name, name=field.name)
    ctx.unsupported(
        "OSC503",
        node.span,
        f"`{node.span.text}` has no value",
        help=f"pass the value to `{label.name}` as an argument, above this line",
    )
    return None


def member_of(
    ctx: LoweringContext, base: ir.Expression, field: sym.FieldSymbol, span: Span
) -> ir.Expression:
    """Return a field of an object; one that is sampled is a variable of the scenario."""
    type_ = lower_type(field.type)
    path = path_of(base) if isinstance(field.default, ast.SampleExpression) else None
    if path is not None and not is_composed(field.owner):
        name = f"{path}.{field.name}"
        ctx.state.object_variables.setdefault(name, (field, base))
        return ir.FieldRef(span=span, type=type_, name=name, is_variable=True)
    if isinstance(base, ir.ScenarioSelf):
        return ir.FieldRef(span=span, type=type_, name=field.name)
    if isinstance(base, ir.FieldRef) and isinstance(field.owner, sym.BehaviorSymbol):
        return ir.FieldRef(span=span, type=type_, name=f"{base.name}.{field.name}")
    return ir.Attribute(
        span=span,
        type=type_,
        base=base,
        owner=field.owner.name if field.owner is not None else "",
        name=field.name,  # not as written: a dialect may know it by another name
        is_variable=field.is_variable or is_given_by_map(field),
    )


def path_of(object_: ir.Expression) -> str | None:
    """Return the path to an object from the fields of the scenario; `None` if it is computed."""
    match object_:
        case ir.FieldRef(name=name):
            return name
        case ir.Downcast(operand=operand):
            return path_of(operand)
        case ir.Attribute(base=base, name=name) if (path := path_of(base)) is not None:
            return f"{path}.{name}"
        case _:
            return None


def lower_key(ctx: LoweringContext, key: Key, span: Span) -> ir.Expression | None:
    """Return the meaning of a path of the analysis; an empty one is the scenario itself."""
    if not key:
        return ir.ScenarioSelf(span=span, type=SCENARIO)
    first, *rest = key
    expression: ir.Expression | None
    if isinstance(first, sym.FieldSymbol) and (meant := alias_of(ctx, first)) is not None:
        expression = ctx.lower(meant)
    elif isinstance(first, sym.FieldSymbol):
        type_, name = lower_type(first.type), field_name(ctx, first)
        expression = ir.FieldRef(span=span, type=type_, name=name)
    elif ctx.actor is not None and (at := _place_of_actor(key)) is not None:
        expression, rest = ctx.actor, list(key[at + 1 :])
    elif lengths := [n for n in range(2, len(key) + 1) if key[:n] in ctx.state.given]:
        expression, rest = ctx.state.given[key[: lengths[0]]], list(key[lengths[0] :])
    else:
        ctx.unsupported("OSC502", span, "the subject of this constraint has no value")
        return None
    for field in rest:
        if isinstance(field, sym.FieldSymbol) and expression is not None:
            expression = member_of(ctx, expression, field, span)
    return expression


def _place_of_actor(key: Key) -> int | None:
    """Return the index of the implicit field `actor` of a behavior in a path."""
    places = (n for n, part in enumerate(key) if isinstance(part, sym.Symbol) and is_actor(part))
    return next(places, None)


def element_of(ctx: LoweringContext, node: ast.Index) -> ir.FieldRef | None:
    """Return an element of a list that is a declared object (§7.3.5.2.1)."""
    symbol = ctx.model.symbol_of(node.base)
    if ctx.place is not None:
        key = ctx.place.locate(node.base)
        symbol = key[0] if key and len(key) == 1 and isinstance(key[0], sym.Symbol) else None
    element = ctx.model.element_of(symbol, node.index)
    if element is None:
        return None
    return ir.FieldRef(span=node.span, type=lower_type(element.type), name=element.name)


def _given(ctx: LoweringContext, node: ast.Expression) -> ir.Expression | None:
    """Return the value of a parameter of an invocation or modifier, in its own text.

    Elsewhere such a name is the duration of the scenario.
    """
    symbol = ctx.model.symbol_of(node)
    own = None if symbol is None else (symbol,)
    key = own if ctx.place is None else ctx.place.locate(node)
    return None if key is None else ctx.state.given.get(key)


def _base_of(ctx: LoweringContext, field: sym.FieldSymbol) -> ir.Expression | None:
    """Return the object whose member a plain name means, if that is not the scenario."""
    place, receiver = ctx.place, ctx.receiver
    if receiver and field.owner and is_subtype(receiver.owner, field.owner):
        return receiver.value
    if place is None or field.owner is None:
        return None
    if place.owner is not None and is_subtype(place.owner, field.owner):
        if place.prefix:
            return lower_key(ctx, place.prefix, field.span)
        if isinstance(place.owner, sym.ActorSymbol):  # of the actor of the behavior
            type_ = lower_type(types.ActorType(place.owner))
            return ir.FieldRef(span=field.span, type=type_, name="actor")
        return None
    if place.it and place.it_type and is_subtype(place.it_type, field.owner):
        return lower_key(ctx, place.it, field.span)
    return None
