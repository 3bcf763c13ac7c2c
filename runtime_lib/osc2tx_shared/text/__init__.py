r"""Text from files and arguments on its way out: to terminals, logs and files.

Names, strings, comments, paths and values of options are untrusted text. Where they are shown,
characters that steer a terminal, turn the direction of writing or begin a line are written as
escapes (`\x1b`, `\u202e`, `\n`), and commands of CI servers (`::error::`) are broken up.

`printing` writes a text in a line, in JSON and in XML. It is the only place where osc2tx and its
runtime write to standard output and standard error, and cleans all of it. The package only imports
the standard library.
"""

from __future__ import annotations

from osc2tx_shared.text.printing import (
    READER_HAS_GONE,
    OutputError,
    StreamName,
    clear_status,
    complain,
    expect_output,
    explain,
    flush,
    in_json,
    in_xml,
    is_watched,
    put,
    put_document,
    recorded,
    replay,
    say,
    show_status,
    visible,
    without_commands,
)

__all__ = [
    "READER_HAS_GONE",
    "OutputError",
    "StreamName",
    "clear_status",
    "complain",
    "expect_output",
    "explain",
    "flush",
    "in_json",
    "in_xml",
    "is_watched",
    "put",
    "put_document",
    "recorded",
    "replay",
    "say",
    "show_status",
    "visible",
    "without_commands",
]
