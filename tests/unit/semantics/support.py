"""Compiling test sources up to the semantic model."""

import re
from pathlib import Path

from osc2tx.diagnostics import DiagnosticSink, SourceFile
from osc2tx.semantics import DIALECTS, ModelBuilder, SemanticModel
from osc2tx.syntax import ast, parse

_OPTION = re.compile(r"--(std|dialect) (\S+)")


def build(
    source: SourceFile, *, standard: str = "2.1", dialect: str = "asam"
) -> tuple[SemanticModel, DiagnosticSink]:
    """Check a source; imports are looked for beside it."""
    sink = DiagnosticSink()

    def load(statement: ast.Import, importing: SourceFile) -> ast.File | None:
        if statement.uri is None or importing.path is None:
            return None
        path = importing.path.parent / statement.uri
        if not path.is_file():
            return None
        text = path.read_text(encoding="utf-8")
        return parse(SourceFile(path.name, text, path), sink, allow=DIALECTS[dialect].relaxed)

    builder = ModelBuilder(sink, standard=standard, dialect=DIALECTS[dialect], load=load)
    return builder.build(parse(source, sink, allow=DIALECTS[dialect].relaxed)), sink


def build_text(
    text: str, *, standard: str = "2.1", dialect: str = "asam"
) -> tuple[SemanticModel, DiagnosticSink]:
    """Check a text."""
    return build(SourceFile("test.osc", text), standard=standard, dialect=dialect)


def build_file(path: Path) -> tuple[SemanticModel, DiagnosticSink]:
    """Check a file; a first line `# check: --std 2.2 --dialect carla` gives the options."""
    text = path.read_text(encoding="utf-8")
    first = text.partition("\n")[0]
    options = dict(_OPTION.findall(first)) if first.startswith("# check:") else {}
    return build(
        SourceFile(path.name, text, path),
        standard=options.get("std", "2.1"),
        dialect=options.get("dialect", "asam"),
    )


def codes(sink: DiagnosticSink) -> list[str]:
    """The codes of all reports, in order."""
    return [d.code for d in sink.sorted()]
