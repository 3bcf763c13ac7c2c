"""Objects of a scenario, actors and structs, with the values that constraints give them."""

from __future__ import annotations

from itertools import chain

from osc2tx import ir
from osc2tx.analysis.constraints.operation_list import Key
from osc2tx.analysis.constraints.parameter_lookup import name_of
from osc2tx.diagnostics import Span
from osc2tx.lowering.constraints.constraints import ConstraintLowering
from osc2tx.lowering.constraints.list_constraints import fixed_elements
from osc2tx.lowering.constraints.parameter_domains import all_values
from osc2tx.lowering.context import LoweringContext
from osc2tx.lowering.declarations.combined_types import (
    add_types,
    lineage,
    most_special,
    shared_member,
)
from osc2tx.lowering.declarations.global_names import field_name
from osc2tx.lowering.declarations.map_fields import (
    NOT_SEARCHED_BY,
    SEARCHED_BY,
    is_search_criterion,
    reads_map,
)
from osc2tx.lowering.declarations.members_read import Path, with_reads_written
from osc2tx.lowering.declarations.user_fields import (
    TypeSymbol,
    class_default,
    is_left_out,
    is_plain,
    object_default,
    stated_default,
    user_fields,
    user_lineage,
)
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.references import member_of
from osc2tx.semantics import symbols as sym
from osc2tx.semantics import types
from osc2tx_shared.classes import replace


