"""Front end: from source text to the abstract syntax tree.

Input: a `SourceFile`. Output: an `ast.File` and diagnostics OSC1xx in the sink.

Stages, in order:

1. `read_source`: bytes to text.
2. `TokenSource` (`token_source`, with `patterns`, `keywords`, `lexical_errors`):
   text to a `TokenTable` (`tokens`): tokens with INDENT, DEDENT and NEWLINE, keywords decided by
   place, comments apart.
3. `parse_tokens` (`parser`, `parser_runtime`, `syntax_errors`, `common_mistakes`): tokens to the
   tree of the generated parser (`_antlr`, made from `grammar/OpenSCENARIO2.g4`).
4. `ASTTransformer` (`ast_transformer`, `ast_builder`, `literals`): tree to AST (`ast`).

`dump` prints an AST as text; `packed_ast` turns one into plain data and back.

Invariants: no input raises or recurses without bound; one mistake gives one message and costs one
statement; every stage is linear in the size of the text; only this package imports antlr4, for
messages about syntax errors, and no object of antlr4 leaves it.
"""

from collections.abc import Collection, Iterator
from pathlib import Path

from osc2tx.diagnostics import DiagnosticSink, SourceFile, Span
from osc2tx.support.recursion import allowing_deep_trees
from osc2tx.syntax import ast

__all__ = ["parse", "read_source"]

_RESOLVE = "keep one of the two versions, or both, and remove the three lines with markers"


def parse(
    source: SourceFile,
    sink: DiagnosticSink,
    *,
    allow: Collection[str] = frozenset(),
    with_comments: bool = True,
) -> ast.File:
    """Parse a source text; report its errors to the sink.

    Args:
        source: The text.
        sink: Where diagnostics go.
        allow: Codes of deviations that the dialect accepts and that are not reported: OSC111 (block
            comments), OSC112 (empty blocks), OSC113 (`do:`), OSC114 (empty parentheses), OSC626
            (lines that begin between two blocks). `use` as a statement is checked by the next
            stage.
        with_comments: Whether nodes have their comments.

    Returns:
        The AST of the valid parts.
    """
    conflicts = list(merge_conflicts(source))
    for span in conflicts:
        sink.report("OSC116", span, "a merge conflict is not resolved here", help=_RESOLVE)
    if conflicts:
        return ast.File(span=Span(source, 0, 0), imports=(), statements=())
    # Loaded late: the generated parser is only needed when there is something to parse.
    from osc2tx.syntax.ast_transformer import ASTTransformer
    from osc2tx.syntax.parser import parse_tokens
    from osc2tx.syntax.token_source import TokenSource

    with allowing_deep_trees():
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


def read_source(path: Path, name: str, sink: DiagnosticSink) -> SourceFile | None:
    """Read a file; report and return `None` when it is no readable UTF-8 text.

    Args:
        path: The file.
        name: How diagnostics call it.
        sink: Where diagnostics go.
    """
    try:
        if path.exists() and not path.is_file() and not path.is_dir():
            raise ValueError("it is not a regular file")  # a pipe would be waited for
        data = path.read_bytes()
    except (OSError, ValueError) as error:
        reason = "it is a directory" if path.is_dir() else _reason(error)
        sink.report("OSC101", None, f"cannot read `{name}`: {reason}")
        return None
    position = data.find(b"\0")
    if position >= 0:
        message = f"cannot read `{name}`: NUL byte at {_place(data, position)}"
        sink.report("OSC101", None, message, help="is it a text file in UTF-8?")
        return None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        offset = error.start + (3 if data.startswith(b"\xef\xbb\xbf") else 0)
        message = f"cannot read `{name}`: no UTF-8 at {_place(data, offset)}"
        sink.report("OSC101", None, message, help="save the file in UTF-8")
        return None
    return SourceFile(name, text, path)


def _place(data: bytes, offset: int) -> str:
    """Return the position of a byte, as editors count it."""
    start = data.rfind(b"\n", 0, offset) + 1
    before = data[start:offset].decode("utf-8-sig", "replace")
    line = data.count(b"\n", 0, offset) + 1
    return f"line {line}, column {len(before) + 1}"


def _reason(error: OSError | ValueError) -> str:
    reason = error.strerror if isinstance(error, OSError) else None
    return (reason or str(error)).lower()


_MARKERS = ("<<<<<<< ", "=======", ">>>>>>> ")


def merge_conflicts(source: SourceFile) -> Iterator[Span]:
    """Yield the first line of each conflict that has all three markers, in this order."""
    if f"\n{_MARKERS[0]}" not in f"\n{source.text}":
        return
    position, found = 0, None
    seen = 0  # of the markers
    for line in source.text.splitlines(keepends=True):
        if line.startswith(_MARKERS[0]):
            found, seen = Span(source, position, position + len(line.rstrip())), 1
        elif found is not None and line.startswith(_MARKERS[seen]):
            seen += 1
            if seen == len(_MARKERS):
                yield found
                found = None
        position += len(line)
