"""Reads source files: UTF-8 with or without byte order mark (§7.2.1.1)."""

from __future__ import annotations

from pathlib import Path

from osc2tx.diagnostics import DiagnosticSink, SourceFile


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
        message = f"cannot read `{name}`: NUL byte at offset {position}"
        sink.report("OSC101", None, message, help="is it a text file in UTF-8?")
        return None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        offset = error.start + (3 if data.startswith(b"\xef\xbb\xbf") else 0)
        message = f"cannot read `{name}`: no UTF-8 at byte offset {offset}"
        sink.report("OSC101", None, message, help="save the file in UTF-8")
        return None
    return SourceFile(name, text, path)


def _reason(error: OSError | ValueError) -> str:
    reason = error.strerror if isinstance(error, OSError) else None
    return (reason or str(error)).lower()