class ObjectLowering:
    """Lowers the values of the objects of one scenario.

    Args:
        ctx: The checked program.
        constraints: Its constraints.
    """

    def __init__(self, ctx: LoweringContext, constraints: ConstraintLowering) -> None:
        self._ctx = ctx
        self._constraints = constraints

    def struct(
        self, field: sym.FieldSymbol, span: Span, comments: tuple[str, ...], names: tuple[str, ...]
    ) -> ir.Struct | None:
        """Lower a value of a struct type: a whole value, or values of its fields."""
        whole = self._constraints.setting((field,), field.type)
        if whole.value is not None:
            for value in self._said((field,)).values():
                self._ctx.unsupported(
                    "OSC502",
                    value.span,
                    f"`{field.name}` already has a value as a whole",
                    help=f"state either the value of `{field.name}` or those of its fields",
                )
            if ir.is_live(whole.value):
                self._ctx.unsupported(
                    "OSC502",
                    whole.value.span,
                    f"`{field.name}` cannot depend on the state of the world",
                    help="write the expression at its use",
                )
                return None
        return ir.Struct(
            name=field.name,
            span=span,
            comments=(*comments, *whole.comments),
            type=names[0],
            values=self.values(field) if whole.value is None else (),
            value=whole.value,
            lineage=names,
        )

    def types_of(self, field: sym.FieldSymbol) -> tuple[TypeSymbol, ...]:
        """Return the types of an object: the declared one, or special ones that its values select.

        The type must be known at compile time, as far as that changes anything.
        """
        assert isinstance(field.type, types.ActorType | types.StructType)
        found = self._special((field,), field.type.symbol, field.span)
        is_made_elsewhere = field in self._ctx.program.handed_in
        for key, special in self._constraints.found.undecided:
            if key == (field,) and special.statements and not is_made_elsewhere:
                self._ctx.unsupported(
                    "OSC501",
                    field.span,
                    f"whether `{field.name}` is a `{special.name}` is decided by the run",
                    help="fix what it depends on: "
                    f"`keep({field.name}.{_condition_of(special)})`, or another value",
                )
        return found

    def _special(self, key: Key, declared: TypeSymbol, span: Span) -> tuple[TypeSymbol, ...]:
        """Return the most special types that an object is of."""
        found = most_special((declared, *self._constraints.found.special.get(key, ())))
        if (shared := shared_member(found)) is not None:
            names = " and ".join(f"`{type_.name}`" for type_ in found)
            self._ctx.unsupported(
                "OSC501",
                span,
                f"`{name_of(key[-1:])}` is both {names}: they both have a `{shared}` of their own",
                help="rename one of them, or let one of the types inherit from the other",
            )
        return found

    def is_said(self, field: sym.FieldSymbol) -> bool:
        """Whether a constraint mentions a member of an object."""
        return any(len(key) > 1 for key in self._constraints.found.members.get(field, ()))

    def is_open(self, field: sym.FieldSymbol) -> bool:
        """Whether no constraint states all values that the class of an object requires."""
        if not isinstance(field.type, types.ActorType | types.StructType):
            return False
        ctx = self._ctx.quiet()
        object_ = self._reference(field)
        looking = ObjectLowering(ctx, replace(self._constraints, ctx=ctx))
        looking._complete((field,), self.types_of(field), object_, looking._said((field,)))
        is_open = (isinstance(d, ir.Parameter) and d.is_required for d in ctx.state.drawn)
        return ctx.sink.has_errors or any(is_open)

    def values(self, field: sym.FieldSymbol) -> tuple[ir.FieldValue, ...]:
        """Return the facts about an object; values that constraints leave open can be set."""
        found = self._said((field,))
        object_ = self._reference(field)
        is_object = isinstance(field.type, types.ActorType | types.StructType)
        types_ = self.types_of(field) if is_object else ()
        self._complete((field,), types_, object_, found)
        elements = fixed_elements(self._ctx, self._constraints, field)
        return (*_without_object(self._ctx, object_.name, types_, found), *elements)

    def of_parameter(self, key: Key, type_: types.StructType, object_: ir.FieldRef) -> ir.Struct:
        """Lower a struct that constraints of an invocation describe by its fields.

        Args:
            key: The invocation and its parameter.
            type_: Type of the parameter.
            object_: Its declaration.
        """
        found = self._said(key)
        types_ = self._special(key, type_.symbol, object_.span)
        self._complete(key, types_, object_, found)
        names = lineage(*types_)
        add_types(self._ctx, types_, object_.span)
        return ir.Struct(
            name=object_.name,
            span=object_.span,
            type=names[0],
            values=_without_object(self._ctx, object_.name, types_, found),
            lineage=names,
        )

    def _reference(self, field: sym.FieldSymbol) -> ir.FieldRef:
        name = field_name(self._ctx, field)
        return ir.FieldRef(span=field.span, type=lower_type(field.type), name=name)

    def _said(self, object_: Key) -> dict[Key, ir.FieldValue]:
        """Return the values that constraints fix or bound, except defaults of the class."""
        found: dict[Key, ir.FieldValue] = {}
        for key, setting in self._constraints.members(object_):
            value, member = setting.value, key[-1]
            assert isinstance(member, sym.FieldSymbol)
            if setting.domain is not None and value is None and is_search_criterion(member):
                value = setting.domain
            elif value is None and setting.domain is not None:
                value = self._ctx.draw(name_of(key), setting.domain, lower_type(member.type))
            if value is not None and _is_own_method(value):
                self._ctx.unsupported(
                    "OSC501",
                    value.span,
                    f"a method of the object that it belongs to computes `{member.name}`",
                    help="write the expression of the method instead",
                )
                continue
            if value is not None and reads_map(value):
                self._ctx.unsupported("OSC502", value.span, NOT_SEARCHED_BY, help=SEARCHED_BY)
                continue
            if value is not None and not self._is_of_class(member, value):
                path = tuple(name_of((part,)) for part in key[len(object_) :])
                found[key] = ir.FieldValue(
                    path=path, value=value, span=value.span, comments=setting.comments
                )
        return found

    def _is_of_class(self, member: sym.FieldSymbol, value: ir.Expression) -> bool:
        """Whether a value is the default that the class of an own type has anyway."""
        stated = stated_default(self._ctx, member) if member.origin == "user" else None
        is_stated = stated is not None and stated.span == value.span
        return is_stated and class_default(self._ctx, member) is not None

    def _complete(
        self,
        key: Key,
        types_: tuple[TypeSymbol, ...],
        object_: ir.Expression,
        found: dict[Key, ir.FieldValue],
    ) -> None:
        """Give a value to each field of an own type that has none and no default of its class."""
        lineages = (reversed(user_lineage(type_)) for type_ in types_)
        for each in dict.fromkeys(chain.from_iterable(lineages)):
            for member in user_fields(self._ctx, each):
                inner = (*key, member)
                if inner in found or is_left_out(self._ctx, each, member):
                    continue
                if _contains_itself(key, member):
                    self._ctx.unsupported(
                        "OSC501",
                        member.span,
                        f"`{member.name}` makes a `{member.type}` contain another one endlessly",
                        help="remove the field: a field of a struct type always has a value",
                    )
                elif isinstance(member.type, types.StructType) and member.default is None:
                    below = member_of(self._ctx, object_, member, member.span)
                    self._complete(inner, (member.type.symbol,), below, found)
                elif not self._has_class_default(inner, member):
                    value = self._open(inner, member, object_)
                    if value is not None:
                        path = tuple(name_of((part,)) for part in inner[len(_outside(inner)) :])
                        found[inner] = ir.FieldValue(path=path, value=value, span=value.span)

    def _is_described(self, key: Key) -> bool:
        """Whether a constraint mentions a list, its size or its elements."""
        return any(each[: len(key)] == key for each in self._constraints.found.by_key)

    def _has_class_default(self, key: Key, member: sym.FieldSymbol) -> bool:
        return self._is_in_force(key) and class_default(self._ctx, member) is not None

    def _is_in_force(self, key: Key) -> bool:
        """Whether no `remove_default` took away the default of a field; variables keep theirs."""
        is_variable = any(isinstance(m, sym.FieldSymbol) and m.is_variable for m in key)
        return is_variable or key in self._constraints.found.by_key

    def _open(
        self, key: Key, member: sym.FieldSymbol, object_: ir.Expression
    ) -> ir.Expression | None:
        """Return the default of this object's field, or a value that settings of a run choose."""
        if self._is_in_force(key):
            value = object_default(self._ctx, member, object_)
            if value is not None:
                return value
        if is_plain(member.type):
            domain = all_values(member.type, member.span)
            return self._ctx.draw(name_of(key), domain, lower_type(member.type), member.span)
        if isinstance(member.type, types.ListType) and not self._is_described(key):
            type_ = lower_type(member.type)  # of any size: none is the least
            return ir.ListValue(span=member.span, type=type_, elements=())
        self._ctx.unsupported(
            "OSC501",
            key[0].span,
            f"`{name_of(key[:-1])}` does not state its `{member.name}`",
            help=f"`keep({name_of(key)} == value)`, or give it a default",
        )
        return None


