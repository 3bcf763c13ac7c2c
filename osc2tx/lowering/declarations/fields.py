"""Fields of a scenario, and global parameters, with the constraints on them."""

from __future__ import annotations

from osc2tx import ir
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.analysis.constraints.parameter_lookup import name_of
from osc2tx.diagnostics import Span
from osc2tx.lowering.behavior.composed_behaviors import is_composed
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.constraints.list_constraints import lower_list
from osc2tx.lowering.constraints.parameter_domains import all_values
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.declarations.combined_types import add_types, lineage
from osc2tx.lowering.declarations.map_fields import reads_map
from osc2tx.lowering.declarations.objects import ObjectLowering
from osc2tx.lowering.declarations.user_fields import is_plain, user_lineage
from osc2tx.lowering.value_types import authored_unit, lower_type
from osc2tx.lowering.values.expressions import lower_expression
from osc2tx.lowering.values.references import other_actor
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx.semantics.names.member_lookup import parameters_of
from osc2tx.syntax import ast


class FieldLowering:
    """Lowers fields that are not sampled: objects, lists and simple values.

    Args:
        ctx: The checked program.
        constraints: The constraints of the scenario.
    """

    def __init__(self, ctx: LoweringContext, constraints: ConstraintLowering) -> None:
        self._ctx = ctx
        self._constraints = constraints
        self._objects = ObjectLowering(ctx, constraints)

    def lower(
        self, symbol: sym.FieldSymbol, span: Span, comments: tuple[str, ...]
    ) -> ir.Actor | ir.Struct | ir.Parameter | None:
        """Return the declaration of a field; `None` if it was refused.

        Args:
            symbol: The field.
            span: Its name in the source.
            comments: Comment lines above it.
        """
        # A variable without initial value has one all the same (§7.3.6.1.2): from outside.
        match symbol.type:
            case types.ActorType() if (other := other_actor(self._ctx, symbol)) is not None:
                return self._other_actor(symbol, other, span, comments)
            case types.ActorType() if self._is_one_of_several(symbol):
                return None
            case types.ActorType():
                actor = self._objects.types_of(symbol)
                add_types(self._ctx, actor, span)
                names = lineage(*actor)
                is_given = self._is_given(symbol) and self._objects.is_open(symbol)
                return ir.Actor(
                    name=symbol.name,
                    span=span,
                    comments=comments,
                    type=names[0],
                    lineage=names,
                    values=() if is_given else self._objects.values(symbol),
                    is_given=is_given,
                )
            case types.StructType() if self._is_for_caller(symbol):
                return ir.Parameter(
                    name=symbol.name,
                    span=span,
                    comments=comments,
                    type=lower_type(symbol.type),
                    value=None,
                    domain=None,
                    is_fixed=False,
                )
            case types.StructType():
                struct = self._objects.types_of(symbol)
                add_types(self._ctx, struct, span)
                return self._objects.struct(symbol, span, comments, lineage(*struct))
            case types.BehaviorType(symbol=behavior):
                self._parameters(symbol, behavior)
                return None
            case types.ListType() | types.RangeType() if not self._has_value(symbol):
                return self._described(symbol, span, comments)
            case (
                types.PrimitiveType()
                | types.PhysicalType()
                | types.EnumType()
                | types.ListType()
                | types.RangeType()
            ):
                return self._parameter(symbol, span, comments)
            case _:
                self._ctx.unsupported(
                    "OSC501", span, f"a field of type `{symbol.type}` is not supported yet"
                )
                return None

    def _parameters(self, field: sym.FieldSymbol, behavior: sym.BehaviorSymbol) -> None:
        """Declare the parameters of a behavior that is the type of a field (§7.2.2.2).

        It is not invoked, so it has only values; each is one of the scenario, `hop.n`.
        """
        if is_composed(behavior):
            self._ctx.state.invoked.append(behavior)  # it is a part of this one, not one to run
        for each in parameters_of(behavior):
            key = (field, each)
            if is_plain(each.type) and (
                key in self._constraints.found.by_key or each.origin == "user"
            ):
                declared = self._parameter(each, each.span, (), key)
                self._ctx.state.drawn.append(declared)

    def _other_actor(
        self,
        symbol: sym.FieldSymbol,
        default: ast.NameExpression,
        span: Span,
        comments: tuple[str, ...],
    ) -> ir.Parameter | None:
        """Lower an actor that an invocation may pass, and that is another actor by default."""
        value = lower_expression(self._ctx, default)
        if value is None:
            return None
        return ir.Parameter(
            name=symbol.name,
            span=span,
            comments=comments,
            type=lower_type(symbol.type),
            value=value,
            domain=None,
            is_fixed=False,
        )

    def _is_one_of_several(self, symbol: sym.FieldSymbol) -> bool:
        """Report an actor that constraints equate with one of several others."""
        about = self._constraints.found.by_key.get((symbol,), ())
        own = (c for c in about if c.subject == (symbol,) and not c.place.prefix)
        listed = (c for c in own if c.is_range and not self._is_given(symbol))
        constraint = next(listed, None)
        if constraint is not None:
            self._ctx.unsupported(
                "OSC501",
                constraint.span,
                f"which of several actors `{symbol.name}` is, is decided by the run",
                help=f"state which one: `keep({symbol.name} == …)`",
            )
        return constraint is not None

    def _is_for_caller(self, symbol: sym.FieldSymbol) -> bool:
        """Whether only an invocation decides the values of a struct."""
        assert isinstance(symbol.type, types.StructType)
        if symbol.default is not None or not self._is_given(symbol):
            return False
        if user_lineage(symbol.type.symbol):
            return self._objects.is_open(symbol)
        return not self._objects.is_said(symbol)

    def _has_value(self, symbol: sym.FieldSymbol) -> bool:
        if symbol.default is not None or self._is_given(symbol):
            return True
        setting = self._constraints.setting((symbol,), symbol.type)
        return setting.value is not None

    def _described(
        self, symbol: sym.FieldSymbol, span: Span, comments: tuple[str, ...]
    ) -> ir.Parameter | None:
        """Lower a list that constraints describe by its elements."""
        elements = self._ctx.model.elements.get(symbol, ())
        if elements:
            value = self._list_of_objects(symbol, elements)
        elif isinstance(symbol.type, types.ListType):
            value = lower_list(self._ctx, symbol, self._constraints)
        else:
            value = None
        if value is None:
            self._ctx.unsupported(
                "OSC501",
                span,
                f"`{symbol.name}`, a {symbol.type}, has no value",
                help="assign a value, `= value`, or constrain its elements, `keep(it[0] == value)`",
            )
            return None
        return ir.Parameter(
            name=symbol.name,
            span=span,
            comments=comments,
            type=lower_type(symbol.type),
            value=value,
            domain=None,
            is_fixed=False,
        )

    def _list_of_objects(
        self, symbol: sym.FieldSymbol, elements: tuple[sym.FieldSymbol, ...]
    ) -> ir.ListValue | None:
        """Declare the elements of a list, and return the list of them."""
        references = []
        for element in elements:
            declared = self.lower(element, element.span, ())
            if declared is None:
                return None
            self._ctx.state.drawn.append(declared)
            type_ = lower_type(element.type)
            references.append(ir.FieldRef(span=element.span, type=type_, name=element.name))
        type_ = lower_type(symbol.type)
        return ir.ListValue(span=symbol.span, type=type_, elements=tuple(references))

    def _is_given(self, symbol: sym.FieldSymbol) -> bool:
        """Whether some invocation of the scenario gives a parameter a value."""
        return symbol in self._ctx.program.handed_in

    def _parameter(
        self, field: sym.FieldSymbol, span: Span, comments: tuple[str, ...], key: Key | None = None
    ) -> ir.Parameter:
        key = key or (field,)
        setting = self._constraints.setting(key, field.type)
        domain = setting.domain
        if setting.value is not None and reads_map(setting.value):
            self._ctx.unsupported(
                "OSC501",
                setting.value.span,
                f"`{field.name}` is computed before the run, when the map is not known yet",
                help="write the expression at its use",
            )
        if setting.value is None and domain is None:
            domain = all_values(field.type, span)
        type_ = lower_type(field.type)
        return ir.Parameter(
            name=name_of(key),
            span=span,
            comments=(*comments, *setting.comments),
            type=type_,
            value=setting.value,
            domain=domain,
            is_fixed=setting.is_fixed,
            unit=authored_unit(self._ctx.model, type_, (setting.value, domain)),
        )
