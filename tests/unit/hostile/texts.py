"""Hostile texts, and what they must not change."""

import ast

# For names, strings, comments: what could end a literal, a comment or a line, or be code.
TEXTS = [
    "'; import os; os.system('touch pwned'); '",
    '"; import os; os.system("touch pwned"); "',
    '"""',
    "'''",
    '"""; raise SystemExit; """',
    "\\",
    "\\\\",
    "trailing backslash\\",
    '\\"',
    "\\n",
    "\\N{BULLET}",
    "{{ 7 * 7 }}",
    "{% for x in y %}",
    "{# comment #}",
    "{{ ''.__class__.__mro__[1].__subclasses__() }}",
    "{0}{1!r}{x.__class__}",
    "{self.__class__}",
    "%s%d%(name)s",
    "${HOME}`id`$(id)",
    "__import__('os').system('id')",
    "eval(compile('1', '', 'exec'))",
    "__class__",
    "__init__",
    "__builtins__",
    "_private",
    "self",
    "super",
    "class",
    "None",
    "match",
    "lambda: 0",
    "print",
    "Scenario",
    "Serial",
    "require_api",
    "create_root",
    "declare",
    "behavior",
    "type",
    "# no comment",
    "a # b",
    "../../etc/passwd",
    "..",
    "/",
    "con",
    "NUL.txt",
    " ",
    "0",
    "1e9",
    "--help",
    "a;b",
    "a:b",
    "a,b)",
    "))))",
    "](x)",
    "fi\ufb01",  # a ligature that NFKC takes apart
    "\u0430\u0435\u043e",  # looks like `aeo`
    "e\u0301",
    "\u212b",
    "\u202eabc",  # turns the direction of writing
    "\u200b",
    "\u2028",
    "\x85",
    "\x0c",
    "\x1b[31m",
    "\x7f",
    "\ufeff",
    "\U0001f697",
    "\u0130",
    "\u1e9e",
]
MULTILINE = ["a\nb", "a\r\nb", "\n", "\n    import os\n", '"""\nimport os\n"""', "a\rb", "\t", "\0"]


def skeleton(python: str) -> list[str]:
    """Return the shape of a module: what kinds of nodes it has, whatever they are called.

    Docstrings are left out: a comment may be one.
    """
    tree = ast.parse(python)
    left_out = docstrings(tree)
    return [type(node).__name__ for node in ast.walk(tree) if node not in left_out]


def strings(python: str) -> list[str]:
    """Return all strings of a module in order, without the docstrings."""
    tree = ast.parse(python)
    left_out = docstrings(tree)
    return [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in left_out
    ]


def docstrings(tree: ast.Module) -> set[ast.AST]:
    """Return the docstrings of a module: the statements, and their strings."""
    found: set[ast.AST] = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            match node.body[0]:
                case ast.Expr(value=ast.Constant(value=str())) as first:
                    found |= {first, first.value}
    return found


def quoted(text: str) -> str:
    """Return a text as a string literal of the language."""
    return '"' + "".join(_escaped(char) for char in text) + '"'


def _escaped(char: str) -> str:
    if char in '"\\':
        return f"\\{char}"
    return char if char.isprintable() else f"\\U{ord(char):08x}"
