"""Actors and structs that the scenario's files declare, as classes of the module."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import takewhile
from typing import TypeAlias, TypeVar

from osc2tx import ir
from osc2tx.diagnostics import Span
from osc2tx.ir.source_text import condensed
from osc2tx.lowering.context import (
    LoweringContext,
    apart,
    present,
    stated_keeps,
    statement_comments,
)
from osc2tx.lowering.declarations.user_fields import (
    TypeSymbol,
    class_default,
    class_default_keep,
    has_added_fields,
    is_optional,
    own_members,
    unused_fields,
    user_bases,
    user_fields,
)
from osc2tx.lowering.value_types import lower_type
from osc2tx.lowering.values.methods import lower_method
from osc2tx.semantics import SemanticModel, types
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast


def lower_enums(model: SemanticModel, module: ir.Module) -> tuple[ir.UserEnum, ...]:
    """Return the enums of the root file, and those of imported files that a module refers to.

    Args:
        model: The checked program.
        module: Its other parts.
    """
    declared = {_place(each.span): each for each in _user_enums(model)}
    nodes: dict[sym.Symbol | None, list[EnumNode]] = {each: [] for each in declared.values()}
    for node in _of_files(model, ast.EnumDeclaration):
        if (symbol := declared.get(_place(node.name.span))) is not None:
            nodes[symbol].append(node)
    for extension in _of_files(model, ast.EnumExtension):
        if (extended := model.symbol_of(extension.name)) in nodes:
            nodes[extended].append(extension)
    lowered = tuple(_lower_enum(each, nodes[each]) for each in declared.values())
    own = {each.span for each in lowered if each.span.source is model.root.span.source}
    if len(own) == len(lowered):
        return lowered
    words = set(ir.words((module.scenarios, module.types, module.actions, module.modifiers)))
    return tuple(each for each in lowered if each.span in own or each.name in words)


def _user_enums(model: SemanticModel) -> Iterator[sym.EnumSymbol]:
    return (each for each in model.symbols if isinstance(each, sym.EnumSymbol))


def _lower_enum(symbol: sym.EnumSymbol, nodes: Sequence[EnumNode]) -> ir.UserEnum:
    """Lower an enum, with the comments of its declaration and its extensions."""
    type_ = lower_type(types.EnumType(symbol))
    lines = tuple(line for each in nodes for line in statement_comments(each))
    told = ((m.name.text, statement_comments(m)) for node in nodes for m in node.members)
    return ir.UserEnum(
        name=type_.name,
        span=symbol.span,
        members=type_.members,
        comments=lines if len(nodes) == 1 else tuple(map(str, lines)),
        told=tuple((name, lines) for name, lines in told if lines),
    )


def lower_units(model: SemanticModel) -> tuple[ir.UserUnit, ...]:
    """Return the units of a program that have comments."""
    nodes = _of_files(model, ast.UnitDeclaration)
    return tuple(
        ir.UserUnit(name=node.name.text, span=node.span, comments=statement_comments(node))
        for node in nodes
        if statement_comments(node)
    )


EnumNode: TypeAlias = ast.EnumDeclaration | ast.EnumExtension

StatementT = TypeVar("StatementT", bound=ast.Statement)


def _of_files(model: SemanticModel, kind: type[StatementT]) -> Iterator[StatementT]:
    """Yield the statements of a kind of all files of a program."""
    for file in model.files:
        yield from (each for each in file.statements if isinstance(each, kind))


def lower_types(ctx: LoweringContext) -> tuple[ir.UserType, ...]:
    """Lower the types of declared objects that are not the library's, and all of the root file.

    Bases come first, and so do the types of fields, as far as they do not need each other. Of two
    types of one name that no object has, one is left out.
    """
    symbols: dict[str, TypeSymbol] = {}
    for symbol in ctx.used.types:
        _add(ctx, symbol, symbols, ())
    seen: set[TypeSymbol] = set()
    for symbol in (*symbols.values(), *_own_types(ctx)):
        _add_unused(ctx.quiet(), symbol, symbols, seen)
    for combined in ctx.used.combined.values():
        if combined.name in symbols:
            _report_name(ctx, combined.name, combined.span)
    nodes = {_place(node.name.span): node for node in _declarations(ctx)}
    lowered = []
    for each in symbols.values():
        if each.origin == "user":
            lowered.append(_lower_type(ctx, each, nodes.get(_place(each.span))))
        else:
            lowered.append(_lower_extended(ctx, each))
    return (*lowered, *ctx.used.combined.values())


def _place(span: Span) -> tuple[str, int]:
    return span.source.name, span.start


def _own_types(ctx: LoweringContext) -> Iterable[TypeSymbol]:
    """Yield the types that the root file declares, and those of the library that it extends."""
    source = ctx.model.root.span.source
    for symbol in ctx.model.symbols:
        if isinstance(symbol, sym.ActorSymbol | sym.StructSymbol) and symbol.span.source is source:
            yield symbol
    for symbol, node in _extensions(ctx):
        if node.span.source is source and has_added_fields(symbol):
            yield symbol


def _extensions(ctx: LoweringContext) -> Iterator[tuple[TypeSymbol, ast.TypeExtension]]:
    """Yield the extensions of actors and structs, those of the root file last."""
    for node in _of_files(ctx.model, ast.TypeExtension):
        symbol = ctx.model.symbol_of(node.name.name)
        if isinstance(symbol, sym.ActorSymbol | sym.StructSymbol):
            yield symbol, node


def _add_unused(
    ctx: LoweringContext,
    symbol: TypeSymbol,
    symbols: dict[str, TypeSymbol],
    seen: set[TypeSymbol],
) -> None:
    """Add a type and the types of unmentioned fields; types added before are complete."""
    _add(ctx, symbol, symbols, ())
    pending = [symbol]
    while pending:
        for each in takewhile(lambda t: t not in seen, user_bases(pending.pop())):
            seen.add(each)
            for field in unused_fields(ctx, each):
                for needed in _object_types(field.type):
                    _add(ctx, needed, symbols, ())
                    pending.append(needed)


def _add(
    ctx: LoweringContext,
    symbol: TypeSymbol,
    symbols: dict[str, TypeSymbol],
    around: tuple[TypeSymbol, ...],
) -> None:
    """Add a type below all that it needs; above one that is there, all its bases are."""
    missing = takewhile(lambda t: symbols.get(t.name) is not t, user_bases(symbol))
    for each in reversed(tuple(missing)):
        if each in around:
            continue
        for field in user_fields(ctx, each):
            for needed in _object_types(field.type):
                _add(ctx, needed, symbols, (*around, each))
        if symbols.setdefault(each.name, each) is not each:
            _report_name(ctx, each.name, each.span)


def _report_name(ctx: LoweringContext, name: str, span: Span) -> None:
    ctx.unsupported(
        "OSC501",
        span,
        f"another type of the module has the name `{name}`",
        help="names of types are unique in a module, across namespaces: rename one",
    )


def _object_types(type_: types.Type) -> Iterable[TypeSymbol]:
    match type_:
        case types.ActorType(symbol=symbol) | types.StructType(symbol=symbol):
            return (symbol,)
        case types.ListType(element=element):
            return _object_types(element)
        case _:
            return ()


def _lower_type(
    ctx: LoweringContext,
    symbol: TypeSymbol,
    node: ast.ActorDeclaration | ast.StructDeclaration | None,
) -> ir.UserType:
    defaults = _class_defaults(ctx, symbol)
    comments, below = apart(() if node is None else statement_comments(node))
    return ir.UserType(
        name=symbol.name,
        span=symbol.span,
        comments=(*comments, *_comment_lines(ctx, symbol)),
        bases=_bases(symbol),
        is_actor=isinstance(symbol, sym.ActorSymbol),
        fields=tuple(_lower_field(ctx, field) for field in user_fields(ctx, symbol)),
        unused=tuple(_lower_field(ctx, field) for field in unused_fields(ctx, symbol)),
        methods=present([_lower_method(ctx, each) for each in _methods(symbol)]),
        keeps=(
            *stated_keeps(each for each in symbol.statements if each not in defaults),
            *map(str, below),
        ),
    )


def _bases(symbol: TypeSymbol) -> tuple[str, ...]:
    """Name the base of a type; types of a dialect have a class only if they are extended."""
    base, with_class = symbol.base, set(user_bases(symbol))
    while base is not None and base.origin == "prelude" and base not in with_class:
        base = base.base
    return () if base is None else (base.name,)


def _comment_lines(ctx: LoweringContext, symbol: TypeSymbol) -> Iterator[str]:
    """Yield the comments of the extensions of a type."""
    for extended, node in _extensions(ctx):
        if extended is symbol:
            yield from map(str, statement_comments(node))


def _lower_extended(ctx: LoweringContext, symbol: TypeSymbol) -> ir.UserType:
    """Lower a type of the library to which the user adds fields, directly or through a base.

    Its position is that of the last extension, which is in the root file if that has one. A type of
    a dialect becomes an own type.
    """
    is_of_library = symbol.origin == "library"
    above = user_bases(symbol)
    found = [[n for s, n in _extensions(ctx) if s is each] for each in above]
    own, nodes = found[0], next(each for each in found if each)
    bases = _bases(symbol) if len(found) > 1 or not is_of_library else ()
    defaults = _class_defaults(ctx, symbol)
    return ir.UserType(
        name=symbol.name,
        span=nodes[-1].span,
        comments=tuple(line for node in own for line in statement_comments(node)),
        bases=bases,
        is_actor=isinstance(symbol, sym.ActorSymbol),
        fields=tuple(_lower_field(ctx, field) for field in user_fields(ctx, symbol)),
        unused=tuple(_lower_field(ctx, field) for field in unused_fields(ctx, symbol)),
        methods=present([_lower_method(ctx, each) for each in _methods(symbol)]),
        keeps=tuple(
            stated_keeps(each for node in own for each in node.members if each not in defaults)
        ),
        is_of_library=is_of_library,
    )


def _class_defaults(ctx: LoweringContext, symbol: TypeSymbol) -> frozenset[ast.Statement]:
    """Return the constraints of a type that are defaults in its class."""
    fields = (each for each in own_members(symbol) if isinstance(each, sym.FieldSymbol))
    keeps = (class_default_keep(ctx, field) for field in fields)
    return frozenset(keep for keep in keeps if keep is not None)


def _methods(symbol: TypeSymbol) -> Iterable[sym.MethodSymbol]:
    return (each for each in own_members(symbol) if isinstance(each, sym.MethodSymbol))


def _lower_method(ctx: LoweringContext, method: sym.MethodSymbol) -> ir.Method | None:
    """Lower a method; one that is refused is reported where it is called."""
    inside = ctx.quiet()
    comments = () if method.node is None else statement_comments(method.node)
    lowered = lower_method(inside, method, comments)
    return None if inside.sink.has_errors else lowered


def _declarations(ctx: LoweringContext) -> Iterable[ast.ActorDeclaration | ast.StructDeclaration]:
    for file in ctx.model.files:
        for statement in file.statements:
            if isinstance(statement, ast.ActorDeclaration | ast.StructDeclaration):
                yield statement


def _lower_field(ctx: LoweringContext, field: sym.FieldSymbol) -> ir.UserField:
    """Lower a field; of several in one declaration, the first has its comments."""
    node = field.node
    is_first = node is not None and node.names[0].span == field.span
    return ir.UserField(
        name=field.name,
        span=field.span,
        comments=_field_comments(ctx, field, node) if node is not None and is_first else (),
        type=lower_type(field.type),
        default=class_default(ctx, field),
        is_optional=is_optional(ctx, field),
    )


def _field_comments(
    ctx: LoweringContext,
    field: sym.FieldSymbol,
    node: ast.ParameterDeclaration | ast.VariableDeclaration,
) -> tuple[str, ...]:
    """Return the comment lines of a field, and its constraints as the source has them.

    One that is the default in the class is there.
    """
    default = class_default_keep(ctx, field)
    keeps: list[ast.KeepConstraint] = []
    if isinstance(node, ast.ParameterDeclaration):
        own = {id(each) for each in node.constraints}
        keeps = [each for each in field.constraints if id(each) in own]
    if default is not None and default not in keeps:
        keeps.append(default)
    lines = [*statement_comments(node)]
    for keep in keeps:
        lines += map(condensed, statement_comments(keep))
        lines += () if keep is default else (condensed(keep.span.text),)
    return tuple(lines)
