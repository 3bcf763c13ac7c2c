"""Entry of the lowering: modules and scenarios."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from osc2tx import ir
from osc2tx.analysis import ConstraintAnalysis
from osc2tx.analysis.same_actors import same_actors
from osc2tx.diagnostics import DiagnosticSink
from osc2tx.ir.compare import field_names
from osc2tx.lowering.behavior.composed_behaviors import (
    Composed,
    actor_type_of,
    has_behavior,
    is_composed,
    lineage_of,
    scenario_key,
)
from osc2tx.lowering.behavior.do_directives import labelled_once, lower_body, nothing_left
from osc2tx.lowering.behavior.durations import own_duration
from osc2tx.lowering.behavior.invoked_times import ScenarioOf
from osc2tx.lowering.behavior.time_system import TimeSystem
from osc2tx.lowering.behavior.user_actions import lower_actions
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.context import (
    LoweringContext,
    Program,
    UsedDeclarations,
    apart,
    present,
    statement_comments,
)
from osc2tx.lowering.coverage.coverage import lower_coverage
from osc2tx.lowering.declarations.combined_types import lineage
from osc2tx.lowering.declarations.declaration_order import in_order_of_use
from osc2tx.lowering.declarations.declarations import DeclarationLowering
from osc2tx.lowering.declarations.global_parameters import GlobalLowering
from osc2tx.lowering.declarations.user_fields import (
    class_default,
    default_keeps,
    mentioned_fields,
    user_fields,
    user_lineage,
)
from osc2tx.lowering.declarations.user_types import lower_enums, lower_types, lower_units
from osc2tx.lowering.modifiers.modifier_functions import lower_modifiers, own_modifiers
from osc2tx.lowering.modifiers.override_modifiers import lower_overrides
from osc2tx.lowering.modifiers.standing_modifiers import StandingModifiers
from osc2tx.lowering.placement.initial_placement import PlacementLowering, merged
from osc2tx.lowering.placement.later_starts import with_any_start
from osc2tx.lowering.placement.member_placements import member_placements
from osc2tx.lowering.unsupported_members import report_unsupported_members
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.lowering.values.method_kinds import object_types
from osc2tx.options import CompileOptions
from osc2tx.semantics import SemanticModel, types
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace


def lower(
    model: SemanticModel,
    analysis: ConstraintAnalysis,
    options: CompileOptions,
    sink: DiagnosticSink,
) -> ir.Module:
    """Lower scenarios and actions of the root file, and imported ones that they invoke or inherit.

    Rejected scenarios are reported and left out.
    """
    lowered: dict[Composed, ir.AbstractScenario | None] = {}
    invoked: set[Composed] = set()
    composed, others = _own_actions(model)
    own: list[Composed] = [*model.scenarios, *composed]
    pending = list(own)
    used = UsedDeclarations()
    ctx = LoweringContext(_program(model, analysis), used, sink)
    lowering = _ProgramLowering(ctx, options, frozenset(own))
    while pending:
        scenario = pending.pop(0)
        if scenario in lowered:
            continue
        is_inherited_only = scenario not in own and scenario not in invoked
        lowered[scenario], used_inside = lowering.lower(scenario, is_inherited_only)
        invoked.update(used_inside)
        pending += [*used_inside, *_user_base(scenario)]
    report_unsupported_members(ctx, tuple(lowered))
    found = _bases_first(lowered)
    module = ir.Module(
        source=model.root.span.source.name,
        standard=options.standard,
        dialect=options.dialect,
        one_of=options.one_of,
        scenarios=tuple(
            replace(each, is_invoked=symbol in invoked)
            for symbol, each in found.items()
            if isinstance(each, ir.Scenario)
        ),
        bases=tuple(each for each in found.values() if not isinstance(each, ir.Scenario)),
        comments=_head_comments(model.root),
        units=lower_units(model),
        types=lower_types(ctx),
        actions=lower_actions(ctx, (*used.actions, *others)),
    )
    modifiers = dict.fromkeys((*own_modifiers(model), *used.modifiers))
    module = replace(module, modifiers=lower_modifiers(ctx, modifiers))
    return replace(module, enums=lower_enums(model, module))


def _program(model: SemanticModel, analysis: ConstraintAnalysis) -> Program:
    given = [pair for binding in model.bindings.values() for pair in binding.arguments]
    return Program(
        model,
        analysis,
        lower_expression,
        mentioned=mentioned_fields(model),
        default_keeps=default_keeps(model),
        handed_in=frozenset(
            [
                *(parameter for parameter, _ in given),
                *_described_parameters(analysis),
                *_left_to_invocations(model),
            ]
        ),
        computed=frozenset(
            parameter
            for parameter, value in given
            if not isinstance(value, ast.NameExpression | ast.MemberAccess)
        ),
        object_types=object_types(model, analysis),
    )


class _ProgramLowering:
    """Lowers the scenarios of a program, each once.

    Args:
        ctx: The context of the program.
        options: Of the compilation.
        own: The scenarios and actions of the root file.
    """

    def __init__(
        self, ctx: LoweringContext, options: CompileOptions, own: frozenset[Composed]
    ) -> None:
        self._ctx = ctx
        self._own = own
        self._first_come = options.dialect == "carla"
        self._made: dict[Composed, tuple[ir.AbstractScenario | None, Sequence[Composed]]] = {}
        self._by_key: dict[str, Composed] = {}

    def lower(
        self, scenario: Composed, is_inherited_only: bool = False
    ) -> tuple[ir.AbstractScenario | None, Sequence[Composed]]:
        """Return a scenario, None if it is refused, and the scenarios that it invokes.

        Args:
            scenario: The scenario.
            is_inherited_only: It is imported and never invoked.
        """
        if scenario not in self._made:
            self._made[scenario] = None, ()  # while it is lowered: it may invoke itself
            self._made[scenario] = self._lower(scenario, is_inherited_only)
        return self._made[scenario]

    def _lower(
        self, scenario: Composed, is_inherited_only: bool
    ) -> tuple[ir.AbstractScenario | None, Sequence[Composed]]:
        ctx = (self._ctx.quiet() if is_inherited_only else self._ctx).of_scenario(
            frozenset(name for each in lineage_of(scenario) for name in each.members),
            self._known_to(scenario),
            same_actors(self._ctx.program.analysis.types[scenario]),
        )

        def scenario_of(key: str) -> ir.AbstractScenario | None:
            self._by_key.update((scenario_key(each), each) for each in ctx.state.invoked)
            return self.lower(self._by_key[key])[0]

        made = _lower_scenario(
            ctx,
            scenario,
            is_imported=scenario not in self._own,
            first_come=self._first_come,
            scenario_of=scenario_of,
        )
        self._by_key.update((scenario_key(each), each) for each in ctx.state.invoked)
        is_refused = is_inherited_only and ctx.sink.has_errors  # its own file reports it
        return None if is_refused else made, ctx.state.invoked

    def _known_to(self, scenario: Composed) -> frozenset[str]:
        """Return the names of the files whose reads of fields concern the objects of a scenario.

        Files that invoke it read them as well: `x.about.limit`.
        """
        model = self._ctx.model
        if scenario in model.callees:
            return frozenset(file.span.source.name for file in model.files)
        return model.known_to(each.span.source.name for each in _statements(scenario))


def _user_base(scenario: Composed) -> tuple[Composed, ...]:
    """Return the base of a scenario, if a module has a class for it."""
    base = scenario.base
    is_scenario = isinstance(base, sym.ScenarioSymbol) and base.origin == "user"
    return (base,) if base is not None and (is_scenario or is_composed(base)) else ()


def _bases_first(
    lowered: Mapping[Composed, ir.AbstractScenario | None],
) -> dict[Composed, ir.AbstractScenario]:
    """Return the lowered scenarios, each below its base, to which it refers if it extends it."""
    found: dict[Composed, ir.AbstractScenario] = {}
    for symbol in lowered:
        for each in reversed(list(lineage_of(symbol))):
            made = lowered.get(each)
            if each in found or made is None:
                continue
            base = next((found[above] for above in _user_base(each) if above in found), None)
            if base is not None and ir.additions(made, base) is not None:
                made = replace(made, base=base.key)
            found[each] = made
    return found


def _own_actions(
    model: SemanticModel,
) -> tuple[Sequence[sym.ActionSymbol], Sequence[sym.ActionSymbol]]:
    """Return the actions of the root file with a class of their own, and those of packages."""
    actions = (each for each in model.symbols if isinstance(each, sym.ActionSymbol))
    own = [each for each in actions if each.span.source is model.root.span.source]
    composed = [each for each in own if is_composed(each)]
    return composed, [each for each in own if each not in composed]


def _described_parameters(analysis: ConstraintAnalysis) -> Iterator[sym.Symbol]:
    """Yield the parameters whose fields constraints of some invocation mention."""
    for found in analysis.types.values():
        for key in found.by_key:
            match key:
                case (ast.Invocation(), sym.FieldSymbol(type=types.StructType()) as field, _, *_):
                    yield field


def _left_to_invocations(model: SemanticModel) -> Iterator[sym.Symbol]:
    """Yield the structs of scenarios of actors that only an invocation, maybe elsewhere, gives."""
    for scenario in model.scenarios:
        for member in scenario.members.values() if scenario.actor is not None else ():
            match member:
                case sym.FieldSymbol(type=types.StructType(), default=None, constraints=()):
                    yield member


def _head_comments(file: ast.File) -> tuple[str, ...]:
    """Return the comments above imports and namespace statements: they head the file."""
    statements: list[ast.Statement] = [*file.imports]
    for statement in file.statements:
        if not isinstance(statement, ast.NamespaceStatement | ast.UseStatement):
            break
        statements.append(statement)
    return tuple(line for s in statements for line in statement_comments(s))


def _lower_scenario(
    ctx: LoweringContext,
    scenario: Composed,
    *,
    is_imported: bool,
    first_come: bool,
    scenario_of: ScenarioOf,
) -> ir.AbstractScenario | None:
    node = scenario.node
    statements = _statements(scenario)
    constraints = ConstraintLowering.of_scenario(ctx, scenario)
    standing = StandingModifiers(ctx, constraints)
    for statement in statements:
        if isinstance(statement, ast.ModifierApplication):
            standing.of_member(statement)  # constraints may mention its parameters
    duration = own_duration(ctx, constraints)
    lowering = DeclarationLowering(ctx, scenario, statements, constraints)
    declarations = lowering.lower()
    shared = GlobalLowering(ctx, scenario, constraints)
    methods = lowering.lower_methods()
    tree = lower_body(ctx, scenario, statements, constraints, standing, duration)
    if tree is None and has_behavior(scenario):
        return None
    times = TimeSystem(ctx, declarations, _solvable(ctx, scenario), scenario_of)
    starts: PlacementLowering | None = None
    body: ir.Behavior | None = None
    placements: tuple[ir.Placement, ...] = ()
    if tree is not None:
        timed = tree if first_come else times.solve(tree)
        starts = PlacementLowering(ctx, scenario_of)
        placements, body = starts.split(labelled_once(timed))
        body = body or nothing_left(scenario)
    left_over = constraints.left_over()
    coverage = lower_coverage(ctx, scenario)
    if starts is not None and body is not None:
        others = (declarations, methods, placements, left_over, coverage, times.constraints)
        body = with_any_start(ctx, body, frozenset(starts.later_ranges), others)
    object_variables = lowering.lower_object_variables()
    type_methods = lowering.lower_type_methods()
    global_parameters = shared.lower()
    made = ir.AbstractScenario(
        name=scenario.qualified_name,
        span=node.name.span,
        comments=apart(statement_comments(node))[0],
        declarations=in_order_of_use(
            ctx,
            (
                *_own_actor(ctx, scenario),
                *global_parameters,
                *times.declared,
                *ctx.state.drawn,
                *present(list(ctx.state.object_events.values())),
                *object_variables,
            ),
            (*methods, *type_methods),
        ),
        methods=(*methods, *type_methods),
        placements=merged(ctx, (*member_placements(ctx, statements, standing), *placements)),
        end_comments=(*_end_comments(node), *node.comments_below),
        overrides=lower_overrides(ctx, statements),
        coverage=coverage,
        constraints=(*shared.constraints, *left_over, *times.constraints),
        is_imported=is_imported,
        is_action=isinstance(scenario, sym.ActionSymbol),
    )
    return made if body is None else ir.Scenario(**_fields(made), body=body)


def _solvable(ctx: LoweringContext, scenario: Composed) -> set[str]:
    """Return the names of the parameters that no invocation gives a value."""
    return {
        name
        for each in lineage_of(scenario)
        for name, member in each.members.items()
        if isinstance(member, sym.FieldSymbol) and member not in ctx.program.handed_in
    }


def _end_comments(node: ast.Statement) -> tuple[str, ...]:
    return node.end_comments if isinstance(node, ast.ScenarioDeclaration) else ()


def _fields(scenario: ir.AbstractScenario) -> dict[str, Any]:
    return {name: getattr(scenario, name) for name in field_names(scenario)}


def _own_actor(ctx: LoweringContext, scenario: Composed) -> tuple[ir.Actor, ...]:
    """Return the implicit field `actor` of a scenario of an actor; its invoker fills it in."""
    actor = actor_type_of(scenario)
    if actor is None:
        return ()
    span = scenario.node.name.span
    names = lineage(actor)
    ctx.used.types.append(actor)
    fields = (field for each in user_lineage(actor) for field in user_fields(ctx, each))
    is_given = any(class_default(ctx, field) is None for field in fields)
    return (
        ir.Actor(
            name="actor", span=span, type=names[0], lineage=names, values=(), is_given=is_given
        ),
    )


def _statements(scenario: Composed) -> tuple[ast.Statement, ...]:
    """Return the member statements, those of base scenarios first."""
    chain = list(lineage_of(scenario))
    return tuple(statement for symbol in reversed(chain) for statement in symbol.statements)
