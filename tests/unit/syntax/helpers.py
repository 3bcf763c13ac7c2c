"""Short ways to parse a text in a test."""

from osc2tx.diagnostics import Diagnostic, DiagnosticSink, SourceFile
from osc2tx.syntax import ast, parse
from osc2tx.syntax.token_source import TokenSource
from osc2tx.syntax.tokens import SPELLING, TokenTable

LAYOUT = {-1: "EOF", 1: "NEWLINE", 2: "INDENT", 3: "DEDENT"}


def parsed(text: str, **options: frozenset[str]) -> tuple[ast.File, tuple[Diagnostic, ...]]:
    sink = DiagnosticSink()
    file = parse(SourceFile("test.osc", text), sink, **options)
    return file, sink.sorted()


def clean(text: str) -> ast.File:
    file, diagnostics = parsed(text)
    assert diagnostics == ()
    return file


def reports(text: str) -> list[tuple[int, str]]:
    """Line and code of each diagnostic."""
    return [(d.primary.line if d.primary else 0, d.code) for d in parsed(text)[1]]


def scanned(text: str) -> tuple[TokenTable, tuple[Diagnostic, ...]]:
    sink = DiagnosticSink()
    table = TokenSource(SourceFile("test.osc", text), sink).scan()
    return table, sink.sorted()


def shown(text: str) -> list[str]:
    """Tokens as text: layout by name, keywords in capitals, the rest as written."""
    table, _ = scanned(text)
    result = []
    for index, kind in enumerate(table.types):
        if kind in LAYOUT:
            result.append(LAYOUT[kind])
        elif kind in SPELLING and SPELLING[kind].isidentifier():
            result.append(SPELLING[kind].upper())
        else:
            result.append(table.text(index))
    return result


def expression(text: str) -> ast.Expression:
    file = clean(f"struct s:\n    keep({text})\n")
    (struct,) = file.statements
    assert isinstance(struct, ast.StructDeclaration)
    (keep,) = struct.members
    assert isinstance(keep, ast.KeepConstraint)
    return keep.expression


def infix(node: ast.Expression) -> str:
    """An expression with all its parentheses."""
    match node:
        case ast.Binary(operator=operator, left=left, right=right):
            return f"({infix(left)} {operator.value} {infix(right)})"
        case ast.Unary(operator=operator, operand=operand):
            return f"({operator.value} {infix(operand)})"
        case ast.Conditional(condition=c, when_true=a, when_false=b):
            return f"({infix(c)} ? {infix(a)} : {infix(b)})"
    return node.span.text
