"""Which scenario an invocation runs: the invoked one, or a conditional one (§7.3.8.2.2).

Where the values of an invocation decide, the special scenario is invoked by its own class. Where
they are drawn or read when the invocation starts, the choice is left to the invocation.
"""

from __future__ import annotations

from osc2tx import ir
from osc2tx.analysis.constraints.domains import Choice, Domain, Value
from osc2tx.analysis.constraints.specialisation import (
    Behavior,
    Determinant,
    determinant_of,
    is_certain,
    is_possible,
)
from osc2tx.diagnostics import Span
from osc2tx.lowering.behavior.composed_behaviors import (
    Composed,
    has_behavior,
    is_composed,
    lineage_of,
    scenario_key,
)
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.constraints.parameter_domains import all_values
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.value_types import lower_type
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass, replace


@dataclass(frozen=True, slots=True)
class Specialised:
    """The scenario that an invocation runs.

    Attributes:
        scenario: The scenario that runs unless one of the others applies.
        others: Conditional scenarios below it, the most derived ones first, each with the values
            that it depends on.
    """

    scenario: Composed
    others: tuple[tuple[Composed, tuple[Determinant, ...]], ...] = ()

    @property
    def fields(self) -> tuple[sym.FieldSymbol, ...]:
        """The parameters that the choice depends on."""
        return tuple(dict.fromkeys(each.field for _, those in self.others for each in those))


@dataclass(slots=True)
class SpecialScenarios:
    """Finds and lowers the special scenarios of the invocations of one scenario.

    Attributes:
        ctx: The checked program.
        constraints: Those of the scenario that invokes.
    """

    ctx: LoweringContext
    constraints: ConstraintLowering

    def of(self, node: ast.Invocation, callee: Composed) -> Specialised:
        """Return the scenario that an invocation runs.

        An object that may be of two conditional types would need a class of both; that is reported.
        """
        certain: list[tuple[Composed, Determinant]] = []
        possible: list[tuple[Composed, Determinant]] = []
        for symbol, condition in self._below(callee):
            domain = self._domain(node, condition.field)
            if is_certain(domain, condition.value):
                certain.append((symbol, condition))
            elif is_possible(domain, condition):
                possible.append((symbol, condition))
        self._report_joint(node, certain + possible)
        if certain:
            return self.of(node, certain[0][0])
        return Specialised(
            callee,
            tuple(
                (special, (condition, *further))
                for symbol, condition in possible
                for special, further in self._with_those_below(node, symbol)
            ),
        )

    def without_behavior(self, node: ast.Invocation, found: Specialised) -> Composed | None:
        """Return a scenario that may be chosen and has no `do`, if there is one."""
        covered: dict[sym.FieldSymbol, set[Value]] = {}
        for _, determinants in found.others:
            if len(determinants) == 1:
                covered.setdefault(determinants[0].field, set()).add(determinants[0].value)
        is_base_needed = not any(
            self._values(node, field) <= values for field, values in covered.items()
        )
        chosen = [each for each, _ in found.others] + [found.scenario] * is_base_needed
        return next((each for each in chosen if not has_behavior(each)), None)

    def lowered(
        self, found: Specialised, arguments: tuple[ir.Argument, ...]
    ) -> tuple[ir.SpecialScenario, ...]:
        """Return the conditional scenarios for the IR; all are scenarios that are invoked."""
        spans = {argument.parameter: argument.span for argument in arguments}
        self.ctx.state.invoked.extend(special for special, _ in found.others)
        return tuple(
            ir.SpecialScenario(
                scenario=special.qualified_name,
                key=scenario_key(special),
                values=tuple(_constant(each, spans[each.field.name]) for each in determinants),
            )
            for special, determinants in found.others
        )

    def drawn(
        self,
        node: ast.Invocation,
        found: Specialised,
        arguments: tuple[ir.Argument, ...],
        name: str,
    ) -> tuple[ir.Argument, ...]:
        """Return the arguments of an invocation, with those that decide the choice.

        The invoked scenario draws parameters without an argument; the choice needs their values.
        """
        result = {argument.parameter: argument for argument in arguments}
        for field in found.fields:
            given = result.get(field.name)
            if given is not None and not isinstance(given.value, ir.Choices):
                continue
            domain = given.value if given is not None else self._choices(node, field)
            assert isinstance(domain, ir.Choices)
            value = self.ctx.draw(f"{name}.{field.name}", domain, lower_type(field.type))
            self.ctx.state.given[node, field] = value
            result[field.name] = ir.Argument(
                parameter=field.name, value=value, is_positional=False, span=node.span
            )
        return tuple(result.values())

    # --- parts ---

    def _below(self, callee: Composed) -> list[tuple[Composed, Determinant]]:
        found = []
        for symbol in self.ctx.model.symbols:
            if not isinstance(symbol, Behavior) or symbol.base is not callee:
                continue
            condition = determinant_of(self.ctx.model, symbol)
            if condition is not None and is_composed(symbol):
                found.append((symbol, condition))
        return found

    def _with_those_below(
        self, node: ast.Invocation, symbol: Composed
    ) -> list[tuple[Composed, tuple[Determinant, ...]]]:
        below = self.of(node, symbol)
        certain = list(lineage_of(below.scenario))
        certain = certain[: certain.index(symbol)]
        conditions = [determinant_of(self.ctx.model, each) for each in certain]
        by_then = tuple(each for each in conditions if each is not None)
        more = [(special, (*by_then, *further)) for special, further in below.others]
        return [*more, (below.scenario, by_then)]

    def _report_joint(
        self, node: ast.Invocation, found: list[tuple[Composed, Determinant]]
    ) -> None:
        """Report conditional scenarios of which an invocation may run two."""
        for index, (one, condition) in enumerate(found):
            for other, another in found[:index]:
                if condition.field is another.field and condition.value != another.value:
                    continue
                names = f"`{other.qualified_name}` and `{one.qualified_name}`"
                self.ctx.unsupported(
                    "OSC501",
                    node.span,
                    f"this may be both {names}",
                    help="let one inherit from the other, or fix what they depend on",
                )
                return

    def _domain(self, node: ast.Invocation, field: sym.FieldSymbol) -> Domain | None:
        return self.constraints.found.domains.get((node, field))

    def _values(self, node: ast.Invocation, field: sym.FieldSymbol) -> set[Value]:
        """Return the values that a parameter may have."""
        return {_plain(each) for each in self._choices(node, field).elements}

    def _choices(self, node: ast.Invocation, field: sym.FieldSymbol) -> ir.Choices:
        choices, domain = all_values(field.type, node.span), self._domain(node, field)
        assert choices is not None
        if not isinstance(domain, Choice):
            return choices
        kept = (e for e in choices.elements if (_plain(e) in domain.values) is not domain.excluded)
        return replace(choices, elements=tuple(kept))


def _plain(value: ir.Expression) -> Value:
    assert isinstance(value, ir.EnumValue | ir.Literal)
    return value.value


def _constant(determinant: Determinant, span: Span) -> ir.Argument:
    """Return the value that an argument must have, as an expression."""
    choices = all_values(determinant.field.type, span)
    assert choices is not None
    value = next(each for each in choices.elements if _plain(each) == determinant.value)
    return ir.Argument(
        parameter=determinant.field.name, value=value, is_positional=False, span=span
    )
