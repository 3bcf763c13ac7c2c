"""Methods that types override (§7.3.7): the object decides which of them a call means.

The method of the general type asks the object, and calls the one of its type.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from osc2tx import ir
from osc2tx.analysis import ConstraintAnalysis
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import lower_type
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.model import SemanticModel
from osc2tx.semantics.scope import is_subtype, supertypes

BOOL = ir.ValueType(ir.Kind.BOOL, "bool")


def object_types(model: SemanticModel, analysis: ConstraintAnalysis) -> tuple[sym.TypeSymbol, ...]:
    """Return the types of which a program may have objects, those of fields first."""
    owners = (symbol for symbol in model.symbols if isinstance(symbol, sym.TypeSymbol))
    fields = (member for owner in owners for member in owner.members.values())
    declared = (type_ for field in fields for type_ in _types(field))
    by_condition = (
        special
        for constraints in analysis.types.values()
        for types_ in constraints.special.values()
        for special in types_
    )
    return tuple(dict.fromkeys((*declared, *by_condition)))


def _types(member: sym.Member) -> Iterator[sym.TypeSymbol]:
    type_ = member.type if isinstance(member, sym.FieldSymbol) else None
    while isinstance(type_, types.ListType):
        type_ = type_.element
    if isinstance(type_, types.ActorType | types.StructType):
        yield type_.symbol


def overriding_methods(
    ctx: LoweringContext, method: sym.MethodSymbol
) -> tuple[sym.MethodSymbol, ...]:
    """Return the methods of subtypes that stand for a method, the most special types first.

    Only types of which the program has objects count.
    """
    owner = method.owner
    if not isinstance(owner, sym.ActorSymbol | sym.StructSymbol):
        return ()
    used = (t for object_ in ctx.object_types for t in supertypes(object_))
    below = [t for t in dict.fromkeys(used) if t is not owner and is_subtype(t, owner)]
    below.sort(key=lambda type_: -len(list(supertypes(type_))))
    found = (type_.members.get(method.name) for type_ in below)
    return tuple(each for each in found if isinstance(each, sym.MethodSymbol))


def dispatched(
    ctx: LoweringContext,
    object_: ir.Expression,
    arguments: Sequence[ir.MethodParameter],
    overriding: Iterable[sym.MethodSymbol],
    body: ir.Expression | None,
) -> ir.Expression | None:
    """Return the body of a method that other types override.

    Args:
        ctx: The checked program.
        object_: The object.
        arguments: The parameters of the method, the object first.
        overriding: The other methods, those of the most special types first.
        body: What it is for all other objects; `None` if that is undefined.
    """
    result = body
    for method in reversed(tuple(overriding)):
        assert isinstance(method.owner, sym.ActorSymbol | sym.StructSymbol)
        special = _type_of(method.owner)
        call = _call(ctx, method, object_, special, arguments, is_certain=result is not None)
        if result is None:
            result = call  # for objects of no such type it is an error
            continue
        test = ir.TypeTest(span=object_.span, type=BOOL, operand=object_, tested=method.owner.name)
        result = ir.Conditional(
            span=call.span, type=call.type, condition=test, when_true=call, when_false=result
        )
    return result


def _call(
    ctx: LoweringContext,
    method: sym.MethodSymbol,
    object_: ir.Expression,
    special: ir.ValueType,
    parameters: Sequence[ir.MethodParameter],
    *,
    is_certain: bool,
) -> ir.MethodCall:
    from osc2tx.lowering.calls import is_pure, method_name

    span = object_.span
    if not is_certain:
        object_ = ir.Downcast(span=span, type=special, operand=object_)
    given = (
        object_,
        *(ir.ParameterRef(span=span, type=p.type, name=p.name) for p in parameters[1:]),
    )
    name = method_name(method)
    ctx.methods.setdefault(name, method)
    return ir.MethodCall(
        span=span,
        type=lower_type(method.result),
        base=ir.ScenarioSelf(span=span, type=ir.ValueType(ir.Kind.STRUCT, "scenario")),
        owner=method.owner.name if method.owner is not None else "",
        method=name,
        arguments=tuple(
            ir.Argument(parameter="", value=value, is_positional=True, span=span) for value in given
        ),
        is_pure=is_pure(ctx, method),
    )


def _type_of(owner: sym.ActorSymbol | sym.StructSymbol) -> ir.ValueType:
    is_actor = isinstance(owner, sym.ActorSymbol)
    return ir.ValueType(ir.Kind.ACTOR if is_actor else ir.Kind.STRUCT, owner.name)
