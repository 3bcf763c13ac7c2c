"""Arguments for parameters whose value an invoked scenario states itself."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.analysis import single_value
from osc2tx.lowering.behavior.composed_behaviors import Composed
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.names.member_lookup import parameters_of
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace


def without_fixed(
    ctx: LoweringContext,
    constraints: ConstraintLowering,
    node: ast.Invocation,
    callee: Composed,
    arguments: tuple[ir.Argument, ...],
) -> tuple[ir.Argument, ...]:
    """Return the arguments for parameters that a scenario leaves open.

    A constant that contradicts the scenario is an error already; an open value may do so. Where
    the scenario computes a parameter from others, these get the values that make it the argument.
    """
    domains = ctx.program.analysis.types[callee].domains_to_set()
    fixed = set()
    for parameter in parameters_of(callee):
        domain = domains.get((parameter,))
        if domain is not None and single_value(domain) is not None:
            fixed.add(parameter.name)
    computed = _computed(ctx, callee, arguments)
    stated = {a.parameter for a in arguments if not _is_open(a)}  # constants, which are checked
    supplied: dict[str, ir.Argument] = {}
    actors = set()
    for argument in arguments:
        name = argument.parameter
        if argument.value.type.kind is ir.Kind.ACTOR:
            actors.add(name)
        elif name in fixed and _is_open(argument):
            ctx.unsupported(
                "OSC501",
                argument.span,
                f"`{callee.qualified_name}` fixes `{name}` to one value; this"
                " argument is open and may differ",
                help="omit the argument, or the constraint in the scenario",
            )
        elif name in computed:
            missing = [o for o in computed[name] if o.name not in stated | computed.keys()]
            found = _supplied(constraints, node, argument, missing)
            if _is_open(argument) or len(found) < len(missing):
                names = " and ".join(f"`{each.name}`" for each in computed[name])
                ctx.unsupported(
                    "OSC501",
                    argument.span,
                    f"`{callee.qualified_name}` computes `{name}` from {names}",
                    help=f"give {names} instead",
                )
            supplied |= found
    left_out = fixed | (computed.keys() - actors)  # the run checks that two actors are the same
    kept = tuple(each for each in arguments if each.parameter not in left_out)
    given = {argument.parameter for argument in arguments}
    return (*kept, *(each for name, each in supplied.items() if name not in left_out | given))


def _is_open(argument: ir.Argument) -> bool:
    return any(isinstance(part, ir.FieldRef) for part in ir.walk(argument.value))


def _computed(
    ctx: LoweringContext, callee: Composed, arguments: tuple[ir.Argument, ...]
) -> dict[str, list[sym.FieldSymbol]]:
    """Return the parameters that the scenario computes from others, with those."""
    parameters = list(parameters_of(callee))
    related = {each.name: _related(ctx, callee, each) for each in parameters}
    if not any(related.get(each.parameter) for each in arguments):
        return {}
    found = {}
    inside = ConstraintLowering.of_scenario(ctx.quiet(), callee)
    for parameter in parameters:
        setting = inside.setting((parameter,), parameter.type)
        if setting.is_fixed and related[parameter.name]:
            found[parameter.name] = related[parameter.name]
    return found


def _related(
    ctx: LoweringContext, callee: Composed, parameter: sym.FieldSymbol
) -> list[sym.FieldSymbol]:
    """Return the parameters that hard constraints relate to one."""
    found: dict[sym.FieldSymbol, None] = {}
    for constraint in ctx.program.analysis.types[callee].by_key.get((parameter,), ()):
        for key in () if constraint.is_default else constraint.operations.keys_in_order:
            if len(key) == 1 and isinstance(key[0], sym.FieldSymbol) and key[0] is not parameter:
                found[key[0]] = None
    return list(found)


def _supplied(
    constraints: ConstraintLowering,
    node: ast.Invocation,
    argument: ir.Argument,
    parameters: list[sym.FieldSymbol],
) -> dict[str, ir.Argument]:
    """Return the values that an argument leaves other parameters, where each has only one."""
    found = {}
    for parameter in parameters:
        setting = constraints.setting((node, parameter), parameter.type)
        if setting.is_fixed and setting.value is not None:
            name = parameter.name
            found[name] = replace(
                argument, parameter=name, value=setting.value, is_positional=False
            )
    return found
