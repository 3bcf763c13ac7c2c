"""Base of the AST builders: tokens, spans, names, reports."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax.literals import split_name
from osc2tx.syntax.tokens import TokenTable

Tree = Any  # a parser context; `children` holds contexts and token indexes

# Not reported on a line with a lexical mistake, which is most likely their cause.
_FOLLOW_UPS = frozenset({"OSC100", "OSC108", "OSC112"})

_LAYOUT = frozenset({t.NEWLINE, t.INDENT, t.DEDENT})


class BuilderBase:
    """Access to the tokens of one file."""

    def __init__(self, table: TokenTable, sink: DiagnosticSink, allow: Collection[str]) -> None:
        """Build from `table`; the codes in `allow` are not reported."""
        self._table = table
        self._types = table.types
        self._starts = table.starts
        self._ends = table.ends
        self._source = table.source
        self._code = table.source.text
        self._sink = sink
        self._allow = allow
        self._damaged = sorted(table.damaged)
        self._damaged_lines = {table.source.position(start)[0] for start in table.damaged}

    def _report(self, code: str, span: Span, message: str, help_: str | None = None) -> None:
        if code in self._allow:
            return
        if code in _FOLLOW_UPS and self._damaged_lines and span.line in self._damaged_lines:
            return
        self._sink.report(code, span, message, help=help_)

    def _text(self, token: int) -> str:
        return self._code[self._starts[token] : self._ends[token]]

    def _span(self, first: int, last: int) -> Span:
        return Span(self._source, self._starts[first], self._ends[last])

    def _tree_span(self, tree: Tree) -> Span:
        return Span(self._source, self._starts[tree.start], self._ends[self._last(tree)])

    def _last(self, tree: Tree) -> int:
        """Index of the last token of a tree that is not layout."""
        last: int = tree.stop
        while self._types[last] in _LAYOUT and last > tree.start:
            last -= 1
        return last

    def _name(self, token: int) -> ast.Name:
        start, end = self._starts[token], self._ends[token]
        text = self._code[start:end]
        span = Span(self._source, start, end)
        if text.isidentifier():
            return ast.Name(span=span, text=text)
        namespace, name = split_name(text)
        return ast.Name(span=span, text=name, namespace=namespace)

    def _plain_name(self, token: int, what: str) -> str:
        """Return the text of a name that may not be qualified."""
        name = self._name(token)
        if name.namespace is not None:
            message = f"{what} is a plain name, without a namespace before it"
            self._report("OSC100", name.span, message)
        return name.text

    def _dotted(self, tree: Tree, what: str) -> tuple[str, ...]:
        return tuple(self._plain_name(i, what) for i in self._tokens(tree, t.ID))

    def _behavior_name(self, tree: Tree) -> ast.BehaviorName:
        children = tree.children
        first = self._name(children[0])
        if len(children) == 1:
            return ast.BehaviorName(span=first.span, actor=None, name=first)
        last = self._name(children[2])
        return ast.BehaviorName(span=first.span.to(last.span), actor=first, name=last)

    def _type_name(self, tree: Tree) -> ast.TypeName:
        return self._typed(tree.children)

    def _typed(self, children: list[Any]) -> ast.TypeName:
        """Build a type from `list of`, `range of` in any number and a name."""
        name = self._behavior_name(children[-1])
        return self._wrapped_type(children[:-1], ast.NamedType(span=name.span, name=name))

    def _wrapped_type(self, words: list[int], named: ast.NamedType) -> ast.TypeName:
        """Put the prefixes `list of` and `range of` around a type."""
        if not words:
            return named
        prefixes = [self._text(token) for token in words[::2]]
        span = Span(self._source, self._starts[words[0]], named.span.end)
        if prefixes == ["list"]:
            return ast.ListType(span=span, element=named)
        if prefixes == ["range"]:
            return ast.RangeType(span=span, element=named)
        inner = Span(self._source, self._starts[words[2]], named.span.end)
        if prefixes != ["list", "range"]:
            message = "a list holds no lists, and a range has a numeric type"
            self._report("OSC100", span, message)
        return ast.ListType(span=span, element=ast.RangeType(span=inner, element=named))

    def _tokens(self, tree: Tree, kind: int) -> list[int]:
        """Return the direct token children of one type."""
        types = self._types
        return [c for c in tree.children if c.__class__ is int and types[c] == kind]
