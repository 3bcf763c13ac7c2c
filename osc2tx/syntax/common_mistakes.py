"""Typical mistakes that are recognised by the tokens around them, with a better message.

Each remedy looks at the place where the parser stopped and returns message and help line, or
`None` when it does not apply. The first that applies is used.
"""

from __future__ import annotations

from collections.abc import Callable

from osc2tx.diagnostics.fixes import insert, insert_before, leave_out, write
from osc2tx.diagnostics.suggestions import name_meant
from osc2tx.syntax import foreign_mistakes as foreign
from osc2tx.syntax import tokens as t
from osc2tx.syntax.foreign_mistakes import COMPOSITIONS
from osc2tx.syntax.mistake_places import CLOSERS, NUMBERS, Advice, Place
from osc2tx.syntax.tokens import TokenTable

_ASSIGN, _COLON, _AT = (t.PUNCTUATION[symbol] for symbol in "=:@")
_RPAREN, _RBRACKET, _DOTS = (t.PUNCTUATION[text] for text in (")", "]", ".."))
_CONSTRAINTS = {t.KEYWORDS[word] for word in ("keep", "remove_default", "cover", "record")}
_BLOCK_WORDS = ("serial", "parallel", "one_of", "with")
_LINE_BREAKS = frozenset({t.NEWLINE, t.INDENT, t.DEDENT})
_NO_STARTERS = (
    "with",
    "and",
    "or",
    "not",
    "in",
    "is",
    "as",
    "of",
    "if",
    "list",
    "range",
    "only",
    "hard",
)
_STARTERS = [word for word in t.KEYWORDS if word not in _NO_STARTERS]


def remedy(table: TokenTable, index: int) -> Advice | None:
    """Return message and help line for a well-known mistake at a token, if it is one."""
    line = index
    while line > 0 and table.types[line - 1] not in _LINE_BREAKS:
        line -= 1
    place = Place(table, index, line)
    for attempt in _REMEDIES:
        advice = attempt(place)
        if advice is not None:
            return advice
    return None


def _blank_before_unit(place: Place) -> Advice | None:
    if place.kind(-1) not in NUMBERS or place.kind() not in t.WORDS or place.at == place.line:
        return None
    if place.text() in ("if", "else"):
        return Advice(f"unexpected `{place.text()}`", "a choice is written `condition ? a : b`")
    number, unit = place.text(-1), place.text()
    is_quotient = place.text(1) == "/" and place.kind(2) in t.WORDS
    written = f"{number}{unit}/{place.text(2)}" if is_quotient else f"{number}{unit}"
    help_ = write(place.span(-1, 2 if is_quotient else 0), written)
    return Advice(f"a unit follows its number without a blank: `{unit}`", help_)


def _range_with_unit(place: Place) -> Advice | None:
    if place.kind(-1) != _RBRACKET or place.kind() != t.ID:
        return None
    inner = Place(place.table, place.at - 1, place.line)
    start = inner.open_bracket()
    if start is None or _DOTS not in place.table.types[start : place.at]:
        return None
    table = place.table
    dots = table.types.index(_DOTS, start)
    lower = table.source.text[table.ends[start] : table.starts[dots]].strip()
    upper = table.source.text[table.ends[dots] : table.starts[place.at - 1]].strip()
    unit = place.text()
    help_ = write(table.span(start, place.at), f"[{lower}{unit}..{upper}{unit}]")
    return Advice(f"the unit `{unit}` belongs to both bounds of the range, not behind it", help_)


def _sampled_parameter(place: Place) -> Advice | None:
    """`k: speed = sample(v, @e)` without `var`."""
    opened = place.open_bracket()
    if place.kind() != _AT or opened is None or place.table.text(opened - 1) != "sample":
        return None
    first = place.table.span(place.line, place.line)
    help_ = insert_before(first, "var ", "declare it with `var`")
    return Advice("only a variable is sampled", help_, opened - 1)


def _global_variable(place: Place) -> Advice | None:
    """`global var n: int`."""
    is_global = place.at - 2 == place.line and place.table.text(place.line) == "global"
    if not is_global or place.text(-1) != "var":
        return None
    type_ = place.text(2) if place.kind(1) == _COLON and place.kind(2) == t.ID else "type"
    help_ = f"write `global {place.text()}: {type_} = value`"
    return Advice("there are no global variables", help_, place.at - 1)


