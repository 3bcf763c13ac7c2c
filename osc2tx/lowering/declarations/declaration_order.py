"""Declarations in an order in which Python can compute them.

The order of declarations means nothing in the language (§7.3.15), but a value must be computed
before it is used. Source order is kept wherever it does.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from osc2tx import ir
from osc2tx.diagnostics import Label
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.declarations.members_read import with_members_written


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
    graph = _Graph(declarations, {method.name: method.expression for method in methods})
    ordered: dict[str, ir.Declaration] = {}
    for declaration in declarations:
        _place(ctx, declaration.name, graph, ordered)
    return tuple(ordered.values())


class _Graph:
    """The declarations of a scenario, and which others each needs."""

    def __init__(
        self,
        declarations: tuple[ir.Declaration, ...],
        bodies: Mapping[str, ir.Expression | None],
    ) -> None:
        self.by_name = {declaration.name: declaration for declaration in declarations}
        self._bodies = bodies
        self._needs = {each.name: self._needs_of(each) for each in declarations}

    def missing(self, name: str, ordered: Mapping[str, ir.Declaration]) -> str | None:
        """Return a declaration that another one needs and that is not placed yet."""
        needed = (n for n in self._needs[name] if n in self.by_name and n not in ordered)
        return next(needed, None)

    def is_circle(self, names: list[str]) -> bool:
        """Whether declarations still need each other if the values of members are written."""
        before = {name: self._needs[name] for name in names}
        for each in with_members_written([self.by_name[name] for name in names]):
            self.by_name[each.name] = each
            self._needs[each.name] = self._needs_of(each)
        return all(self._needs[name] == needed for name, needed in before.items())

    def _needs_of(self, declaration: ir.Declaration) -> tuple[str, ...]:
        return (*_events(declaration), *_needs(_values(declaration), self._bodies))


def _place(
    ctx: LoweringContext, start: str, graph: _Graph, ordered: dict[str, ir.Declaration]
) -> None:
    """Add a declaration below those it needs; a chain of any length, so without recursion."""
    path = [start]
    while path:
        current = path[-1]
        missing = None if current in ordered else graph.missing(current, ordered)
        if missing is None:
            ordered.setdefault(path.pop(), graph.by_name[current])
        elif missing not in path:
            path.append(missing)
        elif graph.is_circle(circle := path[path.index(missing) :]):
            _report_cycle(ctx, [graph.by_name[name] for name in circle])
            ordered.update((name, graph.by_name[name]) for name in path)
            return
        else:
            del path[path.index(missing) + 1 :]


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
