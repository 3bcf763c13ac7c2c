"""Members of types: events, variables, methods, constraints, coverage (§7.3.5 - §7.3.12)."""

from __future__ import annotations

from osc2tx.diagnostics import Span
from osc2tx.syntax import ast
from osc2tx.syntax import tokens as t
from osc2tx.syntax._antlr.OpenSCENARIO2 import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Tree
from osc2tx.syntax.ast_builder.events import EventBuilder
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import Head

_ASSIGN, _COLON, _LPAREN = (t.PUNCTUATION[text] for text in ["=", ":", "("])
_DEFAULT, _HARD, _ONLY, _EXPRESSION, _EXTERNAL, _COVER = (
    t.KEYWORDS[word] for word in ["default", "hard", "only", "expression", "external", "cover"]
)


class MemberBuilder(EventBuilder):
    """Builds the members that begin with a keyword."""

    def _event(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        parameters: tuple[ast.ParameterSpecification, ...] = ()
        specification = None
        children = tree.children
        for child in children:
            if child.__class__ is Grammar.ParametersContext:
                parameters = self._parameters(child)
            elif child.__class__ is Grammar.EventSpecificationContext:
                specification = self._event_specification(child)
        if self._types_of(children[2]) == _LPAREN and not parameters:
            self._report_empty_parentheses(self._span(children[2], children[3]))
        self._refuse_block(tree)
        return ast.EventDeclaration(
            **head.fields(),
            name=self._name(children[1]),
            parameters=parameters,
            specification=specification,
        )

    def _report_empty_parentheses(self, span: Span) -> None:
        message = "empty parentheses are not part of the language here"
        self._report("OSC114", span, message, "leave them out")

    def _variable(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        children = tree.children
        kinds = [self._types_of(child) for child in children]
        colon = kinds.index(_COLON)
        default: ast.Expression | ast.SampleExpression | None = None
        if _ASSIGN in kinds:
            value = children[kinds.index(_ASSIGN) + 1]
            is_sample = value.__class__ is Grammar.SampleExpressionContext
            default = self._sample(value) if is_sample else self._expression(value)
        node = ast.VariableDeclaration(
            **head.fields(),
            names=tuple(self._name(child) for child in children[1:colon:2]),
            type=self._type_name(children[colon + 1]),
            default=default,
        )
        self._refuse_with(children[-1], "a variable")
        return node

    def _sample(self, tree: Tree) -> ast.SampleExpression:
        children = tree.children
        return ast.SampleExpression(
            span=self._tree_span(tree),
            expression=self._expression(children[2]),
            event=self._event_specification(children[4]),
            default=self._expression(children[6]) if len(children) > 7 else None,
        )

    def _method(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        parameters: tuple[ast.ParameterSpecification, ...] = ()
        result: ast.TypeName | None = None
        for child in tree.children:
            if child.__class__ is Grammar.ParametersContext:
                parameters = self._parameters(child)
            elif child.__class__ is Grammar.TypeNameContext:
                result = self._type_name(child)
        node = ast.MethodDeclaration(
            **head.fields(),
            name=self._name(tree.children[1]),
            parameters=parameters,
            result=result,
            is_only=bool(self._tokens(tree, _ONLY)),
            body=self._method_body(tree),
        )
        self._refuse_block(tree)
        return node

    def _method_body(self, tree: Tree) -> ast.ExpressionBody | ast.ExternalBody | ast.UndefinedBody:
        start = max(c for c in self._tokens_before_end(tree) if self._types[c] in t.KEYWORD_TYPES)
        span = self._span(start, self._last(tree))
        kind = self._types[start]
        if kind == _EXPRESSION:
            body = next(c for c in tree.children if c.__class__ is Grammar.ExpressionContext)
            return ast.ExpressionBody(span=span, expression=self._expression(body))
        if kind != _EXTERNAL:
            return ast.UndefinedBody(span=span)
        path: tuple[str, ...] = ()
        arguments: tuple[ast.Argument, ...] = ()
        for child in tree.children:
            if child.__class__ is Grammar.DottedNameContext:
                path = self._dotted(child, "the name of an external method")
            elif child.__class__ is Grammar.ArgumentsContext:
                arguments = self._arguments(child)
        return ast.ExternalBody(span=span, path=path, arguments=arguments)

    def _tokens_before_end(self, tree: Tree) -> list[int]:
        return [child for child in tree.children if isinstance(child, int)]

    def _keep(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        children = tree.children
        strength = ast.KeepStrength.HARD
        position = 2
        if self._types_of(children[2]) in (_DEFAULT, _HARD):
            position = 3
            if self._types[children[2]] == _DEFAULT:
                strength = ast.KeepStrength.DEFAULT
        expression = self._expression(children[position])
        self._refuse_block(tree)
        return ast.KeepConstraint(**head.fields(), strength=strength, expression=expression)

    def _remove_default(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        parameter = self._expression(tree.children[2])
        if not isinstance(parameter, (ast.NameExpression, ast.MemberAccess, ast.ItExpression)):
            self._report("OSC100", parameter.span, "`remove_default` takes a parameter")
        self._refuse_block(tree)
        return ast.RemoveDefault(**head.fields(), parameter=parameter)

    def _coverage(self, tree: Tree, head: Head, place: Place) -> ast.Statement:
        keyword = tree.children[0]
        arguments: tuple[ast.Argument, ...] = ()
        if tree.children[2].__class__ is Grammar.ArgumentsContext:
            arguments = self._arguments(tree.children[2])
        else:
            message = f"`{self._text(keyword)}` needs the name of an item or `expression:`"
            self._report("OSC100", head.span, message)
        self._refuse_block(tree)
        return ast.CoverageDeclaration(
            **head.fields(), kind=self._text(keyword), arguments=arguments
        )

    # --- `with` ---------------------------------------------------------------------------------

    def _ending(self, tree: Tree, place: Place) -> tuple[ast.Statement, ...]:
        """Build the `with` block at the end of a statement, if there is one."""
        children = tree.children
        first = children[0]
        if first.__class__ is Grammar.WithBlockContext:
            return self._with_block(first, place)
        self._refuse_block(tree)
        last = children[-1]
        if last.__class__ is not Grammar.WithBlockContext:
            return ()
        message = "`with:` stands on the same line as what it belongs to"
        self._report("OSC100", self._span(last.start, last.start), message)
        return self._with_block(last, place)

    def _with_block(self, tree: Tree, place: Place) -> tuple[ast.Statement, ...]:
        inner = tree.children[-1]
        if inner.__class__ is not Grammar.StatementContext:
            if inner.__class__ is Grammar.BlockContext:
                self._comments.hand_on(tree.start, inner.start + 1)
            return self._body(tree, place, "`with`")
        first = inner.start
        message = "what belongs to `with:` stands on lines of its own"
        self._report("OSC100", self._span(first, first), message, "begin a new, indented line")
        node = self._statement(inner, place)
        return () if node is None else (node,)

    def _refuse_with(self, ending: Tree, what: str) -> None:
        """Build the end of a statement that cannot have a `with` block."""
        place = Place.WITH
        if ending.children[0].__class__ is Grammar.WithBlockContext:
            first = ending.start
            self._report("OSC108", self._span(first, first), f"{what} has no `with` block")
            place = Place.NOWHERE
        self._ending(ending, place)
