"""User-defined shapes as arguments of modifiers (§8.9.1.2)."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import SCENARIO
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.model import Binding
from osc2tx.semantics.scope import supertypes
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace

PARAMETER = "shape"

# How a value is reached, so that it does not hold at the start.
COURSE = frozenset({PARAMETER, "rate_profile", "rate_peak"})

# The parameter whose value a shape gives the course of.
VALUES = {"lateral": "distance", "position": "distance", "speed": "speed"}

SECOND = ir.Unit("s", 1.0, 0.0, is_standard=True)


def with_shapes(
    ctx: LoweringContext, binding: Binding, arguments: tuple[ir.Argument, ...]
) -> tuple[ir.Argument, ...]:
    """Pass the methods of the shapes among the arguments of a modifier to the runtime."""
    if binding.callee.origin != "library":
        return arguments
    nodes = {parameter.name: value for parameter, value in binding.arguments}
    return tuple(
        (
            _with_methods(ctx, argument, nodes[PARAMETER])
            if argument.parameter == PARAMETER
            else argument
        )
        for argument in arguments
    )


def is_left_open(ctx: LoweringContext, method: sym.MethodSymbol, receiver: ast.Expression) -> bool:
    """Whether a method of the library's shapes has no meaning for an object of this type."""
    owner, type_ = method.owner, ctx.model.type_of(receiver)
    if owner is None or owner.origin != "library" or not _is_shape(owner):
        return False
    symbol = type_.symbol if isinstance(type_, types.StructType) else owner
    return not any(each.name.startswith("common_") for each in supertypes(symbol))


def states_start(modifier: ir.ModifierCall) -> bool:
    """Whether a modifier of the whole phase states its value at the start."""
    if modifier.at == "start":
        return True
    courses = [argument for argument in modifier.arguments if argument.parameter in COURSE]
    computed = all(isinstance(argument.value, ir.UserShape) for argument in courses)
    return not courses or (computed and modifier.name in VALUES)


def first_value(modifier: ir.ModifierCall) -> ir.ModifierCall:
    """Return a modifier with the value that its shape computes for the start."""
    shape = next((a.value for a in modifier.arguments if isinstance(a.value, ir.UserShape)), None)
    parameter = VALUES.get(modifier.name)
    if shape is None or parameter is None:
        return modifier
    time = ir.Quantity(
        span=shape.span, type=ir.ValueType(ir.Kind.QUANTITY, "time"), value=0, unit=SECOND
    )
    given = (shape.operand, time)
    value = ir.MethodCall(
        span=shape.span,
        type=ir.ValueType(ir.Kind.QUANTITY, "speed" if parameter == "speed" else "length"),
        base=ir.ScenarioSelf(span=shape.span, type=SCENARIO),
        owner=shape.kind,
        method=shape.compute,
        arguments=tuple(
            ir.Argument(parameter="", value=each, is_positional=True, span=shape.span)
            for each in given
        ),
        is_pure=True,
    )
    others = (a for a in modifier.arguments if a.parameter not in (PARAMETER, parameter))
    first = ir.Argument(parameter=parameter, value=value, is_positional=True, span=shape.span)
    return replace(modifier, arguments=(first, *others))


def _is_shape(type_: sym.TypeSymbol) -> bool:
    return any(each.name == "any_shape" for each in supertypes(type_))


def _with_methods(ctx: LoweringContext, argument: ir.Argument, node: ast.Expression) -> ir.Argument:
    type_ = next((each for each in ctx.used.types if each.name == argument.value.type.name), None)
    if type_ is None:
        written = ctx.model.type_of(node)
        type_ = written.symbol if isinstance(written, types.StructType) else None
    if type_ is None or not _is_shape(type_):
        return argument
    compute, duration = (_method(type_, name) for name in ("compute", "duration"))
    if compute is None and any(each.name.startswith("common_") for each in supertypes(type_)):
        return argument
    if compute is None:
        ctx.unsupported(
            "OSC503",
            argument.span,
            f"`{type_.name}` does not state its computation",
            help="derive a shape from it, with `def compute(time: time) -> … is expression …`",
        )
        return argument
    for method in (compute, duration):
        if method is not None:
            ctx.state.methods.setdefault(_name(method), method)
    kinds = (each.name for each in supertypes(type_) if each.origin == "library")
    own = ir.UserShape(
        span=argument.value.span,
        type=argument.value.type,
        operand=argument.value,
        kind=next(kinds).replace("common_", "any_"),
        compute=_name(compute),
        duration=None if duration is None else _name(duration),
    )
    return replace(argument, value=own)


def _method(type_: sym.TypeSymbol, name: str) -> sym.MethodSymbol | None:
    """Return the method of the user's that an object of a type has; `None` without one."""
    for each in supertypes(type_):
        member = each.members.get(name) if each.origin == "user" else None
        if isinstance(member, sym.MethodSymbol) and member.node is not None:
            return None if isinstance(member.node.body, ast.UndefinedBody) else member
    return None


def _name(method: sym.MethodSymbol) -> str:
    """Return its name as a method of the scenario; see `calls.method_name`."""
    return method.name if method.owner is None else f"{method.owner.name}.{method.name}"
