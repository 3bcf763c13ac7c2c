"""Front end: from source text to the abstract syntax tree.

Input: a `SourceFile`. Output: an `ast.File` and diagnostics OSC1xx in the sink.

Stages, in order:

1. `read_source` (`source_reader`): bytes to text.
2. `TokenSource` (`token_source`, with `patterns`, `keywords`, `lexical_errors`):
   text to a `TokenTable` (`tokens`): tokens with INDENT, DEDENT and NEWLINE, keywords decided by
   place, comments apart.
3. `parse_tokens` (`parser`, `parser_runtime`, `syntax_errors`, `common_mistakes`): tokens to the
   tree of the generated parser (`_antlr`, made from `grammar/OpenSCENARIO2.g4`).
4. `ASTTransformer` (`ast_transformer`, `ast_builder`, `literals`): tree to AST (`ast`).

`dump_ast` (`dump`) prints an AST as text; `packed_ast` turns one into plain data and back.

Invariants: no input raises or recurses without bound; one mistake gives one message and costs one
statement; every stage is linear in the size of the text; only this package imports antlr4, for
messages about syntax errors, and no object of antlr4 leaves it.
"""

from collections.abc import Collection

from osc2tx.diagnostics import DiagnosticSink, SourceFile, Span
from osc2tx.support.recursion import room_for_trees
from osc2tx.syntax import ast
from osc2tx.syntax.dump import dump_ast
from osc2tx.syntax.source_reader import read_source

__all__ = ["dump_ast", "parse", "read_source"]


def parse(
    source: SourceFile,
    sink: DiagnosticSink,
    *,
    allow: Collection[str] = frozenset(),
    with_comments: bool = True,
) -> ast.File:
    """Parse a source text; what is wrong with it goes to the sink.

    Args:
        source: The text.
        sink: Where diagnostics go.
        allow: Codes of deviations that are fine in the dialect at hand and not to be reported:
            OSC111 (block comments), OSC112 (empty blocks), OSC113 (`do:`), OSC114 (empty
            parentheses), OSC626 (lines that begin between two blocks). `use` as a statement is
            left to the next stage to judge.
        with_comments: Whether nodes have their comments.

    Returns:
        The AST of all that could be understood.
    """
    # Loaded late: the generated parser is only needed when there is something to parse.
    from osc2tx.syntax.ast_transformer import ASTTransformer
    from osc2tx.syntax.parser import parse_tokens
    from osc2tx.syntax.token_source import TokenSource

    with room_for_trees():
        table = TokenSource(source, sink, allow=allow).scan()
        if not with_comments:
            table.comments.clear()
        try:
            tree = parse_tokens(table, sink)
            return ASTTransformer(table, sink, allow).transform(tree)
        except RecursionError:
            span = Span(source, 0, 0)
            sink.report("OSC105", span, "the text nests too deeply for the stack of this process")
            return ast.File(span=span, imports=(), statements=())
