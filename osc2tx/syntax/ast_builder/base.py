"""Base of the AST builders: tokens, spans, names, reports."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Any

from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.diagnostics.fixes import Help
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax.comments import CommentTable
from osc2tx.syntax.literals import split_name
from osc2tx.syntax.tokens import TokenTable

Tree = Any  # a parser context; `children` holds contexts and token indexes

# Not reported on a line with a lexical mistake, which is most likely their cause.
_FOLLOW_UPS = frozenset({"OSC100", "OSC108", "OSC112"})

_LAYOUT = frozenset({t.NEWLINE, t.INDENT, t.DEDENT})


StatementBuilder = Callable[..., Any]
"""Builds a statement: takes the builder, the context, the head of the statement and its place.

Those of statements that may have a label also take `label`.
"""


class Builder:
    """Access to the tokens of one file, and the functions that build its statements."""

    def __init__(
        self,
        table: TokenTable,
        sink: DiagnosticSink,
        allow: Collection[str],
        builders: Mapping[type, StatementBuilder],
    ) -> None:
        """Build from the tokens of a file.

        Args:
            table: The tokens.
            sink: Receives the diagnostics.
            allow: Codes that are not reported.
            builders: The function that builds a statement, by the class of its context.
        """
        self.builders = builders
        self.comments = CommentTable(table)
        self.table = table
        self.types = table.types
        self.starts = table.starts
        self.ends = table.ends
        self.source = table.source
        self.code = table.source.text
        self.sink = sink
        self.allow = allow
        self.damaged = sorted(table.damaged)
        self.damaged_lines = {table.source.position(start)[0] for start in table.damaged}

    def report(self, code: str, span: Span, message: str, help_: Help = None) -> None:
        """Report a mistake, unless it is allowed or follows from a lexical one."""
        if code in self.allow:
            return
        if code in _FOLLOW_UPS and self.damaged_lines and span.line in self.damaged_lines:
            return
        self.sink.report(code, span, message, help=help_)

    def type_at(self, child: object) -> int:
        """Return the type of a child that is a token; of a context, nothing that a token has."""
        return self.types[child] if isinstance(child, int) else t.EOF

    def text_of(self, token: int) -> str:
        """Return the text of a token."""
        return self.code[self.starts[token] : self.ends[token]]

    def span(self, first: int, last: int) -> Span:
        """Return the span from one token up to another."""
        return Span(self.source, self.starts[first], self.ends[last])

    def tree_span(self, tree: Tree) -> Span:
        """Return the span of a tree without the layout at its end."""
        return Span(self.source, self.starts[tree.start], self.ends[self.last_token(tree)])

    def last_token(self, tree: Tree) -> int:
        """Index of the last token of a tree that is not layout."""
        last: int = tree.stop
        while self.types[last] in _LAYOUT and last > tree.start:
            last -= 1
        return last

    def name(self, token: int) -> ast.Name:
        """Return the name that a token is."""
        start, end = self.starts[token], self.ends[token]
        text = self.code[start:end]
        span = Span(self.source, start, end)
        if text.isidentifier():
            return ast.Name(span=span, text=text)
        namespace, name = split_name(text)
        return ast.Name(span=span, text=name, namespace=namespace)

    def plain_name(self, token: int, what: str) -> str:
        """Return the text of a name that may not be qualified."""
        name = self.name(token)
        if name.namespace is not None:
            message = f"{what} is a plain name, without a namespace before it"
            self.report("OSC100", name.span, message)
        return name.text

    def dotted(self, tree: Tree, what: str) -> tuple[str, ...]:
        """Return the plain names of `a.b.c`."""
        return tuple(self.plain_name(i, what) for i in self.tokens(tree, t.ID))

    def behavior_name(self, tree: Tree) -> ast.BehaviorName:
        """Return `name` or `actor.name`."""
        children = tree.children
        first = self.name(children[0])
        if len(children) == 1:
            return ast.BehaviorName(span=first.span, actor=None, name=first)
        last = self.name(children[2])
        return ast.BehaviorName(span=first.span.to(last.span), actor=first, name=last)

    def type_name(self, tree: Tree) -> ast.TypeName:
        """Return the type that a tree names."""
        return self.typed(tree.children)

    def typed(self, children: list[Any]) -> ast.TypeName:
        """Build a type from `list of`, `range of` in any number and a name."""
        name = self.behavior_name(children[-1])
        return self._wrapped_type(children[:-1], ast.NamedType(span=name.span, name=name))

    def _wrapped_type(self, words: list[int], named: ast.NamedType) -> ast.TypeName:
        """Apply the prefixes `list of` and `range of` to a type."""
        if not words:
            return named
        prefixes = [self.text_of(token) for token in words[::2]]
        span = Span(self.source, self.starts[words[0]], named.span.end)
        if prefixes == ["list"]:
            return ast.ListType(span=span, element=named)
        if prefixes == ["range"]:
            return ast.RangeType(span=span, element=named)
        inner = Span(self.source, self.starts[words[2]], named.span.end)
        if prefixes != ["list", "range"]:
            message = "a list holds no lists, and a range has a numeric type"
            self.report("OSC100", span, message)
        return ast.ListType(span=span, element=ast.RangeType(span=inner, element=named))

    def tokens(self, tree: Tree, kind: int) -> list[int]:
        """Return the direct token children of one type."""
        types = self.types
        return [c for c in tree.children if c.__class__ is int and types[c] == kind]
