"""Reading files: encodings and what cannot be read."""

from pathlib import Path

import pytest

from osc2tx.diagnostics import DiagnosticSink
from osc2tx.syntax import read_source


def test_line_ends_and_byte_order_mark(tmp_path: Path) -> None:
    path = tmp_path / "a.osc"
    path.write_bytes(b"\xef\xbb\xbfa\r\nb\rc\n")
    source = read_source(path, "a.osc", DiagnosticSink())
    assert source is not None
    assert (source.name, source.text, source.path) == ("a.osc", "a\r\nb\rc\n", path)


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"abc\xff\n", "no UTF-8 at line 1, column 4"),
        (b"\xef\xbb\xbfab\xff\n", "no UTF-8 at line 1, column 3"),
        ("# Größe\n# Ä".encode() + b"\xfc\n", "no UTF-8 at line 2, column 4"),
        (b"ab\0\n", "NUL byte at line 1, column 3"),
        ("abc".encode("utf-16"), "NUL byte at line 1, column 4"),
    ],
)
def test_no_text(tmp_path: Path, data: bytes, message: str) -> None:
    path = tmp_path / "a.osc"
    path.write_bytes(data)
    sink = DiagnosticSink()
    assert read_source(path, "a.osc", sink) is None
    (found,) = sink.sorted()
    assert found.code == "OSC101" and message in found.message


def test_missing_file_and_directory(tmp_path: Path) -> None:
    for path, reason in [(tmp_path / "no.osc", "no such file"), (tmp_path, "it is a directory")]:
        sink = DiagnosticSink()
        assert read_source(path, "x", sink) is None
        assert reason in sink.sorted()[0].message
