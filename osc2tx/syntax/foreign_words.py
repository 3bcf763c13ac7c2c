"""Words that begin statements in other languages and tools, and what to write instead."""

from __future__ import annotations

from collections.abc import Mapping

_CHOICE = "use `wait`, `one_of` or `on … if`, or a conditional expression `a ? b : c`"
_LOOP = "write the members as often as they shall happen, or wait for `every(…)` in an `on`"
_TYPE = "types are declared with `struct`, `actor` or `enum`"
_METHOD = "a method is declared in a type, `def name(…) -> type is expression …`"

STATEMENTS: Mapping[str, str] = {
    **dict.fromkeys(("if", "else", "elif", "switch", "case", "match"), _CHOICE),
    **dict.fromkeys(("for", "while", "repeat", "loop"), _LOOP),
    **dict.fromkeys(("class", "type"), _TYPE),
    **dict.fromkeys(("function", "func", "fn"), _METHOD),
    "from": "write `import` and the file in quotes, or the dotted name of a module",
    "return": "the value of a method stands in its head: `is expression …`",
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
    "for": "how long is an argument: `(duration: 3s)`",
    "after": "let that time pass before it: `wait elapsed(3s)`",
    "when": "wait for it on a line before: `wait …`",
    "if": "wait for it on a line before: `wait …`",
    "while": "end the line with `with:`, and write `until not (…)` indented below",
    "then": "write what follows on a line of its own, below `serial:`",
}
