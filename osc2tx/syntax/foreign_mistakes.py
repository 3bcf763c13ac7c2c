"""Mistakes of people who know other languages; see `common_mistakes`."""

from __future__ import annotations

from osc2tx.syntax import tokens as t
from osc2tx.syntax.foreign_words import BEHIND_A_CALL, LOOPS, STATEMENTS
from osc2tx.syntax.mistake_places import NUMBERS, TYPES, Advice, Place

_COLON, _LPAREN, _RPAREN, _BANG, _AT, _DOT = (t.PUNCTUATION[symbol] for symbol in ":()!@.")
_STAR, _PERCENT = (t.PUNCTUATION[symbol] for symbol in "*%")
_DOTS, _DOUBLE_COLON = t.PUNCTUATION[".."], t.PUNCTUATION["::"]


def label_of_two_words(place: Place) -> Advice | None:
    """`switch 2: parallel():`."""
    line, types = place.line, place.table.types
    if types[line] not in t.WORDS or types[line + 1] not in (t.INTEGER, t.ID):
        return None
    if types[line + 2] != _COLON or types[line + 3] == t.NEWLINE or place.at > line + 2:
        return None
    words = f"{place.table.text(line)}_{place.table.text(line + 1)}"
    return Advice("a label is a single word", f"write `{words}:`", line + 1)


def statement(place: Place) -> Advice | None:
    """`if x:`, `for i in l:`, `class a:`."""
    word = place.table.text(place.line) if place.line != place.at else place.text()
    if word not in STATEMENTS or place.open_bracket() is not None:
        return None
    following = place.table.types[place.line + 1]
    if following == _DOT or (following == _COLON and place.kind() != t.NEWLINE):
        return None  # a field, a label or a receiver of that name
    if word in LOOPS:
        what = "there are no loops in OpenSCENARIO DSL"
    else:
        what = f"there is no statement `{word}` in OpenSCENARIO DSL"
    return Advice(what, STATEMENTS[word], place.line)


def behind_a_call(place: Place) -> Advice | None:
    """`ego.drive() until @e`, `ego.drive() for 3s`."""
    word = place.text()
    if word not in BEHIND_A_CALL or place.kind(-1) != _RPAREN:
        return None
    what = f"there is no `{word}` behind a call"
    if word == "until":
        what = "`until` belongs into a `with:` block"
    return Advice(what, BEHIND_A_CALL[word])


def colon_inheritance(place: Place) -> Advice | None:
    """`actor a: vehicle`."""
    if place.table.types[place.line] not in TYPES or place.kind(-1) != _COLON:
        return None
    if place.kind() != t.ID:
        return None
    word = place.text()
    help_ = f"a base type is written `inherits {word}:`"
    return Advice(f"expected the end of the line, found `{word}`", help_)


def other_inheritance(place: Place) -> Advice | None:
    """`actor a extends vehicle:`, `actor a(vehicle):`."""
    if place.table.types[place.line] not in TYPES or place.kind(1) != t.ID:
        return None
    in_parentheses = place.kind() == _LPAREN and place.kind(2) == _RPAREN
    if place.text() not in ("extends", "is", "of") and not in_parentheses:
        return None
    help_ = f"a base type is written `inherits {place.text(1)}:`"
    return Advice(f"unexpected `{place.text()}`", help_)


def list_type(place: Place) -> Advice | None:
    """`l: list<int>`."""
    if place.text(-1) != ">" or place.text(-3) != "<" or place.text(-4) != "list":
        return None
    help_ = f"write `list of {place.text(-2)}`"
    return Advice("a list of a type has no `<…>`", help_, place.at - 3)


def enum_block(place: Place) -> Advice | None:
    """`enum a:` with a block of names."""
    if place.table.text(place.line) != "enum" or place.kind() != t.NEWLINE:
        return None
    return Advice("the members of an enum stand in brackets", "write `enum name: [first, second]`")


def range_without_brackets(place: Place) -> Advice | None:
    """`speed(10kph..20kph)`."""
    if place.kind() != _DOTS:
        return None
    return Advice("a range stands in brackets", f"write `[{place.text(-1)}..{place.text(1)}]`")


def other_arithmetic(place: Place) -> Advice | None:
    """`2 ** 3` and `50%`."""
    if place.kind() == _STAR and place.kind(-1) == _STAR:
        return Advice("there is no operator `**`", "multiply: `a * a`", place.at - 1)
    if place.kind(-1) == _PERCENT and place.kind(-2) in NUMBERS:
        number = place.text(-2)
        help_ = f"a share is a plain number: `{float(number) / 100:g}`"
        return Advice("`%` is the remainder of a division", help_, place.at - 1)
    return None


def emitted_with_at(place: Place) -> Advice | None:
    """`emit @e`."""
    if place.kind() != _AT or place.text(-1) != "emit":
        return None
    return Advice("unexpected `@`", f"write `emit {place.text(1)}`")


def declared_parentheses(place: Place) -> Advice | None:
    """`action a():`."""
    head = place.table.types[place.line]
    is_named = head in TYPES or head == t.KEYWORDS["modifier"]
    if not is_named or place.kind() != _LPAREN or place.kind(-1) != t.ID:
        return None
    word = place.table.text(place.line)
    help_ = "its parameters are fields in the body: `name: type`"
    return Advice(f"the name of a declared {word} has no parentheses", help_)


def other_operators(place: Place) -> Advice | None:
    """`!x`, `a :: b`."""
    if place.kind() == _BANG:
        return Advice("unexpected `!`", "a negation is written `not`")
    if place.kind() == _DOUBLE_COLON:
        return Advice("unexpected `::`", "a qualified name has no blanks: `namespace::name`")
    return None
