"""From the parser's tree to the AST, one module per chapter of the language.

Each module holds functions that take a `Builder` and a context of the parser's tree, and a table
`BUILDERS` of those that build a statement; `osc2tx.syntax.ast_transformer` joins the tables. In
reading order: `base` (the builder: tokens, spans, names), `expressions` (precedence), `comments`
and `statement_contexts` (owners of comments, positions of statements), `statements` (blocks and the
frame of a statement), `events`, `members`, `names`, `behaviors`, `enums`, `declarations`.

The builder reports invalid constructs that the grammar accepts; a statement that cannot be built is
skipped.
"""