def _is_own_method(value: ir.Expression) -> bool:
    """Whether a method of the object itself, which does not exist yet, computes a value."""
    calls = (part for part in ir.walk(value) if isinstance(part, ir.MethodCall))
    return any(isinstance(a.value, ir.ScenarioSelf) for call in calls for a in call.arguments)


def _outside(key: Key) -> Key:
    """Return the key of an object: its field, or an invocation and its parameter."""
    return key[:1] if isinstance(key[0], sym.FieldSymbol) else key[:2]


def _condition_of(special: TypeSymbol) -> str:
    condition = special.condition
    return "" if condition is None else " ".join(condition.span.text.strip("()").split())


def _without_object(
    ctx: LoweringContext, name: str, types_: tuple[TypeSymbol, ...], found: dict[Key, ir.FieldValue]
) -> tuple[ir.FieldValue, ...]:
    """Return the values; a reference to a field of the same object is replaced by its value."""
    by_path = {value.path: value.value for value in found.values()}

    def value_at(path: Path) -> ir.Expression | None:
        if path[0] != name:
            return None
        return by_path.get(path[1:]) or _default_at(ctx, types_, path[1:])

    return tuple(
        replace(each, value=_decided(with_reads_written(each.value, (name, *each.path), value_at)))
        for each in found.values()
    )


def _decided(value: ir.Expression) -> ir.Expression:
    """Return the case that counts of a value by cases, where both sides of a condition are known.

    Fields of the same object that have their defaults are known: no run sets them.
    """
    while isinstance(value, ir.Conditional) and isinstance(value.condition, ir.Binary):
        sides = [_constant(side) for side in (value.condition.left, value.condition.right)]
        if value.condition.operator != "==" or None in sides:
            break
        value = value.when_true if sides[0] == sides[1] else value.when_false
    return value


def _constant(value: ir.Expression) -> bool | int | float | str | None:
    return value.value if isinstance(value, ir.Literal | ir.EnumValue) else None


def _default_at(
    ctx: LoweringContext, types_: tuple[TypeSymbol, ...], path: tuple[str, ...]
) -> ir.Expression | None:
    """Return the default that the classes of an object have for a member, or one below it."""
    if not path:
        return None
    lineages = chain.from_iterable(map(user_lineage, types_))
    fields = (member for each in lineages for member in user_fields(ctx, each))
    member = next((member for member in fields if member.name == path[0]), None)
    if member is None or not path[1:]:
        return None if member is None else class_default(ctx, member)
    type_ = member.type
    below = (type_.symbol,) if isinstance(type_, types.ActorType | types.StructType) else ()
    return _default_at(ctx, below, path[1:])


def _contains_itself(key: Key, member: sym.FieldSymbol) -> bool:
    """Whether a member without a value is of a struct that it is in itself."""
    above = (each.type for each in key if isinstance(each, sym.FieldSymbol))
    is_struct = isinstance(member.type, types.StructType) and member.default is None
    return is_struct and any(str(type_) == str(member.type) for type_ in above)
