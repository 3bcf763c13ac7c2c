"""The AST of a file from its parser tree: dispatch and the file itself."""

from __future__ import annotations

from typing import Any, ClassVar

from osc2tx.diagnostics import Span
from osc2tx.syntax import ast
from osc2tx.syntax._antlr.OpenSCENARIO2 import OpenSCENARIO2 as Grammar
from osc2tx.syntax.ast_builder.base import Tree
from osc2tx.syntax.ast_builder.declarations import DeclarationBuilder
from osc2tx.syntax.ast_builder.statement_contexts import Place
from osc2tx.syntax.ast_builder.statements import Handler


class ASTTransformer(DeclarationBuilder):
    """Turns the tree of the rule `sourceFile` into an `ast.File`."""

    _handlers: ClassVar[dict[type, Handler]] = {
        Grammar.ImportStatementContext: DeclarationBuilder._import,
        Grammar.NamespaceStatementContext: DeclarationBuilder._namespace,
        Grammar.UseStatementContext: DeclarationBuilder._use,
        Grammar.ExportStatementContext: DeclarationBuilder._export,
        Grammar.PhysicalTypeDeclarationContext: DeclarationBuilder._physical_type,
        Grammar.UnitDeclarationContext: DeclarationBuilder._unit,
        Grammar.EnumDeclarationContext: DeclarationBuilder._enum,
        Grammar.StructDeclarationContext: DeclarationBuilder._struct,
        Grammar.ActorDeclarationContext: DeclarationBuilder._actor,
        Grammar.ScenarioDeclarationContext: DeclarationBuilder._scenario,
        Grammar.ActionDeclarationContext: DeclarationBuilder._action,
        Grammar.ModifierDeclarationContext: DeclarationBuilder._modifier,
        Grammar.ExtensionContext: DeclarationBuilder._extension,
        Grammar.GlobalParameterContext: DeclarationBuilder._global,
        Grammar.EventDeclarationContext: DeclarationBuilder._event,
        Grammar.VariableDeclarationContext: DeclarationBuilder._variable,
        Grammar.MethodDeclarationContext: DeclarationBuilder._method,
        Grammar.KeepConstraintContext: DeclarationBuilder._keep,
        Grammar.RemoveDefaultContext: DeclarationBuilder._remove_default,
        Grammar.CoverageDeclarationContext: DeclarationBuilder._coverage,
        Grammar.OnDirectiveContext: DeclarationBuilder._on,
        Grammar.DoDirectiveContext: DeclarationBuilder._do,
        Grammar.CompositionContext: DeclarationBuilder._composition,
        Grammar.WaitDirectiveContext: DeclarationBuilder._wait,
        Grammar.EmitDirectiveContext: DeclarationBuilder._emit,
        Grammar.CallDirectiveContext: DeclarationBuilder._call_directive,
        Grammar.UntilDirectiveContext: DeclarationBuilder._until,
        Grammar.NameStatementContext: DeclarationBuilder._name_statement,
    }

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
                node = self._statement(child, Place.FILE)
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
            span=Span(self._source, 0, len(self._code)),
            imports=tuple(imports),
            statements=tuple(statements),
        )

    def _block_without_header(self, block: Tree) -> tuple[Any, ...]:
        """Build an indented start of the file, or a block under a line that was not readable."""
        self._report_indentation(block)
        return self._block(block, Place.NOWHERE if self._has_lost_header(block) else Place.FILE)

    def _report_late_import(self, node: ast.Import) -> None:
        message = "an import stands before all other statements of a file"
        self._report("OSC108", node.span, message, "move it to the top of the file")
