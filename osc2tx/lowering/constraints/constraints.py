"""Constraints on the values of a scenario (§7.3.11) as fixed values and domains.

A parameter becomes a constant (set by a hard constraint), a value with a default, or a value out of
a domain. Its domain is written with the bounds of the source, if there are any. A constraint that
these do not imply is checked before the run.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from math import inf

from osc2tx import ir
from osc2tx.analysis import TypeConstraints, analyse_global, single_value
from osc2tx.analysis.constraints.constraint import Constraint
from osc2tx.analysis.constraints.domains import TRUE, Choice, Domain, Interval, join
from osc2tx.analysis.constraints.operation_list import SIZE, Key, domain_of_type
from osc2tx.analysis.constraints.solver import values_on
from osc2tx.lowering.behavior.composed_behaviors import Composed, is_composed
from osc2tx.lowering.constraints.cases import (
    alternatives,
    cases_of,
    range_by_cases,
    range_in_a_case,
    value_by_cases,
)
from osc2tx.lowering.constraints.checks import checks_itself, is_about_others, lower_check
from osc2tx.lowering.constraints.equations import solve_for
from osc2tx.lowering.constraints.parameter_domains import (
    DomainWriter,
    all_values,
    as_type,
    written_domain,
)
from osc2tx.lowering.constraints.parameter_settings import (
    Instance,
    Setting,
    is_known_here,
    is_last,
    is_last_of_object,
)
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.lowering.values.range_bounds import with_bounds
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.builtins import DURATION
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass, replace


@dataclass(slots=True)
class ConstraintLowering:
    """Lowers the constraints of one scenario, or of a global parameter.

    Attributes:
        ctx: The checked program.
        found: Its constraints.
    """

    ctx: LoweringContext
    found: TypeConstraints
    _hard: dict[Key, Domain] = field(default_factory=dict)
    _written: dict[Key, Domain] = field(default_factory=dict)
    _used: set[Constraint] = field(default_factory=set)
    _with_comments: set[ast.Node] = field(default_factory=set)

    @classmethod
    def of_scenario(cls, ctx: LoweringContext, scenario: Composed) -> ConstraintLowering:
        """Take the constraints of a scenario."""
        found = ctx.program.analysis.types[scenario]
        same = {
            each.constraint for f, each in ctx.same_actors.items() if f not in ctx.program.handed_in
        }
        return cls(ctx, found, dict(found.domains_to_set()), _used=same)

    @classmethod
    def of_global(cls, ctx: LoweringContext, parameter: sym.FieldSymbol) -> ConstraintLowering:
        """Take the constraints of a global parameter."""
        found = analyse_global(ctx.model, parameter)
        return cls(ctx, found, dict(found.domains_to_set()))

    def with_actor(self, actor: ir.Expression | None) -> ConstraintLowering:
        """Return the same constraints, for expressions in which `actor` is something."""
        return replace(self, ctx=self.ctx.with_actor(actor))

    def setting(self, key: Key, type_: types.Type) -> Setting:
        """Return the facts about a parameter; its constraints count as written from now on."""
        mentioned = tuple(c for c in self.found.by_key.get(key, ()) if is_known_here(c, key))
        if len(mentioned) == 1 and (constant := self._constant(key, type_, mentioned[0])):
            return constant
        return self._setting(key, type_, mentioned)

    def _constant(self, key: Key, type_: types.Type, only: Constraint) -> Setting | None:
        """Return the value that the only constraint on a parameter gives it, if that is a constant.

        It is the same in all scenarios that inherit it: each constant is lowered once.
        """
        if only.subject != key or not only.operations.is_plain or only.is_range:
            return None
        if only not in self.ctx.constants:
            setting = self._setting(key, type_, (only,))
            self.ctx.constants[only] = setting, self._written.get(key)
            return setting
        setting, written = self.ctx.constants[only]
        if written is not None:
            self._written[key] = written
        self._used.add(only)
        self._with_comments.add(only.node)
        return setting

    def _setting(self, key: Key, type_: types.Type, mentioned: tuple[Constraint, ...]) -> Setting:
        own = [c for c in mentioned if c.subject == key and c.value is not None]
        if isinstance(type_, types.ListType | types.RangeType):
            own = [c for c in own if not c.is_range]  # the content of a range is left to a check
        definition = _definition_among(own)
        within = next((c for c in reversed(own) if c.is_range), None)
        hard = self._hard.get(key, domain_of_type(type_))
        writer = DomainWriter(self.ctx, key, type_, mentioned)
        value = None if definition is None else self._expression(definition)
        is_fixed = definition is not None and not definition.is_default
        value = None if value is None else as_type(value, type_)
        if not is_fixed and single_value(hard) is not None:
            value, is_fixed, definition = writer.point(hard), True, None
        elif definition is None and (authored := self._authored(writer)) is not None:
            value, is_fixed = authored, True
        elif definition is None and (solved := self._solved(key)) is not None:
            (definition, value), is_fixed = solved, True
        elif definition is None and (by_cases := self._by_cases(key, type_)) is not None:
            value, is_fixed = by_cases, True
        domain = None if is_fixed else self._domain(writer, within, hard)
        self._note(key, type_, definition, domain, hard if is_fixed else None)
        said = [c for c in mentioned if self._is_stated(c, key, definition, domain)]
        self._used.update(c for c in said if c is definition or c is within)
        comments = dict.fromkeys(line for c in said for line in self._comments(c))
        return Setting(value, domain, is_fixed, tuple(comments), tuple(said))

    def members(self, object_: Key) -> Iterator[tuple[Key, Setting]]:
        """Yield the facts about the members of an object; any value of an enum is a fact."""
        depth = len(object_)
        for key, mentioned in self.found.by_key.items():
            below = key[depth:] if key[:depth] == object_ and key[-1] is not SIZE else ()
            fields = [part for part in below if isinstance(part, sym.FieldSymbol)]
            if fields and len(fields) == len(below):
                setting = self.setting(key, fields[-1].type)
                if setting.is_empty:
                    setting = replace(
                        setting, domain=all_values(fields[-1].type, mentioned[0].span)
                    )
                if not setting.is_empty:
                    yield key, setting

    def of_instance(self, node: Instance) -> Iterator[tuple[sym.FieldSymbol, Setting]]:
        """Yield the constrained parameters of an invocation or composition.

        Arguments are constraints too; a parameter that has one is left to it, except a range that
        other constraints narrow.
        """
        binding = self.ctx.model.bindings.get(node)
        is_of_library = binding is not None and binding.callee.origin != "user"
        is_atomic = binding is not None and not is_composed(binding.callee)
        for key in self.found.members.get(node, ()):
            parameter, mentioned = key[-1], self.found.by_key[key]
            if len(key) != 2 or not isinstance(parameter, sym.FieldSymbol):
                continue
            if any(_is_argument(c, key) for c in mentioned) and not self.narrows(key):
                continue
            own = [c.origin for c in mentioned if c.subject == key]
            is_default = bool(own) and {*own} == {"default value"}  # the declaration decides
            states_itself = is_default if is_atomic else bool(own)
            if (
                not is_of_library
                and (states_itself or (parameter is DURATION and not is_atomic))
                and all(c.place.prefix[:1] == (node,) for c in mentioned)
            ):
                continue
            setting = self.setting(key, parameter.type)
            if not setting.is_empty:
                yield parameter, setting

    def narrows(self, key: Key) -> bool:
        """Whether constraints narrow a range that is passed for a number."""
        mentioned = self.found.by_key.get(key, ())
        passed = [c for c in mentioned if _is_argument(c, key)]
        return bool(passed) and all(c.is_range for c in passed) and len(mentioned) > len(passed)

    def structs_of_instance(self, node: Instance) -> Iterator[sym.FieldSymbol]:
        """Yield the parameters of an invocation that constraints describe by their fields."""
        found: dict[sym.FieldSymbol, None] = {}
        for key in self.found.members.get(node, ()):
            match key[1] if len(key) > 2 else None:
                case sym.FieldSymbol(type=types.StructType()) as parameter:
                    if key[:2] not in self.ctx.state.given:
                        found[parameter] = None
        yield from found

    def is_only_definition(self, setting: Setting, key: Key) -> bool:
        """Whether the written value of a parameter makes all constraints on it true."""
        return all(c in setting.constraints for c in self.found.by_key.get(key, ()))

    def use(self, constraint: Constraint) -> None:
        """Note that a constraint is written: nothing of it is left to a check."""
        self._used.add(constraint)

    def left_over(self) -> tuple[ir.Constraint, ...]:
        """Return the constraints that are checked before the run; called last."""
        left = [c for c in self.found.in_force.constraints if self._is_left(c)]
        lowered = (lower_check(self.ctx, c, self._comments(c)) for c in left)
        return tuple(constraint for constraint in lowered if constraint is not None)

    # --- parts ---

    def _expression(self, constraint: Constraint) -> ir.Expression | None:
        assert constraint.value is not None
        return lower_expression(self.ctx.at(constraint.place), constraint.value)

    def _authored(self, writer: DomainWriter) -> ir.Expression | None:
        """Return the value that a longer constraint gives a parameter.

        Objects get no value from an equality: `keep(it.group == street)` constrains `it`. Nor do
        members of objects from facts about these alone: `keep(gap == ego.rear_overhang)`.
        """
        if isinstance(writer.type, types.StructType):
            return None
        return writer.equality([c for c in writer.constraints if self._defines(c, writer.key)])

    def _defines(self, constraint: Constraint, member: Key) -> bool:
        """Whether a constraint is the only definition of another parameter, through a member."""
        subject = constraint.subject
        if subject is None or subject == member:
            return False
        if constraint in self._used:
            return True
        about = self.found.by_key.get(subject, ())
        own = [c for c in about if c.subject == subject and c.value is not None]
        if len(member) == len(subject) == 1:  # the other is later: its last definition
            return [c for c in own if not c.is_range][-1:] == [constraint]
        return own == [constraint]

    def _domain(
        self, writer: DomainWriter, within: Constraint | None, hard: Domain
    ) -> ir.Domain | None:
        if within is not None:
            lowered = self._expression(within)
            lowered = None if lowered is None else with_bounds(lowered)
            if isinstance(lowered, ir.ListValue):
                elements = lowered.elements
                return ir.Choices(span=lowered.span, type=lowered.type, elements=elements)
            if isinstance(lowered, ir.RangeValue) and not writer.is_constant(lowered):
                return lowered
            is_list = lowered is not None and lowered.type.kind is ir.Kind.LIST
            if lowered is not None and is_list and not ir.is_live(lowered):
                return ir.Choices(span=lowered.span, type=lowered.type, elements=(lowered,))
        elif (listed := self._listed(writer)) is not None:
            return listed
        relative = () if within is not None else writer.relatives(self._earlier(writer.key))
        bound = next(iter(relative), None)
        if bound is not None and not isinstance(hard, Choice):
            lowered, by = bound
            if writer.key[-1] is DURATION:
                return self._duration(writer, hard)
            if not writer.has_bounds:
                self._used.add(by)
                return lowered
        known = writer.domain(hard)
        if known is None or isinstance(known, ir.HalfRange):
            return self._range_by_cases(writer) or known
        return known

    def _duration(self, writer: DomainWriter, hard: Interval) -> ir.RangeValue | ir.HalfRange:
        """Return the bounds of a duration, which no check can read, some from other values."""
        halves: dict[bool, ir.HalfRange] = {}
        for half, by in writer.relatives(self._earlier(writer.key)):
            if half.is_lower not in halves:
                halves[half.is_lower] = half
                self._used.add(by)
        own = Interval(
            -inf if True in halves else hard.lower, inf if False in halves else hard.upper
        )
        for each in writer.constraints:
            if values_on(each.operations, {writer.key: own})[-1] == TRUE:
                self._used.add(each)
        constant = writer.domain(own)
        if isinstance(constant, ir.HalfRange):
            halves.setdefault(constant.is_lower, constant)
        if len(halves) < 2:
            return next(iter(halves.values()))
        lower, upper = halves[True], halves[False]
        return ir.RangeValue(span=lower.span, type=lower.type, lower=lower.bound, upper=upper.bound)

    def _range_by_cases(self, writer: DomainWriter) -> ir.RangeValue | None:
        """Return the domain of a number that constraints bound in some cases only."""
        found = range_by_cases(self.ctx, self._earlier(writer.key), writer.key, writer.type)
        if found is None:
            return range_in_a_case(self.ctx, writer.constraints, writer.key, writer.type)
        self._used.update(found[1])
        return found[0]

    def _earlier(self, key: Key, *, among_members: bool = False) -> list[Constraint]:
        """Return the constraints that relate a parameter to earlier ones.

        Args:
            key: The parameter.
            among_members: Also those that relate a member to earlier ones of the same object.
        """
        found = []
        for constraint in self.found.by_key.get(key, ()):
            others = [k for k in constraint.operations.keys if k != key]
            after = isinstance(key[0], ast.Node) or key[-1] is DURATION or is_last(key, others)
            after = after or (among_members and is_last_of_object(key, others))
            if others and after and not constraint.is_default:
                found.append(constraint)
        return found

    def _note(
        self,
        key: Key,
        type_: types.Type,
        definition: Constraint | None,
        domain: ir.Domain | None,
        fixed: Domain | None,
    ) -> None:
        """Remember the least domain of the parameter in the module."""
        whole = domain_of_type(type_)
        if definition is not None:
            value = self._value_of(definition) if definition.subject == key else whole
            others = None if not definition.is_default else whole
            if definition.is_default and domain is not None:
                others = written_domain(domain, type_, self._hard.get(key, whole))
            self._written[key] = value if others is None else join(value, others)
        elif fixed is not None and single_value(fixed) is not None:
            self._written[key] = fixed
        elif domain is not None:
            self._written[key] = written_domain(domain, type_, self._hard.get(key, whole))

    def _solved(self, key: Key) -> tuple[Constraint, ir.Expression] | None:
        """Return an equality between values, solved for the one that is declared last."""
        for constraint in self.found.by_key.get(key, ()):
            node = constraint.node
            others = [k for k in constraint.operations.keys if k != key]
            if constraint in self._used or constraint.is_default or not others:
                continue
            if not isinstance(node, ast.KeepConstraint) or not is_last(key, others):
                continue
            solved = solve_for(self.ctx.at(constraint.place), node.expression, constraint, key)
            if solved is not None:
                return constraint, solved
        return None

    def _by_cases(self, key: Key, type_: types.Type) -> ir.Expression | None:
        """Return the value of a parameter in each of the cases of its constraints."""
        constraints = self._earlier(key, among_members=True)
        cases = cases_of(self.ctx, constraints, key, type_)
        self._used.update(case.constraint for case in cases)
        return value_by_cases(cases) if cases else None

    def _listed(self, writer: DomainWriter) -> ir.Choices | None:
        """Return the values that a constraint lists, `x == a or x == b`."""
        for constraint in writer.constraints:
            plain = constraint.operations.keys == {writer.key}
            listed = plain and alternatives(self.ctx, constraint, writer.key, writer.type)
            if listed:
                self._used.add(constraint)
                return listed
        return None

    def _value_of(self, definition: Constraint) -> Domain:
        """Return the domain of the value that a parameter is set to."""
        known = {key: self._known(key) for key in definition.operations.keys}
        values = values_on(definition.operations, {k: d for k, d in known.items() if d is not None})
        root = definition.operations.root
        return values[root.operands[1]] if len(root.operands) > 1 else values[-1]

    def _known(self, key: Key) -> Domain | None:
        """Return the domain of a parameter in the module, also if its one value is set later."""
        hard = self._hard.get(key)
        is_point = hard is not None and single_value(hard) is not None
        return self._written.get(key, hard if is_point else None)

    def _is_stated(
        self,
        constraint: Constraint,
        key: Key,
        definition: Constraint | None,
        domain: ir.Domain | None,
    ) -> bool:
        if constraint is definition:
            return True
        if constraint.subject == key and constraint.is_range and domain is not None:
            return True
        return constraint.operations.keys == {key} and self._holds(constraint)

    def _holds(self, constraint: Constraint) -> bool:
        return values_on(constraint.operations, self._written)[-1] == TRUE

    def _is_left(self, constraint: Constraint) -> bool:
        if constraint.origin in ("argument", "element"):
            return False
        prefix = constraint.place.prefix
        if not prefix and not constraint.is_default and is_about_others(self.ctx, constraint):
            return True
        if constraint in self._used:
            return False
        if prefix and isinstance(prefix[0], ast.Invocation) and checks_itself(self.ctx, prefix[0]):
            return False
        if self.found.owner is not None and constraint.place.owner is None:
            return False  # a constraint of a global parameter on itself
        values = (self._written.get(key) for key in constraint.operations.keys)
        is_known = all(value is not None and single_value(value) is not None for value in values)
        if is_known and all(operation.name != "any" for operation in constraint.operations.items):
            return False  # the analysis saw that it holds
        return not self._holds(constraint)

    def _comments(self, constraint: Constraint) -> tuple[str, ...]:
        """Return the comments of a constraint; the class of a type has those inside of the type."""
        is_of_type = isinstance(next(iter(constraint.place.prefix), None), sym.FieldSymbol)
        return () if is_of_type else self.comments_of(constraint.node)

    def comments_of(self, node: ast.Node) -> tuple[str, ...]:
        """Return the comments of a rule; one on several fields has them at the first."""
        if not isinstance(node, ast.KeepConstraint | ast.RemoveDefault) or node in (
            self._with_comments
        ):
            return ()
        self._with_comments.add(node)
        return statement_comments(node)


def _is_argument(constraint: Constraint, key: Key) -> bool:
    return constraint.subject == key and constraint.origin == "argument"


def _definition_among(own: list[Constraint]) -> Constraint | None:
    """Return the equality that gives a parameter its value: the last one, better a constant.

    All of them hold, and another parameter may get its value by one that is no constant.
    """
    equalities = [c for c in reversed(own) if not c.is_range]
    constants = (c for c in equalities if c.operations.keys == {c.subject})
    return next(constants, next(iter(equalities), None))
