"""The AST of a file from its parser tree: dispatch and the file itself."""

from __future__ import annotations

from collections.abc import Collection
from typing import Any

from osc2tx.diagnostics import DiagnosticSink, Span
from osc2tx.diagnostics.fixes import Edit, Remedy, rewrite
from osc2tx.diagnostics.source import LINE_END
from osc2tx.syntax import ast
from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder import behaviors, declarations, enums, members, names
from osc2tx.syntax.ast_builder.base import Builder, Tree
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import (
    build_block,
    build_statement,
    has_lost_header,
    report_indentation,
)
from osc2tx.syntax.tokens import TokenTable

BUILDERS = {
    **declarations.BUILDERS,
    **enums.BUILDERS,
    **members.BUILDERS,
    **behaviors.BUILDERS,
    **names.BUILDERS,
}
"""The function that builds each kind of statement, by the class of its context."""


class ASTTransformer:
    """Turns the tree of the rule `sourceFile` into an `ast.File`."""

    def __init__(self, table: TokenTable, sink: DiagnosticSink, allow: Collection[str]) -> None:
        """Build from `table`; the codes in `allow` are not reported."""
        self._builder = Builder(table, sink, allow, BUILDERS)

    def transform(self, tree: Tree) -> ast.File:
        """Return the AST of a whole file; the tree is used up, so that not all of both is there."""
        imports: list[ast.Import] = []
        statements: list[Any] = []
        pending = tree.children[::-1]
        tree.children.clear()
        while pending:
            child = pending.pop()
            if child.__class__ is Grammar.BlockContext:
                found = self._block_without_header(child)
            elif child.__class__ is Grammar.StatementContext:
                node = build_statement(self._builder, child, Place.FILE)
                found = () if node is None else (node,)
            else:
                continue
            for node in found:
                if not isinstance(node, ast.Import):
                    statements.append(node)
                    continue
                if statements:
                    self._report_late_import(node)
                imports.append(node)
        return ast.File(
            span=Span(self._builder.source, 0, len(self._builder.code)),
            imports=tuple(imports),
            statements=tuple(statements),
        )

    def _block_without_header(self, block: Tree) -> tuple[Any, ...]:
        """Build an indented start of the file, or a block under a line that was not readable."""
        report_indentation(self._builder, block)
        return build_block(
            self._builder,
            block,
            Place.NOWHERE if has_lost_header(self._builder, block) else Place.FILE,
        )

    def _report_late_import(self, node: ast.Import) -> None:
        message = "imports precede all other statements of a file"
        self._builder.report("OSC108", node.span, message, _moved_to_top(node.span))


def _moved_to_top(line: Span) -> Remedy:
    """Return the remedy that moves a statement of one line to the top of its file."""
    source = line.source
    end = LINE_END.match(source.text, line.end)
    whole = Span(source, line.start, line.end if end is None else end.end())
    top = Span(source, 0, 0)
    return rewrite([Edit(top, f"{line.text}\n"), Edit(whole, "")], "move it to the top of the file")
