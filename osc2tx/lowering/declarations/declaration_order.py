"""Declarations in an order in which Python can compute them.

The order of declarations means nothing in the language (§7.3.15), but a value must be computed
before it is used. Source order is kept wherever it does.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from osc2tx import ir
from osc2tx.diagnostics import Label
from osc2tx.lowering.context import LoweringContext


def in_order_of_use(
    ctx: LoweringContext,
    declarations: tuple[ir.Declaration, ...],
    methods: tuple[ir.Method, ...] = (),
) -> tuple[ir.Declaration, ...]:
    """Return the declarations, each after those that its value needs; cycles are reported.

    Args:
        ctx: The checked program.
        declarations: Of one scenario.
        methods: The methods that values may call; a call needs all that the body reads.
    """
    by_name = {declaration.name: declaration for declaration in declarations}
    bodies = {method.name: method.expression for method in methods}
    needs = {d.name: (*_events(d), *_needs(_values(d), bodies)) for d in declarations}
    ordered: dict[str, ir.Declaration] = {}
    for declaration in declarations:
        _place(ctx, declaration, by_name, needs, ordered)
    return tuple(ordered.values())


def _place(
    ctx: LoweringContext,
    start: ir.Declaration,
    by_name: dict[str, ir.Declaration],
    needs: Mapping[str, tuple[str, ...]],
    ordered: dict[str, ir.Declaration],
) -> None:
    """Add a declaration below those it needs; a chain of any length, so without recursion."""
    path = [start]
    while path:
        current = path[-1]
        missing = [n for n in needs[current.name] if n in by_name and n not in ordered]
        if current.name in ordered or not missing:
            ordered.setdefault(path.pop().name, current)
            continue
        needed = by_name[missing[0]]
        if needed in path:
            _report_cycle(ctx, path[path.index(needed) :])
            ordered.update((member.name, member) for member in path)
            return
        path.append(needed)


def _report_cycle(ctx: LoweringContext, cycle: list[ir.Declaration]) -> None:
    names = " → ".join(f"`{member.name}`" for member in (*cycle, cycle[0]))
    ctx.sink.report(
        "OSC511",
        cycle[0].span,
        f"`{cycle[0].name}` is defined by itself: {names}",
        labels=[Label(member.span, f"`{member.name}` is part of it") for member in cycle[1:]],
    )


def _needs(
    values: Iterable[ir.Expression], bodies: Mapping[str, ir.Expression | None]
) -> Iterable[str]:
    """Yield the fields that values read when they are computed, methods looked into once."""
    pending, called = list(values), set[str]()
    while pending:
        for part in ir.walk(pending.pop(0)):
            if isinstance(part, ir.FieldRef):
                yield part.name
            is_user_defined = isinstance(part, ir.MethodCall) and isinstance(
                part.base, ir.ScenarioSelf
            )
            if isinstance(part, ir.MethodCall) and is_user_defined and part.method not in called:
                called.add(part.method)
                body = bodies.get(part.method)
                pending += [] if body is None else [body]


def _values(declaration: ir.Declaration) -> tuple[ir.Expression, ...]:
    match declaration:
        case ir.Struct(value=value) if value is not None:
            return (value,)
        case ir.Actor(values=values) | ir.Struct(values=values):
            return tuple(value.value for value in values)
        case ir.Parameter(value=value, domain=domain):
            return tuple(part for part in (value, domain) if part is not None)
        case ir.Variable(value=value, sample=sample):
            when = None if sample is None else sample.trigger
            times = _times(when) if isinstance(when, ir.Trigger) else ()
            return times if value is None else (value, *times)
        case ir.Event(trigger=trigger, parameters=parameters):
            defaults = tuple(p.default for p in parameters if p.default is not None)
            return defaults if trigger is None else (*_times(trigger), *defaults)


def _events(declaration: ir.Declaration) -> tuple[str, ...]:
    """Return the events that a declaration names: they must be there when it is made."""
    match declaration:
        case ir.Variable(sample=ir.Sample(trigger=ir.Trigger(event=ir.EventRef(name=name)))):
            return (name,)
        case ir.Event(trigger=ir.Trigger(event=ir.EventRef(name=name))):
            return (name,)
        case _:
            return ()


def _times(trigger: ir.Trigger) -> tuple[ir.Expression, ...]:
    """Return the names a trigger reads at its declaration; world conditions are read late."""
    if isinstance(trigger.condition, ir.Elapsed | ir.Every):
        return ir.condition_expressions(trigger.condition)
    return ()
