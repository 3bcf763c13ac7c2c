"""Typical mistakes that are recognised by the tokens around them, with a better message.

Each remedy looks at the place where the parser stopped and returns message and help line, or
`None` when it does not apply. The first that applies is used.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from osc2tx.diagnostics.suggestions import did_you_mean
from osc2tx.syntax import tokens as t
from osc2tx.syntax.tokens import TokenTable

_ASSIGN, _COLON, _LPAREN, _BANG, _AT = (t.PUNCTUATION[symbol] for symbol in "=:(!@")
_DOTS, _DOUBLE_COLON = t.PUNCTUATION[".."], t.PUNCTUATION["::"]
_OPENERS = {t.PUNCTUATION[text] for text in ("(", "[")}
_CLOSERS = {t.PUNCTUATION[text] for text in (")", "]")}
_RPAREN, _RBRACKET = t.PUNCTUATION[")"], t.PUNCTUATION["]"]
_NUMBERS = frozenset({t.INTEGER, t.FLOAT})
_TYPES = {t.KEYWORDS[word] for word in ("struct", "actor", "scenario", "action")}
_CONSTRAINTS = {t.KEYWORDS[word] for word in ("keep", "remove_default", "cover", "record")}
_LINE_BREAKS = frozenset({t.NEWLINE, t.INDENT, t.DEDENT})
_FOREIGN = frozenset(
    ("if", "else", "elif", "for", "while", "switch", "case", "class", "from", "return", "match")
)
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


class Advice(NamedTuple):
    """What to say.

    Attributes:
        message: What is wrong.
        help: What to do about it.
        token: Index of the token to point at, when it is not the one that does not fit.
    """

    message: str
    help: str | None = None
    token: int | None = None


class Place(NamedTuple):
    """Where the parser stopped.

    Attributes:
        table: All tokens.
        at: Index of the token that does not fit.
        line: Index of the first token of its logical line.
    """

    table: TokenTable
    at: int
    line: int

    def kind(self, distance: int = 0) -> int:
        """Return the type of a token near the place."""
        index = self.at + distance
        return self.table.types[index] if 0 <= index < len(self.table.types) else t.EOF

    def text(self, distance: int = 0) -> str:
        """Return the text of a token near the place."""
        return self.table.text(self.at + distance)

    def open_bracket(self) -> int | None:
        """Return the index of the innermost bracket of the line that is open here."""
        depth = 0
        for index in range(self.at - 1, self.line - 1, -1):
            if self.table.types[index] in _CLOSERS:
                depth += 1
            elif self.table.types[index] in _OPENERS:
                if depth == 0:
                    return index
                depth -= 1
        return None


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
    if place.kind(-1) not in _NUMBERS or place.kind() not in t.WORDS or place.at == place.line:
        return None
    number, unit = place.text(-1), place.text()
    return Advice(f"a unit follows its number without a blank: `{unit}`", f"write `{number}{unit}`")


def _range_with_unit(place: Place) -> Advice | None:
    if place.kind(-1) != _RBRACKET or place.kind() != t.ID:
        return None
    inner = Place(place.table, place.at - 1, place.line)
    start = inner.open_bracket()
    if start is None or _DOTS not in place.table.types[start : place.at]:
        return None
    dots = place.table.types.index(_DOTS, start)
    source = place.table.source.text
    lower = source[place.table.ends[start] : place.table.starts[dots]].strip()
    upper = source[place.table.ends[dots] : place.table.starts[place.at - 1]].strip()
    unit = place.text()
    help_ = f"write `[{lower}{unit}..{upper}{unit}]`"
    return Advice(f"the unit `{unit}` belongs to both bounds of the range, not behind it", help_)


def _foreign_statement(place: Place) -> Advice | None:
    word = place.table.text(place.line) if place.line != place.at else place.text()
    if word not in _FOREIGN or place.open_bracket() is not None:
        return None
    help_ = None
    if word in ("if", "else", "elif", "switch", "case", "match"):
        help_ = "use `wait`, `one_of` or `on … if`, or a conditional expression `a ? b : c`"
    return Advice(f"there is no statement `{word}` in OpenSCENARIO DSL", help_)


def _sampled_parameter(place: Place) -> Advice | None:
    """`k: speed = sample(v, @e)` without `var`."""
    opened = place.open_bracket()
    if place.kind() != _AT or opened is None or place.table.text(opened - 1) != "sample":
        return None
    return Advice("only a variable is sampled", "declare it with `var`", opened - 1)


def _loop(place: Place) -> Advice | None:
    """`repeat(3):`."""
    word = place.table.text(place.line)
    if word not in ("repeat", "loop") or place.kind() not in (_COLON, t.NEWLINE):
        return None
    help_ = "write the members as often as they shall happen, or wait for `every(…)` in an `on`"
    return Advice("there are no loops in OpenSCENARIO DSL", help_, place.line)


def _global_variable(place: Place) -> Advice | None:
    """`global var n: int`."""
    is_global = place.at - 2 == place.line and place.table.text(place.line) == "global"
    if not is_global or place.text(-1) != "var":
        return None
    help_ = f"write `global {place.text()}: type = value`"
    return Advice("there are no global variables", help_, place.at - 1)


def _point_without_digits(place: Place) -> Advice | None:
    """`1.`, a number without digits behind its point."""
    dot = -1 if place.text(-1) == "." else 0
    if place.text(dot) != "." or place.kind(dot - 1) != t.INTEGER:
        return None
    number = place.text(dot - 1)
    return Advice(f"`{number}.` is not a number", f"write `{number}.0`")


def _until_behind_a_call(place: Place) -> Advice | None:
    """`ego.drive() until @e`."""
    if place.text() != "until" or place.at == place.line:
        return None
    help_ = "end the line with `with:`, and write `until …` indented below"
    return Advice("`until` belongs into a `with:` block", help_)


def _unbalanced_bracket(place: Place) -> Advice | None:
    if place.kind() not in _CLOSERS:
        return None
    opened = place.open_bracket()
    if opened is None:
        return Advice(f"`{place.text()}` closes nothing")
    bracket = place.table.text(opened)
    if (bracket == "(") != (place.text() == ")"):
        close = ")" if bracket == "(" else "]"
        return Advice(f"expected `{close}` to close `{bracket}`, found `{place.text()}`")
    return None


def _assignment(place: Place) -> Advice | None:
    if place.kind() != _ASSIGN:
        return None
    opened = place.open_bracket()
    if opened is not None and place.table.types[opened - 1] in _CONSTRAINTS:
        return Advice("expected `==`, found `=`", "a comparison is written `==`")
    if opened is not None and place.table.types[place.line] == t.KEYWORDS["def"]:
        return Advice("expected `:`, found `=`", "a parameter is declared `name: type = value`")
    if opened is not None and place.kind(-1) == t.ID:
        help_ = f"a named argument is written `{place.text(-1)}: value`"
        return Advice("expected `:`, found `=`", help_)
    if place.table.types[place.line] == t.KEYWORDS["var"]:
        return Advice(
            "expected `:` and a type, found `=`", "a variable is declared `var name: type = value`"
        )
    if place.table.types[place.line] == t.ID:
        help_ = "declare a field `name: type = value`, or constrain one by `keep(name == value)`"
        return Advice("there are no assignments in OpenSCENARIO DSL", help_)
    return None


def _misspelt_statement(place: Place) -> Advice | None:
    """`scenaro x:`, `wiat @x`, `a.b() wiht:`."""
    if place.at - 1 == place.line and place.kind(-1) == t.ID:
        follows = place.kind() in t.WORDS or place.kind() == _AT
        token, candidates = place.line, _STARTERS if follows else []
    else:
        follows = place.kind() == t.ID and place.kind(-1) == _RPAREN and place.kind(1) == _COLON
        token, candidates = place.at, ["with"] if follows else []
    word = place.table.text(token)
    meant = did_you_mean(word, candidates, 0.7)
    return Advice(f"unknown word `{word}`", meant, token) if meant else None


def _missing_colon_of_argument(place: Place) -> Advice | None:
    """`f(at start)`."""
    opened = place.open_bracket()
    if place.kind(-1) != t.ID or place.kind() not in t.WORDS or opened is None:
        return None
    name, value = place.text(-1), place.text()
    if value.startswith("::"):
        help_ = f"a qualified name has no blanks: `{name}{value}`"
        return Advice(f"unexpected `{value}`", help_)
    if place.table.types[opened - 1] != t.ID:
        return None
    help_ = f"a named argument is written `{name}: {value}`"
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
    meant = did_you_mean(word, ["serial", "parallel", "one_of", "with"], 0.7)
    if meant:
        return Advice(f"unknown word `{word}`", meant, index)
    if place.kind() == t.NEWLINE and index < end - 1:
        name = place.table.source.text[place.table.starts[place.line] : place.table.ends[end - 1]]
        help_ = f"write `{name} with:`" if len(name) <= 40 and "\n" not in name else None
        return Advice("`with` is missing before the `:` of an invocation", help_)
    return None


def _colon_inheritance(place: Place) -> Advice | None:
    if place.table.types[place.line] not in _TYPES or place.kind(-1) != _COLON:
        return None
    if place.kind() != t.ID:
        return None
    word = place.text()
    help_ = f"a base type is written `inherits {word}:`"
    return Advice(f"expected the end of the line, found `{word}`", help_)


def _declared_parentheses(place: Place) -> Advice | None:
    head = place.table.types[place.line]
    is_named = head in _TYPES or head == t.KEYWORDS["modifier"]
    if not is_named or place.kind() != _LPAREN or place.kind(-1) != t.ID:
        return None
    word = place.table.text(place.line)
    help_ = "its parameters are fields in the body: `name: type`"
    return Advice(f"the name of a declared {word} has no parentheses", help_)


def _other_operators(place: Place) -> Advice | None:
    if place.kind() == _BANG:
        return Advice("unexpected `!`", "a negation is written `not`")
    if place.kind() == _DOUBLE_COLON:
        return Advice("unexpected `::`", "a qualified name has no blanks: `namespace::name`")
    return None


def _colon_after_directive(place: Place) -> Advice | None:
    if place.kind() != _COLON or place.at - 1 != place.line:
        return None
    word = place.table.text(place.line)
    if place.table.types[place.line] not in t.KEYWORD_TYPES:
        return None
    return Advice(f"unexpected `:` after `{word}`", f"write `{word} @event` without a colon")


def _constraint_without_parentheses(place: Place) -> Advice | None:
    if place.at - 1 != place.line or place.table.types[place.line] not in _CONSTRAINTS:
        return None
    word = place.table.text(place.line)
    return Advice(f"missing `(` after `{word}`", f"write `{word}(…)`")


_REMEDIES: tuple[Callable[[Place], Advice | None], ...] = (
    _global_variable,
    _point_without_digits,
    _sampled_parameter,
    _until_behind_a_call,
    _loop,
    _blank_before_unit,
    _range_with_unit,
    _foreign_statement,
    _unbalanced_bracket,
    _assignment,
    _misspelt_composition,
    _misspelt_statement,
    _missing_colon_of_argument,
    _missing_name,
    _colon_inheritance,
    _declared_parentheses,
    _colon_after_directive,
    _constraint_without_parentheses,
    _other_operators,
)
