"""Expressions of conditions as triggers: an OR of ANDs of comparisons with constants."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx import ir
from osc2tx.backends.xosc.actions.signals.traffic_lights import lamps_condition, shows
from osc2tx.backends.xosc.conditions.comparisons import Comparison, Groups, relative_speed
from osc2tx.backends.xosc.conditions.event_parameters import parameter_condition
from osc2tx.backends.xosc.conditions.flow import NEVER, Edge, Flow, Test, all_of, any_of
from osc2tx.backends.xosc.conditions.measures import FINITE, MEASURES
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.values.constants import Constant, Named
from osc2tx.losses.entries import GENERIC, Inexpressible, Remedy
from osc2tx.xosc.literals import Rule

RULES: Mapping[str, Rule] = {
    ">": "greaterThan",
    "<": "lessThan",
    ">=": "greaterOrEqual",
    "<=": "lessOrEqual",
    "==": "equalTo",
    "!=": "notEqualTo",
}
OPPOSITE = {">": "<=", "<": ">=", ">=": "<", "<=": ">", "==": "!=", "!=": "=="}
SWAPPED = {">": "<", "<": ">", ">=": "<=", "<=": ">=", "==": "==", "!=": "!="}
MOST_GROUPS = 16

ALWAYS = Flow(((),))


def condition_flow(ctx: Context, condition: ir.Condition) -> Flow:
    """Return the tests of a level or an edge."""
    match condition:
        case ir.Level(expression=expression):
            return level_flow(ctx, expression)
        case ir.Edge(expression=expression, rising=rising):
            return _edge_flow(ctx, expression, rising=rising)
    raise Inexpressible(f"`{condition.span.text}` has no counterpart here", condition.span)


def level_flow(ctx: Context, expression: ir.Expression) -> Flow:
    """Return the tests of a truth value."""
    found = _flow(ctx, expression, negated=False, edge="none")
    if len(found.groups) > MOST_GROUPS:
        reason = f"the condition has {len(found.groups)} alternatives; {MOST_GROUPS} are the most"
        raise Inexpressible(reason, expression.span)
    return found


def _edge_flow(ctx: Context, expression: ir.Expression, *, rising: bool) -> Flow:
    while isinstance(expression, ir.Unary) and expression.operator == "not":
        expression, rising = expression.operand, not rising
    lamps = lamps_condition(expression)
    if lamps is not None:
        if not ctx.profile.has_edges:
            reason = f"{ctx.profile.name} does not look at edges"
            raise Inexpressible(reason, expression.span, GENERIC)
        return _light_edge(ctx, lamps, rising=rising)
    if not (isinstance(expression, ir.Binary) and expression.operator in RULES):
        raise Inexpressible(
            "`rise` and `fall` of more than one comparison have no counterpart", expression.span
        )
    return _comparison(ctx, expression, expression.operator, "rising" if rising else "falling")


def _flow(ctx: Context, expression: ir.Expression, *, negated: bool, edge: Edge) -> Flow:
    lamps = lamps_condition(expression)
    if lamps is not None and not negated:
        return Flow((tuple(Test(each, edge) for each in shows(ctx, lamps)),))
    match expression:
        case ir.Unary(operator="not", operand=operand):
            return _flow(ctx, operand, negated=not negated, edge=edge)
        case ir.Binary(operator="=>", left=left, right=right):
            first = _flow(ctx, left, negated=not negated, edge=edge)
            second = _flow(ctx, right, negated=negated, edge=edge)
            return first & second if negated else first | second
        case ir.Binary(operator="and" | "or" as operator):
            joined = all_of if (operator == "and") is not negated else any_of
            operands = _operands(expression, operator)
            return joined([_flow(ctx, each, negated=negated, edge=edge) for each in operands])
        case ir.Binary(operator=operator) if operator in RULES and ir.is_live(expression):
            return _comparison(ctx, expression, OPPOSITE[operator] if negated else operator, edge)
    if isinstance(expression, ir.EventArgument):  # a truth value
        return Flow(((Test(parameter_condition(ctx, expression, "equalTo", not negated), edge),),))
    if not ir.is_live(expression):
        return ALWAYS if bool(ctx.values.of(expression)) is not negated else NEVER
    raise Inexpressible(
        f"`{expression.span.text}` is no comparison with a constant", expression.span
    )


def _operands(expression: ir.Expression, operator: str) -> list[ir.Expression]:
    """Return what a chain of one operator joins, from left to right."""
    found = []
    while isinstance(expression, ir.Binary) and expression.operator == operator:
        found.append(expression.right)
        expression = expression.left
    return [expression, *reversed(found)]


def _light_edge(ctx: Context, call: ir.MethodCall, *, rising: bool) -> Flow:
    """Return the tests for the moment at which all lights show something, or no longer do."""
    conditions = shows(ctx, call)
    if not rising and len(conditions) > 1:
        raise Inexpressible("the moment at which a group shows something else", call.span)
    edge: Edge = "rising" if rising else "falling"
    groups = []
    for last in conditions:  # whichever is the last one to show it
        others = tuple(Test(each) for each in conditions if each is not last)
        groups.append((*others, Test(last, edge)))
    return Flow(tuple(groups))


def _comparison(ctx: Context, expression: ir.Binary, operator: str, edge: Edge) -> Flow:
    left, right = expression.left, expression.right
    if not ir.is_live(left):
        left, right, operator = right, left, SWAPPED[operator]
    if edge == "falling" and isinstance(left, ir.MethodCall) and left.method in FINITE:
        operator, edge = OPPOSITE[operator], "rising"
    rule = _rule(ctx, operator, expression)
    speeds = _speeds(ctx, left, right)
    if isinstance(left, ir.EventArgument) and not ir.is_live(right):
        groups: Groups = ((parameter_condition(ctx, left, rule, ctx.values.of(right)),),)
    elif speeds is not None:
        actor, other, difference = speeds
        groups = relative_speed(actor, other, rule, difference)
    elif ir.is_live(right):
        raise Inexpressible(
            "a condition compares one measure with a constant, not two measures",
            expression.span,
            Remedy(instead="two speeds compare exactly as in `a.speed > b.speed + 2mps`"),
        )
    else:
        groups = _measured(ctx, left, rule, ctx.values.number(right), edge)
    tests = []
    for first, *others in groups:
        tests.append((Test(first, edge), *(Test(other) for other in others)))
    return Flow(tuple(tests))


def _speeds(
    ctx: Context, left: ir.Expression, right: ir.Expression
) -> tuple[str, str, float] | None:
    """Return two actors and by how much the speed of the first one has to exceed the other's."""
    difference = 0.0
    if isinstance(left, ir.Binary) and left.operator == "-" and not ir.is_live(right):
        difference, right, left = ctx.values.number(right), left.right, left.left
    if isinstance(right, ir.Binary) and right.operator in ("+", "-"):
        constant = right.right
        other = right.left
        if right.operator == "+" and ir.is_live(constant):
            constant, other = other, constant
        if ir.is_live(constant):
            return None
        sign = 1.0 if right.operator == "+" else -1.0
        difference, right = difference + sign * ctx.values.number(constant), other
    mine, theirs = _speed_of(ctx, left), _speed_of(ctx, right)
    return None if mine is None or theirs is None else (mine, theirs, difference)


