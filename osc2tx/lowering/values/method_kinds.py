"""External methods (§7.3.7): user code that runs only if allowed by name."""

from __future__ import annotations

from collections.abc import Iterator

from osc2tx import ir
from osc2tx.analysis import ConstraintAnalysis
from osc2tx.lowering.context import LoweringContext
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.model import SemanticModel
from osc2tx.semantics.scope import is_subtype, supertypes
from osc2tx.syntax import ast

LANGUAGE = ("python",)
ARGUMENTS = ("module", "name")


def listed_arguments(body: ast.Node) -> tuple[ast.Argument, ...]:
    """Return the arguments of an external body that list the arguments of its function."""
    if not isinstance(body, ast.ExternalBody):
        return ()
    return tuple(
        argument
        for argument in body.arguments
        if argument.name is not None
        and argument.name.text not in ARGUMENTS
        and isinstance(argument.value, ast.NameExpression)
    )


def lower_external(
    ctx: LoweringContext, method: sym.MethodSymbol, body: ast.ExternalBody
) -> ir.External | None:
    """Lower `external python(module: "m", name: "f")`; the name is optional.

    The function gets the object, if the method belongs to one, and the parameters of the method. If
    they follow the name, as in `param: x`, it gets only these.
    """
    where = ".".join(body.path)
    if tuple(body.path) != LANGUAGE:
        ctx.unsupported(
            "OSC512",
            body.span,
            f"external methods of `{where}` cannot be called",
            help='write `external python(module: "m", name: "f")`',
        )
        return None
    given: dict[str, str] = {}
    own = [parameter.name for parameter in method.parameters]
    handed_on = listed_arguments(body)
    if handed_on and [a.value.span.text for a in handed_on] != own:
        ctx.unsupported(
            "OSC512",
            handed_on[0].span.to(handed_on[-1].span),
            "the function gets the parameters of the method, in order",
            help="leave this out",
        )
        return None
    named = [argument for argument in body.arguments if argument not in handed_on]
    for argument, expected in zip(named, (*ARGUMENTS, None, None), strict=False):
        name = expected if argument.name is None else argument.name.text
        if name not in ARGUMENTS or not isinstance(argument.value, ast.StringLiteral):
            ctx.unsupported(
                "OSC512", argument.span, "`python` takes `module` and `name`, as plain strings"
            )
            return None
        given[name] = argument.value.value
    path = (given.get("module", ""), given.get("name", method.name))
    if not all(part.isidentifier() for text in path for part in text.split(".")):
        ctx.unsupported(
            "OSC512",
            body.span,
            f"`{path[0]}` is no module with a function `{path[1]}`",
            help='name both, as in `external python(module: "m", name: "f")`',
        )
        return None
    return ir.External(module=path[0], function=path[1])


def object_types(model: SemanticModel, analysis: ConstraintAnalysis) -> tuple[sym.TypeSymbol, ...]:
    """Return the types of which a program may have objects, types of fields first."""
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
    """Return the overriding methods of subtypes, the most derived types first.

    Only types with objects in the program count.
    """
    owner = method.owner
    if not isinstance(owner, sym.ActorSymbol | sym.StructSymbol):
        return ()
    used = (t for object_ in ctx.program.object_types for t in supertypes(object_))
    below = [t for t in dict.fromkeys(used) if t is not owner and is_subtype(t, owner)]
    below.sort(key=lambda type_: -len(list(supertypes(type_))))
    found = (type_.members.get(method.name) for type_ in below)
    return tuple(each for each in found if isinstance(each, sym.MethodSymbol))
