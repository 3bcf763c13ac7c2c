"""Completion and signatures at the cursor."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from lsprotocol import types as lsp

from osc2tx.building.jobs import Job
from osc2tx.catalogue import catalogue
from osc2tx.language_server.contexts import Block, Cursor, OpenCall, cursor_at, path_before
from osc2tx.language_server.descriptions import declaration
from osc2tx.language_server.named_files import file_names
from osc2tx.language_server.programs import Program
from osc2tx.reference import Entry, Member, entries, find
from osc2tx.semantics import SemanticModel
from osc2tx.semantics.scope import is_subtype, supertypes
from osc2tx.semantics.symbols import (
    ActorSymbol,
    ActorType,
    BehaviorSymbol,
    EnumSymbol,
    EventSymbol,
    FieldSymbol,
    MethodSymbol,
    ModifierSymbol,
    ParameterSymbol,
    ScenarioSymbol,
    Symbol,
    TypeSymbol,
)

Kind = lsp.CompletionItemKind

_STATEMENTS = {
    Block.FILE: ("import", "namespace", "export", "scenario", "action", "modifier", "actor"),
    Block.TYPE: ("do", "keep", "event", "var", "def", "on", "cover", "record", "remove_default"),
    Block.DO: ("serial:", "parallel:", "one_of:", "wait", "emit", "call"),
    Block.WITH: ("keep", "until", "remove_default"),
    Block.ON: ("emit", "call"),
}
_MORE_STATEMENTS = ("struct", "enum", "extend", "global")
_PRIMITIVES = ("bool", "int", "uint", "float", "string")
_CONDITIONS = ("rise", "fall", "elapsed", "every")
_TYPE_PLACE = re.compile(r"^\s*(?:global\s+|var\s+)?\w+(?:\s*,\s*\w+)*\s*:\s*(?:list\s+of\s+)?\w*$")
_BASE_PLACE = re.compile(r"\b(?:inherits|extend|of)\s+\w*$")
_NUMBER_PLACE = re.compile(r"(?<![\w.])\d+(?:\.\d+)?[A-Za-z_]*$")
_EVENT_PLACE = re.compile(r"@(?:([\w.]*)\.)?\w*$")
_EMIT_PLACE = re.compile(r"^\s*(?:\w+\s*:\s*)?emit\s+\w*$")
_FIELD_HEADER = re.compile(r"(\w+)(?:\s*,\s*\w+)*\s*:\s*(?:list\s+of\s+)?[\w.]+\s+with:?$")
_FIELD_VALUE = re.compile(r"^\s*(?:global\s+|var\s+)?\w+(?:\s*,\s*\w+)*\s*:\s*(\w+)\s*=")
_COMPARED = re.compile(
    r"([A-Za-z_][\w.\[\]]*)(?:\([^()]*\))?\s*(?:[=!<>]=|[<>]|in\b)\s*[\[\d.\w]*$"
)
_MEMBER_PLACE = re.compile(r"\.\w*$")
_INVOCATION_PLACE = re.compile(r"^\s*(?:\w+\s*:\s*)*[\w.\[\]]*$")
_START_OF_LINE = re.compile(r"^\s*\w*$")
_BEHIND_LABEL = re.compile(r"^\s*\w+\s*:\s*\w*$")


def completions(
    text: str, offset: int, model: SemanticModel | None, job: Job
) -> list[lsp.CompletionItem]:
    """Return the completions at an offset, each once.

    Args:
        text: The text.
        offset: The offset of the cursor.
        model: A program that is similar to the text; without one, names of the library alone.
        job: The file.
    """
    files = file_names(text[text.rfind("\n", 0, offset) + 1 : offset], job)
    if files is not None:
        return [_item(name, Kind.File) for name in files]
    found: dict[str, lsp.CompletionItem] = {}
    for item in _candidates(cursor_at(text, offset), Program(model, offset)):
        found.setdefault(item.label, item)
    return list(found.values())


def _candidates(cursor: Cursor, program: Program) -> Iterator[lsp.CompletionItem]:
    before, owner = cursor.before, program.owner(cursor.declaration)
    declared = _FIELD_HEADER.match(cursor.header)
    program.it = program.type_of(declared[1], owner) if declared else None
    if found := _EVENT_PLACE.search(before):
        yield from _events(found[1] or "", owner, program)
    elif _EMIT_PLACE.match(before):
        yield from _declared_events(owner)
    elif _NUMBER_PLACE.search(before):
        yield from _units(_expected(cursor, owner, program), program)
    elif _MEMBER_PLACE.search(before):
        path = path_before(before.rpartition(".")[0])
        yield from _members(program.type_of(path, owner), cursor, program)
    elif cursor.call is not None:
        yield from _arguments(cursor.call, cursor, owner, program)
    elif _BASE_PLACE.search(before):
        yield from _types(program)
    elif _START_OF_LINE.match(before) or (cursor.block is Block.DO and _BEHIND_LABEL.match(before)):
        yield from _statements(cursor, owner, program)
    elif cursor.block is not Block.DO and _TYPE_PLACE.match(before):
        yield from _types(program)
    else:
        yield from _values(owner, program)


def _item(
    label: str, kind: Kind, detail: str = "", insert: str | None = None
) -> lsp.CompletionItem:
    return lsp.CompletionItem(label, kind=kind, detail=detail or None, insert_text=insert)


def _statements(
    cursor: Cursor, owner: TypeSymbol | None, program: Program
) -> Iterator[lsp.CompletionItem]:
    if cursor.block is Block.WITH:
        yield from _modifiers(cursor.header, owner, program)
    if cursor.block in (Block.DO, Block.WITH):
        yield from _fields(owner)
    if cursor.block is Block.DO:
        for symbol in program.of(ScenarioSymbol):
            if isinstance(symbol, ScenarioSymbol) and symbol.actor is None and symbol is not owner:
                yield _item(symbol.name, Kind.Class, declaration(symbol))
    more = _MORE_STATEMENTS if cursor.block is Block.FILE else ()
    for word in (*_STATEMENTS[cursor.block], *more):
        yield _item(word, Kind.Keyword)


def _fields(owner: TypeSymbol | None) -> Iterator[lsp.CompletionItem]:
    for type_ in () if owner is None else supertypes(owner):
        for name, member in type_.members.items():
            if isinstance(member, FieldSymbol):
                yield _item(name, Kind.Field, declaration(member))


def _members(
    reached: TypeSymbol | None, cursor: Cursor, program: Program
) -> Iterator[lsp.CompletionItem]:
    """Yield the completions after the dot of an object: its actions in a `do`, its members."""
    if reached is None:
        return
    acts = cursor.block is Block.DO and _INVOCATION_PLACE.match(cursor.before)
    if acts and isinstance(reached, ActorSymbol):
        for behavior in _behaviors(reached, program):
            yield _item(behavior.name, Kind.Method, declaration(behavior), f"{behavior.name}()")
    for type_ in supertypes(reached):
        for name, member in type_.members.items():
            kind = Kind.Method if isinstance(member, MethodSymbol) else Kind.Field
            kind = Kind.Event if isinstance(member, EventSymbol) else kind
            yield _item(name, kind, declaration(member))


def _behaviors(actor: ActorSymbol, program: Program) -> Iterator[BehaviorSymbol]:
    known: Iterable[Symbol] = () if program.model is None else program.model.actions
    for each in (*known, *program.symbols):
        if isinstance(each, BehaviorSymbol) and not isinstance(each, ModifierSymbol):
            is_abstract = each.qualified_name in catalogue().abstract
            if not is_abstract and each.actor is not None and is_subtype(actor, each.actor):
                yield each


def _behavior(path: str, owner: TypeSymbol | None, program: Program) -> BehaviorSymbol | None:
    """Return the behavior that a dotted name invokes."""
    receiver, _, name = path.rpartition(".")
    if not receiver:
        scenarios = program.of(ScenarioSymbol)
        found = (s for s in scenarios if isinstance(s, ScenarioSymbol) and s.name == name)
        return next(found, None)
    actor = program.type_of(receiver, owner)
    if not isinstance(actor, ActorSymbol):
        return None
    return next((each for each in _behaviors(actor, program) if each.name == name), None)


def _invoked(header: str) -> str:
    """Return the invoked name of a line with a `with:` block."""
    found = re.search(r"([A-Za-z_][\w.\[\]]*)\s*(?:\(.*)?\s*with:?$", header)
    return found[1] if found else ""


def _modifiers(
    header: str, owner: TypeSymbol | None, program: Program
) -> Iterator[lsp.CompletionItem]:
    behavior = _behavior(_invoked(header), owner, program)
    names = set()
    for type_ in () if behavior is None else supertypes(behavior):
        entry = catalogue().actions.get(getattr(type_, "qualified_name", ""))
        names |= set() if entry is None else set(entry.modifiers)
    for each in entries():
        if each.declaration.kind == "modifier" and each.own_name in names:
            yield _item(
                each.own_name, Kind.Function, each.declaration.meaning, f"{each.own_name}()"
            )
    for symbol in program.of(ModifierSymbol):
        if isinstance(symbol, ModifierSymbol) and (
            behavior is None or symbol.target is None or is_subtype(behavior, symbol.target)
        ):
            yield _item(symbol.name, Kind.Function, declaration(symbol), f"{symbol.name}()")


def _arguments(
    call: OpenCall, cursor: Cursor, owner: TypeSymbol | None, program: Program
) -> Iterator[lsp.CompletionItem]:
    parameters = _parameters(call, cursor, owner, program)
    name, colon, _ = call.argument.partition(":")
    if colon:
        type_ = next((type_ for each, type_ in parameters if each == name.strip()), "")
        yield from _values_of(type_, program)
    else:
        for parameter, type_ in parameters:
            if parameter not in call.named:
                yield _item(parameter, Kind.Property, type_, f"{parameter}: ")
        if call.index < len(parameters):
            yield from _values_of(parameters[call.index][1], program)
    yield from _values(owner, program)


def _parameters(
    call: OpenCall, cursor: Cursor, owner: TypeSymbol | None, program: Program
) -> list[tuple[str, str]]:
    """Return the parameters of the callee, with their types."""
    receiver, _, name = call.callee.rpartition(".")
    if behavior := _behavior(call.callee, owner, program):
        found = dict(_fields_of(behavior))
        return [*found.items(), *([] if "duration" in found else [("duration", "time")])]
    if receiver and (reached := program.type_of(receiver, owner)) is not None:
        for type_ in supertypes(reached):
            member = type_.members.get(name)
            if isinstance(member, MethodSymbol | EventSymbol):
                return [(each.name, str(each.type)) for each in member.parameters]
    for symbol in program.of(ModifierSymbol):
        if symbol.name == name and isinstance(symbol, TypeSymbol):
            return list(_fields_of(symbol))
    return [(each.name, each.type) for each in _library_parameters(name)]


def _fields_of(symbol: TypeSymbol) -> Iterator[tuple[str, str]]:
    for type_ in reversed(list(supertypes(symbol))):
        for name, member in type_.members.items():
            if isinstance(member, FieldSymbol) and not member.is_variable and name != "actor":
                yield name, str(member.type)


def _library_parameters(name: str) -> Sequence[Member]:
    found: list[Entry] = [each for each in find(name) if each.declaration.kind == "modifier"]
    return found[0].declaration.members if found else ()


def _values_of(type_: str, program: Program) -> Iterator[lsp.CompletionItem]:
    """Yield the values of a type that have names."""
    if type_ == "bool":
        yield from (_item(word, Kind.Keyword) for word in ("true", "false"))
    for symbol in program.of(EnumSymbol):
        if isinstance(symbol, EnumSymbol) and symbol.name == type_:
            yield from (_item(name, Kind.EnumMember, type_) for name in symbol.members)
    for entry in find(f"enum {type_}"):
        for member in entry.declaration.members:
            yield _item(member.name, Kind.EnumMember, member.meaning or type_)


def _values(owner: TypeSymbol | None, program: Program) -> Iterator[lsp.CompletionItem]:
    yield from _fields(owner)
    for word in _CONDITIONS:
        yield _item(word, Kind.Function, "event condition", f"{word}()")
    for word in ("true", "false", "it", "not", "and", "or", "in"):
        yield _item(word, Kind.Keyword)


def _events(path: str, owner: TypeSymbol | None, program: Program) -> Iterator[lsp.CompletionItem]:
    """Yield the events behind an `@` and a dotted name, which may be empty."""
    for word in ("start", "end", "fail"):
        yield _item(word, Kind.Event)
    if path:
        yield from _declared_events(program.type_of(path, owner))
        return
    for type_ in () if owner is None else supertypes(owner):
        for name, member in type_.members.items():
            if isinstance(member, EventSymbol):
                yield _item(name, Kind.Event, declaration(member))
            elif not isinstance(member, ParameterSymbol | MethodSymbol):
                is_actor = isinstance(getattr(member, "type", None), ActorType)
                if is_actor or not isinstance(member, FieldSymbol):
                    yield _item(name, Kind.Field, declaration(member))


def _declared_events(owner: TypeSymbol | None) -> Iterator[lsp.CompletionItem]:
    for type_ in () if owner is None else supertypes(owner):
        for name, member in type_.members.items():
            if isinstance(member, EventSymbol):
                yield _item(name, Kind.Event, declaration(member))


def _expected(cursor: Cursor, owner: TypeSymbol | None, program: Program) -> str:
    """Return the type that the number at the cursor should have; empty if that is open."""
    compared = _COMPARED.search(cursor.before)
    if compared and compared[1] not in _CONDITIONS:
        return program.value_of(compared[1], owner)
    if cursor.call is None:
        declared = _FIELD_VALUE.match(cursor.before)
        return declared[1] if declared else ""
    if cursor.call.callee in ("elapsed", "every", "wait"):
        return "time"
    parameters = _parameters(cursor.call, cursor, owner, program)
    name = cursor.call.argument.partition(":")[0].strip() if ":" in cursor.call.argument else ""
    by_place = [type_ for _, type_ in parameters[cursor.call.index : cursor.call.index + 1]]
    found = dict(parameters).get(name, "") if name else "".join(by_place)
    return found.removeprefix("range of ")


def _units(type_: str, program: Program) -> Iterator[lsp.CompletionItem]:
    """Yield the units of a type; all units if it has none."""
    known = () if program.model is None else program.model.known_units
    for unit in [each for each in known if str(each.type) == type_] or known:
        yield _item(unit.name, Kind.Unit, str(unit.type))


def _types(program: Program) -> Iterator[lsp.CompletionItem]:
    for symbol in program.of((TypeSymbol, EnumSymbol)):
        if not isinstance(symbol, ModifierSymbol):
            yield _item(symbol.name, Kind.Class, declaration(symbol))
    for entry in entries():
        kind = entry.declaration.kind
        if kind in ("actor", "struct", "enum", "type"):
            yield _item(entry.declaration.name, Kind.Class, entry.declaration.meaning)
    for word in _PRIMITIVES:
        yield _item(word, Kind.Keyword)


def signature(text: str, offset: int, model: SemanticModel | None) -> lsp.SignatureHelp | None:
    """Return the parameters of the call in whose parentheses an offset is."""
    cursor, program = cursor_at(text, offset), Program(model, offset)
    call = cursor.call
    if call is None:
        return None
    parameters = _parameters(call, cursor, program.owner(cursor.declaration), program)
    if not parameters:
        return None
    names = [name for name, _ in parameters]
    written = call.argument.partition(":")[0].strip() if ":" in call.argument else ""
    active = names.index(written) if written in names else min(call.index, len(names) - 1)
    labels = [f"{name}: {type_}" for name, type_ in parameters]
    shown = lsp.SignatureInformation(
        f"{call.callee}({', '.join(labels)})",
        parameters=[lsp.ParameterInformation(label) for label in labels],
    )
    return lsp.SignatureHelp([shown], active_signature=0, active_parameter=active)
