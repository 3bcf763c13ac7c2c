"""Mistakes that come from other languages; see `common_mistakes`."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import Edit, Help, leave_out, rewrite, write
from osc2tx.syntax import tokens as t
from osc2tx.syntax.mistake_places import NUMBERS, TYPES, Advice, Place

_CHOICE = "use `wait`, `one_of` or `on … if`, or a conditional expression `a ? b : c`"
_LOOP = "repeat the members, or react to `every(…)` with `on`"
_TYPE = "types are declared with `struct`, `actor` or `enum`"
_METHOD = "a method is declared in a type, `def name(…) -> type is expression …`"

STATEMENTS: Mapping[str, str] = {
    **dict.fromkeys(("if", "else", "elif", "switch", "case", "match"), _CHOICE),
    **dict.fromkeys(("for", "while", "repeat", "loop"), _LOOP),
    **dict.fromkeys(("class", "type"), _TYPE),
    **dict.fromkeys(("function", "func", "fn"), _METHOD),
    "assert": "a run fails by `on rise(…): emit fail`, values are constrained by `keep(…)`",
    "from": "write `import` and the file in quotes, or the dotted name of a module",
    "return": "the value of a method is in its head: `is expression …`",
    "let": "a field is declared `name: type = value`, without `let`",
    "const": "a field is declared `name: type = value`, without `const`",
}
LOOPS = frozenset({"for", "while", "repeat", "loop"})
# Heads of blocks.
COMPOSITIONS: Mapping[str, str] = {
    **dict.fromkeys(("seq", "sequence", "sequential", "then", "steps"), "serial"),
    **dict.fromkeys(
        ("all", "all_of", "concurrently", "fork", "mix", "par", "simultaneous", "together"),
        "parallel",
    ),
    **dict.fromkeys(("any", "any_of", "first_of", "race", "select", "selector"), "one_of"),
}
# Words behind a call, on the same line.
BEHIND_A_CALL: Mapping[str, str] = {
    "until": "end the line with `with:`, and write `until …` indented below",
    "for": "the duration is an argument: `(duration: 3s)`",
    "after": "let that time pass before it: `wait elapsed(3s)`",
    "when": "wait for it on a line before: `wait …`",
    "if": "wait for it on a line before: `wait …`",
    "while": "end the line with `with:`, and write `until not (…)` indented below",
    "then": "write what follows on a line of its own, below `serial:`",
}


BOUNDS = NUMBERS | {t.PHYSICAL, t.ID}
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
    named = place.table.span(line, line + 1)
    help_ = write(named, words, f"write `{words}:`", is_safe=False)
    return Advice("a label is a single word", help_, line + 1)


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
        what = "`until` belongs in a `with:` block"
    return Advice(what, _into_the_call(place) or BEHIND_A_CALL[word])


def _into_the_call(place: Place) -> Help:
    """Return the fix that moves `until …` below the call, and `for 3s` into its arguments."""
    word, table = place.text(), place.table
    end = place.at
    while table.types[end + 1] not in (t.NEWLINE, t.EOF):
        end += 1
    has_block = table.types[end + 2 : end + 3] == [t.INDENT] or table.text(end) == ":"
    if word == "until" and end > place.at and not has_block:
        indentation = " " * (table.indentation(table.starts[place.line]) + 4)
        return rewrite([Edit(place.between(-1), f" with:\n{indentation}")], BEHIND_A_CALL[word])
    if word == "for" and place.kind(1) == t.PHYSICAL and end == place.at + 1:
        comma = "" if place.kind(-2) == _LPAREN else ", "
        argument = Edit(place.span(-1), f"{comma}duration: {place.text(1)})")
        rest = Edit(Span(table.source, place.span(-1).end, table.ends[end]), "")
        return rewrite([argument, rest], BEHIND_A_CALL[word])
    return None


def wait_until(place: Place) -> Advice | None:
    """`wait until x > 3`."""
    line = place.line
    if place.table.text(line) != "wait" or place.table.text(line + 1) != "until":
        return None
    if place.at not in (line + 1, line + 2):
        return None
    between = Span(place.table.source, place.table.ends[line], place.table.starts[line + 2])
    edits = [Edit(between, " ")]
    help_ = rewrite(edits, "a condition follows `wait` at once: `wait …`")
    return Advice("unexpected `until` after `wait`", help_, line + 1)


def arrow(place: Place) -> Advice | None:
    """`a.drive() -> b.drive()`."""
    if place.text() != "->" or place.kind(-1) != _RPAREN:
        return None
    if place.table.types[place.line] == t.KEYWORDS["def"]:
        return None
    each = "write each on a line of its own, below `serial:`"
    steps = _steps(place)
    help_ = each if steps is None else rewrite([steps], each, is_safe=False)
    return Advice("there is no `->` between actions", help_)


def _steps(place: Place) -> Edit | None:
    """Return the edit that makes a serial of the actions in a line; none above a block."""
    table, end = place.table, place.at
    while table.types[end] not in (t.NEWLINE, t.EOF):
        end += 1
    if table.types[end : end + 2] == [t.NEWLINE, t.INDENT]:
        return None
    first = place.line + (table.text(place.line) == "do")
    span = table.span(first, end - 1)
    indentation = " " * (table.indentation(table.starts[place.line]) + 4)
    steps = [step.strip() for step in span.text.split("->")]
    return Edit(span, f"\n{indentation}".join(["serial:", *steps]))


def event_in_parentheses(place: Place) -> Advice | None:
    """`until(@e)`."""
    if place.kind() != _AT or place.kind(-1) != _LPAREN or place.at - 2 != place.line:
        return None
    word = place.text(-2)
    if word not in ("wait", "until", "on"):
        return None
    close = place.at
    while place.table.types[close] not in (_RPAREN, t.NEWLINE, t.EOF):
        close += 1
    edits = [Edit(Span(place.table.source, place.table.ends[place.line], place.span().start), " ")]
    if place.table.types[close] == _RPAREN:
        edits.append(Edit(place.table.span(close, close), ""))
    help_ = rewrite(edits, f"an event has no parentheses: `{word} @{place.text(1)}`")
    return Advice(f"unexpected `(` after `{word}`", help_, place.at - 1)


def colon_inheritance(place: Place) -> Advice | None:
    """`actor a: vehicle`."""
    if place.table.types[place.line] not in TYPES or place.kind(-1) != _COLON:
        return None
    if place.kind() != t.ID:
        return None
    word = place.text()
    edits = [Edit(place.between(-2), " inherits ")]
    if place.kind(1) == t.NEWLINE and place.kind(2) == t.INDENT:
        edits.append(Edit(place.behind(), ":"))
    help_ = rewrite(edits, f"a base type is written `inherits {word}:`")
    return Advice(f"expected the end of the line, found `{word}`", help_)


def condition_of_inheritance(place: Place) -> Advice | None:
    """`actor a inherits vehicle(field: value)`, as one example of the standard has it."""
    opened = place.open_bracket()
    if place.text() not in (":", "=") or opened is None or opened - 2 < place.line:
        return None
    if place.table.text(opened - 2) != "inherits":
        return None
    help_ = write(place.between(-1, 1), " == ", f"write `{place.text(-1)} == {place.text(1)}`")
    return Advice(f"expected `==`, found `{place.text()}`", help_)


def other_inheritance(place: Place) -> Advice | None:
    """`actor a extends vehicle:`, `actor a(vehicle):`."""
    if place.table.types[place.line] not in TYPES or place.kind(1) != t.ID:
        return None
    in_parentheses = place.kind() == _LPAREN and place.kind(2) == _RPAREN
    if place.text() not in ("extends", "is", "of") and not in_parentheses:
        return None
    base = place.text(1)
    edits = [Edit(place.span(), "inherits")]
    if in_parentheses:
        edits = [Edit(place.span(0, 2), f" inherits {base}")]
    help_ = rewrite(edits, f"a base type is written `inherits {base}:`")
    return Advice(f"unexpected `{place.text()}`", help_)


def list_type(place: Place) -> Advice | None:
    """`l: list<int>`."""
    if place.text(-1) != ">" or place.text(-3) != "<" or place.text(-4) != "list":
        return None
    help_ = write(place.span(-4, -1), f"list of {place.text(-2)}")
    return Advice("a list of a type has no `<…>`", help_, place.at - 3)


def enum_block(place: Place) -> Advice | None:
    """`enum a:` with a block of names."""
    if place.table.text(place.line) != "enum" or place.kind() != t.NEWLINE:
        return None
    return Advice("the members of an enum are in brackets", "write `enum name: [first, second]`")


def range_without_brackets(place: Place) -> Advice | None:
    """`speed(10kph..20kph)`."""
    if place.kind() != _DOTS:
        return None
    if place.kind(-1) not in BOUNDS or place.kind(1) not in BOUNDS:
        return Advice("unexpected `..`", "a range is written `[from..to]`")
    lower, upper = place.text(-1), place.text(1)
    if place.kind(-1) in NUMBERS and place.kind(1) == t.PHYSICAL:  # one unit for both
        lower += upper.lstrip("0123456789.+-eE")
    range_ = f"[{lower}..{upper}]"
    return Advice("a range is in brackets", write(place.span(-1, 1), range_))


def other_arithmetic(place: Place) -> Advice | None:
    """`2 ** 3` and `50%`."""
    if place.kind() == _STAR and place.kind(-1) == _STAR:
        return Advice("there is no operator `**`", "multiply: `a * a`", place.at - 1)
    if place.kind(-1) == _PERCENT and place.kind(-2) in NUMBERS:
        number = place.text(-2)
        share = f"{float(number) / 100:g}"
        help_ = write(place.span(-2, -1), share, f"a share is a plain number: `{share}`")
        return Advice("`%` is the remainder of a division", help_, place.at - 1)
    return None


def emitted_with_at(place: Place) -> Advice | None:
    """`emit @e`."""
    if place.kind() != _AT or place.text(-1) != "emit":
        return None
    help_ = leave_out(place.span(), f"write `emit {place.text(1)}`")
    return Advice("unexpected `@`", help_)


def declared_parentheses(place: Place) -> Advice | None:
    """`action a():`."""
    head = place.table.types[place.line]
    is_named = head in TYPES or head == t.KEYWORDS["modifier"]
    if not is_named or place.kind() != _LPAREN or place.kind(-1) != t.ID:
        return None
    word = place.table.text(place.line)
    help_: Help = "its parameters are fields in the body: `name: type`"
    if place.kind(1) == _RPAREN:
        help_ = leave_out(place.span(0, 1), "its parameters are fields in the body: `name: type`")
    return Advice(f"the name of a declared {word} has no parentheses", help_)


def other_operators(place: Place) -> Advice | None:
    """`!x`, `a :: b`."""
    if place.kind() == _BANG:
        help_ = write(place.span(), "not ", "a negation is written `not`")
        return Advice("unexpected `!`", help_)
    if place.kind() == _DOUBLE_COLON:
        edit = Edit(place.table.span(place.at, place.at), "::")
        name = "a qualified name has no blanks: `namespace::name`"
        around = [Edit(place.between(-1), ""), edit, Edit(place.between(0, 1), "")]
        return Advice("unexpected `::`", rewrite(around, name))
    return None


def other_strength(place: Place) -> Advice | None:
    """`keep(soft a == 3)`."""
    if place.table.text(place.line) != "keep" or place.at - 3 != place.line:
        return None
    word = place.text(-1)
    if word not in ("soft", "weak", "strong"):
        return None
    default = "write `keep(default …)`: it applies unless a later constraint replaces it"
    help_ = write(place.span(-1), "default", default)
    return Advice(f"there is no constraint of strength `{word}`", help_, place.at - 1)


def not_in(place: Place) -> Advice | None:
    """`a not in l`."""
    if place.text() != "not" or place.text(1) != "in":
        return None
    negated = f"not {place.text(-1)} in {place.text(2)}"
    help_ = write(place.span(-1, 2), negated, is_safe=False)
    return Advice("`not in` is no operator", help_)


def several_events(place: Place) -> Advice | None:
    """`wait @a or @b`."""
    if place.kind() != _AT or place.text(-1) not in ("or", "and"):
        return None
    if place.text(-1) == "or":
        help_ = "wait for each in a member of `one_of`; several `until` are an or"
    else:
        help_ = "wait for each in a member of `parallel`"
    return Advice("an event specification names one event", help_, place.at - 1)


def condition_alone(place: Place) -> Advice | None:
    """`wait if n > 2`."""
    if place.text(-1) != "if" or place.at - 2 != place.line or place.kind() not in t.WORDS:
        return None
    word = place.table.text(place.line)
    if word not in ("wait", "until", "on"):
        return None
    alone = f"a condition is used alone: `{word} {place.text()} …`; `if` follows an `@event`"
    help_ = write(place.between(-2), " ", alone)
    return Advice(f"unexpected `if` after `{word}`", help_, place.at - 1)


def type_with_brackets(place: Place) -> Advice | None:
    """`l: int[]`."""
    if place.text() != "]" or place.text(-1) != "[" or place.text(-3) != ":":
        return None
    help_ = write(place.span(-2, 0), f"list of {place.text(-2)}")
    return Advice("a list type has no brackets", help_, place.at - 1)


def namespace_block(place: Place) -> Advice | None:
    """`namespace a:`."""
    if place.kind() != _COLON or place.table.text(place.line) != "namespace":
        return None
    all_ = "omit the `:`; it applies to all that follows, up to the next `namespace`"
    help_ = leave_out(place.span(), all_)
    return Advice("a namespace has no block", help_)


def import_as(place: Place) -> Advice | None:
    """`import a.b as c`."""
    if place.text() != "as" or place.table.text(place.line) != "import":
        return None
    help_ = "names of an imported file are reached by its namespaces: `namespace mine use theirs`"
    return Advice("an import has no other name", help_)


def sum_with_unit(place: Place) -> Advice | None:
    """`(20 + 10)kph`."""
    if place.kind(-1) != _RPAREN or place.kind() != t.ID or place.at == place.line:
        return None
    opened = Place(place.table, place.at - 1, place.line).open_bracket()
    if opened is None or place.table.types[opened - 1] == t.ID:
        return None  # a call
    inner = place.table.types[opened + 1 : place.at - 1]
    if not any(kind in NUMBERS for kind in inner):
        return None
    texts = []
    for index in range(opened, place.at):
        is_number = place.table.types[index] in NUMBERS
        texts.append(place.table.text(index) + (place.text() if is_number else ""))
    written = " ".join(texts).replace("( ", "(").replace(" )", ")")
    help_ = write(place.table.span(opened, place.at), written)
    return Advice("a unit belongs to a number", help_)


def list_goes_on(place: Place) -> Advice | None:
    """`export a,` with nothing behind."""
    if place.kind() != t.NEWLINE or place.text(-1) != ",":
        return None
    help_ = leave_out(place.span(-1), "leave the comma out")
    return Advice("a name is missing behind the last `,`", help_)
