"""Members of types: events, variables, methods, constraints, coverage (§7.3.5 - §7.3.12)."""

from __future__ import annotations

from collections.abc import Mapping

from osc2tx.diagnostics import Span
from osc2tx.diagnostics.fixes import Edit, leave_out, rewrite
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Builder, StatementBuilder, Tree
from osc2tx.syntax.ast_builder.events import build_event_specification, build_parameters
from osc2tx.syntax.ast_builder.expressions import build_arguments, build_expression
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import Head, build_body, build_statement, refuse_block

_ASSIGN, _COLON, _LPAREN = (t.PUNCTUATION[text] for text in ["=", ":", "("])
_DEFAULT, _HARD, _ONLY, _EXPRESSION, _EXTERNAL, _COVER = (
    t.KEYWORDS[word] for word in ["default", "hard", "only", "expression", "external", "cover"]
)


def _event(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    parameters: tuple[ast.ParameterSpecification, ...] = ()
    specification = None
    children = tree.children
    for child in children:
        if child.__class__ is Grammar.ParametersContext:
            parameters = build_parameters(b, child)
        elif child.__class__ is Grammar.EventSpecificationContext:
            specification = build_event_specification(b, child)
    if b.type_at(children[2]) == _LPAREN and not parameters:
        report_empty_parentheses(b, b.span(children[2], children[3]))
    refuse_block(b, tree)
    return ast.EventDeclaration(
        **head.fields(),
        name=b.name(children[1]),
        parameters=parameters,
        specification=specification,
    )


def report_empty_parentheses(b: Builder, span: Span) -> None:
    """Report `()` where the grammar of the standard has none."""
    message = "empty parentheses are not part of the language here"
    b.report("OSC114", span, message, leave_out(span, "leave them out"))


def _variable(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    children = tree.children
    kinds = [b.type_at(child) for child in children]
    colon = kinds.index(_COLON)
    default: ast.Expression | ast.SampleExpression | None = None
    if _ASSIGN in kinds:
        value = children[kinds.index(_ASSIGN) + 1]
        is_sample = value.__class__ is Grammar.SampleExpressionContext
        default = _sample(b, value) if is_sample else build_expression(b, value)
    node = ast.VariableDeclaration(
        **head.fields(),
        names=tuple(b.name(child) for child in children[1:colon:2]),
        type=b.type_name(children[colon + 1]),
        default=default,
    )
    refuse_with(b, children[-1], "a variable")
    return node


def _sample(b: Builder, tree: Tree) -> ast.SampleExpression:
    children = tree.children
    return ast.SampleExpression(
        span=b.tree_span(tree),
        expression=build_expression(b, children[2]),
        event=build_event_specification(b, children[4]),
        default=build_expression(b, children[6]) if len(children) > 7 else None,
    )


def _method(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    parameters: tuple[ast.ParameterSpecification, ...] = ()
    result: ast.TypeName | None = None
    for child in tree.children:
        if child.__class__ is Grammar.ParametersContext:
            parameters = build_parameters(b, child)
        elif child.__class__ is Grammar.TypeNameContext:
            result = b.type_name(child)
    node = ast.MethodDeclaration(
        **head.fields(),
        name=b.name(tree.children[1]),
        parameters=parameters,
        result=result,
        is_only=bool(b.tokens(tree, _ONLY)),
        body=_method_body(b, tree),
    )
    refuse_block(b, tree)
    return node


def _method_body(
    b: Builder, tree: Tree
) -> ast.ExpressionBody | ast.ExternalBody | ast.UndefinedBody:
    start = max(c for c in _tokens_before_end(b, tree) if b.types[c] in t.KEYWORD_TYPES)
    span = b.span(start, b.last_token(tree))
    kind = b.types[start]
    if kind == _EXPRESSION:
        body = next(c for c in tree.children if c.__class__ is Grammar.ExpressionContext)
        return ast.ExpressionBody(span=span, expression=build_expression(b, body))
    if kind != _EXTERNAL:
        return ast.UndefinedBody(span=span)
    path: tuple[str, ...] = ()
    arguments: tuple[ast.Argument, ...] = ()
    for child in tree.children:
        if child.__class__ is Grammar.DottedNameContext:
            path = b.dotted(child, "the name of an external method")
        elif child.__class__ is Grammar.ArgumentsContext:
            arguments = build_arguments(b, child)
    return ast.ExternalBody(span=span, path=path, arguments=arguments)


def _tokens_before_end(b: Builder, tree: Tree) -> list[int]:
    return [child for child in tree.children if isinstance(child, int)]


def _keep(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    children = tree.children
    strength = ast.KeepStrength.HARD
    position = 2
    if b.type_at(children[2]) in (_DEFAULT, _HARD):
        position = 3
        if b.types[children[2]] == _DEFAULT:
            strength = ast.KeepStrength.DEFAULT
    expression = build_expression(b, children[position])
    refuse_block(b, tree)
    return ast.KeepConstraint(**head.fields(), strength=strength, expression=expression)


def _remove_default(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    parameter = build_expression(b, tree.children[2])
    if not isinstance(parameter, (ast.NameExpression, ast.MemberAccess, ast.ItExpression)):
        b.report("OSC100", parameter.span, "`remove_default` takes a parameter")
    refuse_block(b, tree)
    return ast.RemoveDefault(**head.fields(), parameter=parameter)


def _coverage(b: Builder, tree: Tree, head: Head, place: Place) -> ast.Statement:
    keyword = tree.children[0]
    arguments: tuple[ast.Argument, ...] = ()
    if tree.children[2].__class__ is Grammar.ArgumentsContext:
        arguments = build_arguments(b, tree.children[2])
    else:
        message = f"`{b.text_of(keyword)}` needs the name of an item or `expression:`"
        b.report("OSC100", head.span, message)
    refuse_block(b, tree)
    return ast.CoverageDeclaration(**head.fields(), kind=b.text_of(keyword), arguments=arguments)


# --- `with` ---------------------------------------------------------------------------------


def build_ending(b: Builder, tree: Tree, place: Place) -> tuple[ast.Statement, ...]:
    """Build the `with` block at the end of a statement, if there is one."""
    children = tree.children
    first = children[0]
    if first.__class__ is Grammar.WithBlockContext:
        return build_with_block(b, first, place)
    refuse_block(b, tree)
    last = children[-1]
    if last.__class__ is not Grammar.WithBlockContext:
        return ()
    message = "`with:` follows the invocation on the same line"
    help_ = "`with:` of a composition follows its members, in the column of the composition"
    b.report("OSC100", b.span(last.start, last.start), message, help_)
    return build_with_block(b, last, place)


def build_with_block(b: Builder, tree: Tree, place: Place) -> tuple[ast.Statement, ...]:
    """Build the members of `with:`."""
    inner = tree.children[-1]
    if inner.__class__ is not Grammar.StatementContext:
        if inner.__class__ is Grammar.BlockContext:
            b.comments.hand_on(tree.start, inner.start + 1)
        return build_body(b, tree, place, "`with`")
    first = inner.start
    message = "the modifiers of `with:` are on lines of their own"
    if b.table.text(first) == "[":
        b.report("OSC100", b.span(first, first), message, "write one modifier in each line")
        return ()
    colon = "" if b.table.text(first - 1) == ":" else ":"
    between = Span(b.table.source, b.table.ends[first - 1], b.table.starts[first])
    line = f"{colon}\n{b.table.below(between.start)}"
    help_ = rewrite([Edit(between, line)], "begin a new, indented line")
    b.report("OSC100", b.span(first, first), message, help_)
    node = build_statement(b, inner, place)
    return () if node is None else (node,)


def refuse_with(b: Builder, ending: Tree, what: str) -> None:
    """Build the end of a statement that cannot have a `with` block."""
    place = Place.WITH
    if ending.children[0].__class__ is Grammar.WithBlockContext:
        first = ending.start
        b.report("OSC108", b.span(first, first), f"{what} has no `with` block")
        place = Place.NOWHERE
    build_ending(b, ending, place)


BUILDERS: Mapping[type, StatementBuilder] = {
    Grammar.EventDeclarationContext: _event,
    Grammar.VariableDeclarationContext: _variable,
    Grammar.MethodDeclarationContext: _method,
    Grammar.KeepConstraintContext: _keep,
    Grammar.RemoveDefaultContext: _remove_default,
    Grammar.CoverageDeclarationContext: _coverage,
}
