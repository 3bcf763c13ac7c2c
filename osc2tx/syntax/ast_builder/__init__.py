"""From the parser's tree to the AST, one module per chapter of the language.

Each module holds one class that builds its constructs; the classes build on each other and end in
`osc2tx.syntax.ast_transformer.ASTTransformer`. In reading order: `base` (tokens, spans, names),
`expressions` (precedence), `comments` and `statement_contexts` (who gets a comment, what may stand
where), `statements` (blocks and the frame of a statement), `events`, `members`, `names`,
`behaviors`, `enums`, `declarations`.

The builder refuses what the grammar takes too much, with a message; a statement that cannot be
built is left out.
"""
