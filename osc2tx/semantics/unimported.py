"""Names of the standard library that the program does not import."""

from __future__ import annotations

from osc2tx.semantics.resolution import Resolution
from osc2tx.syntax import ast


def report_unimported(r: Resolution, name: ast.Name) -> bool:
    """Whether a name only lacks the import of the library; that is reported once per file."""
    if r.unimported is None:
        return False
    library = r.unimported()
    text = name.text
    known = (
        library.types_named(text)
        or library.modifiers_named(text)
        or library.behaviors_named(text)
        or library.unit_named(text)
    )
    if not known:
        return False
    if r.relaxations.is_new("OSC205", name.span.source.name, ""):
        r.report(
            "OSC202",
            name.span,
            f"`{name}` belongs to the standard library, which is not imported",
            help="write `import osc.standard.all`, then `namespace null use std, stdtypes`",
        )
    return True
