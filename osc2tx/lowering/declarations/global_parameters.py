"""Global parameters (§7.3.14) in the scenarios that use them: one value or object for a run."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.lowering.behavior.composed_behaviors import Composed, is_placeholder
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.context import LoweringContext, statement_comments
from osc2tx.lowering.declarations.fields import FieldLowering
from osc2tx.lowering.declarations.global_names import global_name
from osc2tx.lowering.placement.carla_paths import is_path, path_declarations, path_members
from osc2tx.lowering.values.references import alias_of
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.conversions import symbol_of
from osc2tx.syntax import ast
from osc2tx_shared.classes import replace


class GlobalLowering:
    """Lowers the global parameters that one scenario uses.

    A global actor is there for the whole run, mentioned or not: a scenario that no other one of
    the program invokes has all of them.

    Args:
        ctx: The checked program; used names are noted there.
        scenario: The scenario.
        constraints: Its own constraints: they may refer to members of global objects.
    """

    def __init__(
        self, ctx: LoweringContext, scenario: Composed, constraints: ConstraintLowering
    ) -> None:
        self._ctx = ctx
        self._own = constraints
        self._lowered: dict[str, tuple[ir.Actor | ir.Struct | ir.Parameter, ...]] = {}
        self.constraints: tuple[ir.Constraint, ...] = ()
        is_invoked = scenario in ctx.model.callees
        for symbol in ctx.model.global_parameters:
            is_cast = isinstance(symbol.type, types.ActorType) and not is_invoked
            if is_cast or self._is_constrained(symbol):
                global_name(ctx, symbol)
        self.lower()

    def lower(self) -> tuple[ir.Declaration, ...]:
        """Return the global parameters that were used so far; those of `constraints` included."""
        while missing := [name for name in self._ctx.state.globals if name not in self._lowered]:
            for name in missing:  # one global may be defined by another
                self._lowered[name] = self._declarations(name, self._ctx.state.globals[name])
        found = [d for declared in self._lowered.values() for d in declared]
        return tuple(sorted(found, key=lambda d: (d.span.source.name, d.span.start)))

    def _is_constrained(self, symbol: sym.FieldSymbol) -> bool:
        """Whether the scenario sets a global parameter, or constrains a member of one."""
        found = self._own.found.by_key
        return any(key[0] is symbol and len(key) > 1 for key in found) or any(
            each.subject == (symbol,) and each.place.owner is not None
            for each in found.get((symbol,), ())
        )

    def _declarations(
        self, name: str, symbol: sym.FieldSymbol
    ) -> tuple[ir.Actor | ir.Struct | ir.Parameter, ...]:
        if is_placeholder(symbol_of(symbol.type)) or alias_of(self._ctx, symbol) is not None:
            return ()
        if is_path(symbol.type):
            return self._path(name, symbol)
        own = self._own if self._is_constrained(symbol) else None
        constraints = own or ConstraintLowering.of_global(self._ctx, symbol)
        before = len(self._ctx.state.drawn)
        fields = FieldLowering(self._ctx, constraints)
        declaration = fields.lower(symbol, symbol.span, self._comments(symbol))
        drawn = self._ctx.state.drawn[before:]
        self._ctx.state.drawn[before:] = [
            each if isinstance(each, ir.Variable) else replace(each, is_global=True)
            for each in drawn
        ]
        if own is None:
            self.constraints += constraints.left_over()
        return () if declaration is None else (replace(declaration, name=name, is_global=True),)

    def _path(self, name: str, symbol: sym.FieldSymbol) -> tuple[ir.Actor | ir.Struct, ...]:
        """Return the part of a road of a global path, with the constraints of all scenarios."""
        scenarios = (s for s in self._ctx.model.symbols if isinstance(s, sym.ScenarioSymbol))
        statements = [statement for scenario in scenarios for statement in scenario.statements]
        members = path_members(self._ctx, statements)
        declared = path_declarations(self._ctx, symbol, members, self._comments(symbol))
        return tuple(
            replace(each, name=each.name.replace(symbol.name, name, 1), is_global=True)
            for each in declared
        )

    def _comments(self, symbol: sym.FieldSymbol) -> tuple[str, ...]:
        statements = (s for file in self._ctx.model.files for s in file.statements)
        shared = (s for s in statements if isinstance(s, ast.GlobalParameter))
        return next((statement_comments(s) for s in shared if s.parameter is symbol.node), ())
