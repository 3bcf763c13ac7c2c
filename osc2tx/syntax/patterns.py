"""The regular expressions of the token source (§7.2.1.5).

Repeated content is matched by possessive, unrolled loops: no pattern keeps state per character,
so a string of a megabyte costs no more than its length.
"""

from __future__ import annotations

import re
from unicodedata import category

_START = frozenset({"Ll", "Lm", "Lo", "Lt", "Lu", "Nl"})
_CONTINUE = _START | {"Mc", "Mn", "Nd", "Pc"}


def identifier_end(text: str, start: int) -> int:
    """Return the offset behind the identifier at `start`; `start` itself if there is none."""
    if start >= len(text) or not (text[start] == "_" or category(text[start]) in _START):
        return start
    end = start + 1
    while end < len(text) and category(text[end]) in _CONTINUE:
        end += 1
    return end


_NAME = r"(?:[^\W\d]\w*+|\|[^|\r\n]++\|)"
_DECIMAL_FLOAT = r"[0-9]*+\.[0-9]++(?:[eE][+-]?[0-9]++)?|[0-9]++[eE][+-]?[0-9]++"
_SHORT = r"{q}(?!{q}{q})[^{q}\\\r\n]*+(?:\\(?:\r\n|.)[^{q}\\\r\n]*+)*+{q}"
_LONG = r"{q}{q}{q}[^{q}\\]*+(?:(?:\\.|{q}(?!{q}{q}))[^{q}\\]*+)*+{q}{q}{q}"
_STRING = "|".join(form.format(q=quote) for form in (_LONG, _SHORT) for quote in "\"'")

# The groups of `TOKEN`, in order.
(
    WORD,
    NAME,
    STAR,
    PUNCTUATION,
    NEWLINE,
    PHYSICAL,
    HEXADECIMAL,
    FLOAT,
    INTEGER,
    STRING,
    COMMENT,
    FOREIGN_COMMENT,
    JOIN,
    QUOTE,
    UNKNOWN,
) = range(1, 16)

TOKEN = re.compile(
    rf"""
    [ \t\f]*+
    (?: ([^\W\d]\w*+)(?!::[\w|*])
      | ({_NAME}?+::{_NAME} | \|[^|\r\n]++\|)
      | ({_NAME}?+::\*)
      | (->|=>|==|!=|<=|>=|\.\.|:(?=::\w)|::|[](),:=@?<>+%*![-] | \.(?![0-9]) | -(?!>) | /(?![*/]))
      | (\r\n|\r|\n)
      | ((?>0x[0-9a-fA-F]++|{_DECIMAL_FLOAT}|[0-9]++)(?:::|{_NAME}::)?{_NAME})
      | (0x[0-9a-fA-F]++)
      | ({_DECIMAL_FLOAT})
      | ([0-9]++)
      | ({_STRING})
      | (\#[^\r\n]*+)
      | (/\*|//)
      | (\\(?:\r\n|\r|\n))
      | (["'])
      | ([^ \t\f])
    )""",
    re.VERBOSE | re.DOTALL,
)

# The text before the first token of a line: blanks, then a comment or nothing up to the end.
LINE_HEAD = re.compile(r"([ \t\f]*+)(?:(\#[^\r\n]*+)?(\r\n|\r|\n|\Z))?")
LINE_REST = re.compile(r"[^\r\n]*+")
NEXT_LINE = re.compile(r"(?:\r\n|\r|\n)([^\r\n]*+)")
# Where scanning continues after nesting that is too deep: a line that is not indented.
UNINDENTED_LINE = re.compile(r"[\r\n](?=[^\s#)\]])")
# Mistyped operators as a whole; sequences of characters without meaning.
UNKNOWN_RUN = re.compile(r"[&|]++|[;{}]|([^\w\s\"'#])\1*+")