def _point_without_digits(place: Place) -> Advice | None:
    """`1.`, a number without digits behind its point."""
    dot = -1 if place.text(-1) == "." else 0
    if place.text(dot) != "." or place.kind(dot - 1) != t.INTEGER:
        return None
    number = place.text(dot - 1)
    return Advice(f"`{number}.` is not a number", write(place.span(dot - 1, dot), f"{number}.0"))


def _unbalanced_bracket(place: Place) -> Advice | None:
    if place.kind() not in CLOSERS:
        return None
    opened = place.open_bracket()
    if opened is None:
        help_ = leave_out(place.span(), "leave it out")
        return Advice(f"`{place.text()}` closes nothing", help_)
    bracket = place.table.text(opened)
    if (bracket == "(") != (place.text() == ")"):
        close = ")" if bracket == "(" else "]"
        message = f"expected `{close}` to close `{bracket}`, found `{place.text()}`"
        return Advice(message, write(place.span(), close, is_safe=False))
    return None


def _assignment(place: Place) -> Advice | None:
    if place.kind() != _ASSIGN:
        return None
    opened = place.open_bracket()
    if opened is not None and place.table.types[opened - 1] in _CONSTRAINTS:
        help_ = write(place.span(), "==", "a comparison is written `==`")
        return Advice("expected `==`, found `=`", help_)
    if opened is not None and place.table.types[place.line] == t.KEYWORDS["def"]:
        declared = "a parameter is declared `name: type = value`"
        return Advice("expected `:`, found `=`", declared)
    if opened is not None and place.kind(-1) == t.ID:
        named = f"a named argument is written `{place.text(-1)}: value`"
        help_ = write(place.between(-2 + 1, 1), ": ", named)
        return Advice("expected `:`, found `=`", help_)
    if place.table.types[place.line] == t.KEYWORDS["var"]:
        return Advice(
            "expected `:` and a type, found `=`", "a variable is declared `var name: type = value`"
        )
    if place.table.types[place.line] == t.ID:
        declare = "declare a field `name: type = value`, or constrain one by `keep(name == value)`"
        return Advice("there are no assignments in OpenSCENARIO DSL", declare)
    return None


def _with_below(place: Place) -> Advice | None:
    """`with:` on a line of its own, below an invocation."""
    if place.kind() != t.KEYWORDS["with"] or place.at != place.line:
        return None
    help_ = "end the line of the invocation with ` with:`, and indent its lines below"
    return Advice("`with:` on a line of its own belongs to a composition in the same column", help_)


def _misspelt_statement(place: Place) -> Advice | None:
    """`scenaro x:`, `wiat @x`, `a.b() wiht:`."""
    if place.at - 1 == place.line and place.kind(-1) == t.ID:
        follows = place.kind() in t.WORDS or place.kind() == _AT
        token, candidates = place.line, _STARTERS if follows else []
    else:
        follows = place.kind() == t.ID and place.kind(-1) == _RPAREN and place.kind(1) == _COLON
        token, candidates = place.at, ["with"] if follows else []
    word = place.table.text(token)
    meant = name_meant(place.table.span(token, token), candidates, 0.7, is_safe=True)
    return Advice(f"unknown word `{word}`", meant, token) if meant else None


def _missing_colon_of_argument(place: Place) -> Advice | None:
    """`f(at start)`."""
    opened = place.open_bracket()
    if place.kind(-1) != t.ID or place.kind() not in t.WORDS or opened is None:
        return None
    name, value = place.text(-1), place.text()
    if value.startswith("::"):
        qualified = f"a qualified name has no blanks: `{name}{value}`"
        help_ = write(place.between(-1), "", qualified)
        return Advice(f"unexpected `{value}`", help_)
    if place.table.types[opened - 1] != t.ID:
        return None
    named = f"a named argument is written `{name}: {value}`"
    help_ = write(place.between(-1), ": ", named)
    return Advice(f"expected `,`, `:` or an operator, found `{value}`", help_)