def _speed_of(ctx: Context, expression: ir.Expression) -> str | None:
    """Return the entity whose speed an expression is."""
    if not isinstance(expression, ir.Attribute) or expression.name != "speed":
        return None
    if not ir.is_live(expression) or not isinstance(expression.base, ir.FieldRef):
        return None
    actor = ctx.values.of(expression.base)
    if not isinstance(actor, Named) or actor.name not in ctx.cast:
        return None
    return ctx.cast[actor.name].name


def _rule(ctx: Context, operator: str, expression: ir.Binary) -> Rule:
    """Return the literal; 1.0 has no rules that include the boundary."""
    if ctx.version > "1.0" or operator in (">", "<", "=="):
        return RULES[operator]
    if operator == "!=":
        ctx.require("the rule `notEqualTo`", "1.1", expression.span)
    strict = operator[0]
    reason = f"OpenSCENARIO XML 1.0 has no rule for `{operator}`; `{strict}` is written"
    ctx.report.doubt(f"`{operator}`", expression.span, reason, Remedy(version="1.1"))
    return RULES[strict]


def _measured(ctx: Context, measure: ir.Expression, rule: Rule, value: float, edge: Edge) -> Groups:
    match measure:
        case ir.Attribute(base=base, name=name):
            arguments: dict[str, Constant] = {}
        case ir.MethodCall(base=base, method=name):
            arguments = {a.parameter: _argument(ctx, a.value) for a in measure.arguments}
        case _:
            raise Inexpressible(
                f"`{measure.span.text}` is computed, and OpenSCENARIO XML does not compute",
                measure.span,
            )
    path = name
    while isinstance(base, ir.Attribute):
        path, base = f"{base.name}.{path}", base.base
    actor = ctx.values.of(base)
    if path in MEASURES or isinstance(measure, ir.Attribute):
        name = path
    found = MEASURES.get(name)
    if found is None or not isinstance(actor, Named) or actor.name not in ctx.cast:
        waiting = Remedy(instead="a wait for the event or time at which it changes is exact")
        raise Inexpressible(
            f"there is no condition on `{measure.span.text}`", measure.span, waiting
        )
    comparison = Comparison(
        actor=ctx.cast[actor.name].name,
        name=name,
        arguments=arguments,
        rule=rule,
        value=value,
        is_edge=edge != "none",
        source=measure,
    )
    return found(ctx, comparison)


def _argument(ctx: Context, expression: ir.Expression) -> Constant:
    """Return the value of an argument; actors by their names in the XML."""
    value = ctx.values.of(expression)
    if isinstance(value, Named) and value.name in ctx.cast:
        return Named(ctx.cast[value.name].name)
    return value