def _missing_name(place: Place) -> Advice | None:
    """`scenario:` with nothing between."""
    if place.kind() != t.NEWLINE or place.at - 2 != place.line or place.kind(-1) != _COLON:
        return None
    word = place.table.text(place.line)
    if word not in ("struct", "actor", "scenario", "action", "modifier", "enum", "extend"):
        return None
    return Advice(f"missing name after `{word}`", f"write `{word} name:`", place.line)


def _misspelt_composition(place: Place) -> Advice | None:
    """`seriel:` or `paralel(…):` at the end of a line."""
    if place.kind() == _COLON:
        end = place.at
    elif place.kind() == t.NEWLINE and place.kind(-1) == _COLON:
        end = place.at - 1
    else:
        return None
    index = end - 1
    if index > place.line and place.table.types[index] == _RPAREN:
        opened = Place(place.table, index, place.line).open_bracket()
        index = index if opened is None else opened - 1
    if index < place.line or place.table.types[index] != t.ID:
        return None
    word = place.table.text(index)
    if word in COMPOSITIONS:
        what = f"there is no composition `{word}` in OpenSCENARIO DSL"
        named = place.table.span(index, index)
        help_ = write(named, COMPOSITIONS[word], f"write `{COMPOSITIONS[word]}:`", is_safe=False)
        return Advice(what, help_, index)
    meant = name_meant(place.table.span(index, index), _BLOCK_WORDS, 0.7, is_safe=True)
    if meant:
        return Advice(f"unknown word `{word}`", meant, index)
    follows = place.table.text(index - 1) in ("do", ":")
    begins = follows or (word not in t.KEYWORDS and index == place.line)
    if place.kind() == t.NEWLINE and place.kind(1) == t.INDENT and index == end - 1 and begins:
        block = "a block begins with `serial:`, `parallel:` or `one_of:`, behind its label"
        return Advice(f"`{word}` is no composition", block, index)
    if place.kind() == t.NEWLINE and index < end - 1:
        name = place.table.source.text[place.table.starts[place.line] : place.table.ends[end - 1]]
        with_ = (
            f"write `{name} with:`" if len(name) <= 40 and "\n" not in name else "write ` with:`"
        )
        help_ = insert(place.table.span(end - 1, end - 1), " with", with_)
        if place.kind(1) != t.INDENT:
            colon = leave_out(place.table.span(end, end), "leave the `:` out")
            return Advice("an invocation has no block, so no `:`", colon, end)
        return Advice("`with` is missing before the `:` of an invocation", help_)
    return None


def _colon_after_directive(place: Place) -> Advice | None:
    if place.kind() != _COLON or place.at - 1 != place.line:
        return None
    word = place.table.text(place.line)
    if place.table.types[place.line] not in t.KEYWORD_TYPES:
        return None
    colon = f"write `{word} @event` without a colon"
    help_ = leave_out(place.span(), colon, is_safe=False)
    return Advice(f"unexpected `:` after `{word}`", help_)


def _constraint_without_parentheses(place: Place) -> Advice | None:
    if place.at - 1 != place.line or place.table.types[place.line] not in _CONSTRAINTS:
        return None
    word = place.table.text(place.line)
    return Advice(f"missing `(` after `{word}`", f"write `{word}(…)`")


_REMEDIES: tuple[Callable[[Place], Advice | None], ...] = (
    _global_variable,
    _point_without_digits,
    _sampled_parameter,
    foreign.behind_a_call,
    foreign.wait_until,
    foreign.event_in_parentheses,
    foreign.arrow,
    foreign.other_strength,
    foreign.not_in,
    foreign.several_events,
    foreign.condition_alone,
    foreign.type_with_brackets,
    foreign.namespace_block,
    foreign.import_as,
    foreign.sum_with_unit,
    foreign.list_goes_on,
    _blank_before_unit,
    _range_with_unit,
    foreign.label_of_two_words,
    foreign.statement,
    _unbalanced_bracket,
    foreign.condition_of_inheritance,
    _assignment,
    _with_below,
    _misspelt_composition,
    _misspelt_statement,
    _missing_colon_of_argument,
    _missing_name,
    foreign.colon_inheritance,
    foreign.other_inheritance,
    foreign.enum_block,
    foreign.list_type,
    foreign.range_without_brackets,
    foreign.other_arithmetic,
    foreign.emitted_with_at,
    foreign.declared_parentheses,
    _colon_after_directive,
    _constraint_without_parentheses,
    foreign.other_operators,
)
