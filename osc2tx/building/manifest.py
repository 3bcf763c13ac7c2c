"""The manifest: files of the output folder that osc2tx wrote, with digests.

It lies in the output folder, belongs into version control with the outputs, and is the same on
every machine: one line for each source, sorted, so that git merges two changes of different files.

    {
      "format": 2,
      "tool": "osc2tx 0.1.0",
      "outputs": {
        "urban/cut_in.osc": {"cut_in.py": "…", "cut_in.xosc": "…"}
      }
    }

Sources are relative to their folder. Outputs lie in the same folder below that of the outputs, each
with the digest of what was written. Source maps are not listed: nobody commits them, and one beside
a listed module belongs to it. While a build writes, `unfinished` lists what it is about to write,
so that after a sudden end the next build knows its own work from that of others. A manifest may
come from a stranger's branch: a path that leaves the folder makes it invalid.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import field
from pathlib import Path, PurePosixPath, PureWindowsPath

from osc2tx.support.light_dataclass import dataclass
from osc2tx.version import __version__

MANIFEST_NAME = ".osc2tx-manifest.json"
FORMAT = 2


class ManifestError(Exception):
    """A manifest that cannot be used; the message names it and says what to do."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One output.

    Attributes:
        source: Name of the source that makes it.
        digest: Of what was written.
    """

    source: str
    digest: str


@dataclass(frozen=True, slots=True)
class Manifest:
    """What a manifest says.

    Attributes:
        outputs: Path of an output to its entry.
        unfinished: The same for what a build was about to write when it was killed.
    """

    outputs: Mapping[str, Entry] = field(default_factory=dict)
    unfinished: Mapping[str, Entry] = field(default_factory=dict)

    def settled(self, has: Callable[[str, str], bool]) -> Manifest:
        """Return the manifest as the unfinished build would have left it had it stopped by itself.

        Args:
            has: Whether the file at a path has a digest.
        """
        written = {p: e for p, e in self.unfinished.items() if has(p, e.digest)}
        return Manifest({**self.outputs, **written})

    def render(self) -> str:
        """Return the text of the file."""
        parts = [
            f'  "format": {FORMAT}',
            f'  "tool": {_quoted(f"osc2tx {__version__}")}',
            _table("outputs", self.outputs),
        ]
        if self.unfinished:
            parts.append(_table("unfinished", self.unfinished))
        return "{\n" + ",\n".join(parts) + "\n}\n"


def read_manifest(out_dir: Path) -> Manifest:
    """Return the manifest of a folder; an empty one if there is none.

    Raises:
        ManifestError: If it is damaged.
    """
    path = out_dir / MANIFEST_NAME
    try:
        if path.is_symlink():
            raise ValueError("is a link")
        document = json.loads(path.read_text(encoding="utf-8"))
        return _manifest(document)
    except (FileNotFoundError, NotADirectoryError):
        return Manifest()
    except OSError as error:
        raise ManifestError(f"{path}: cannot be read: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise ManifestError(
            f"{path}: is damaged ({error}); restore it, or remove it: "
            "outputs that are up to date are then entered again"
        ) from None


def _manifest(document: Mapping[str, object]) -> Manifest:
    if document["format"] != FORMAT:
        raise ValueError(f"form {document['format']!r} is not known to osc2tx {__version__}")
    return Manifest(_entries(document["outputs"]), _entries(document.get("unfinished", {})))


def _entries(table: object) -> dict[str, Entry]:
    if not isinstance(table, dict):
        raise ValueError("a table is missing")
    return {
        _checked(beside(source, name)): Entry(source, _text(digest))
        for source, outputs in table.items()
        for name, digest in outputs.items()
    }


def beside(source: str, name: str) -> str:
    """Return the path of an output of a source, from its name."""
    folder, slash, _ = source.rpartition("/")
    return f"{folder}{slash}{name}"


def _checked(path: str) -> str:
    """Return a path that stays in the folder, on any system.

    Raises:
        ValueError: If it does not.
    """
    parts = PurePosixPath(path).parts
    windows = PureWindowsPath(path)
    is_plain = "/".join(parts) == path and ".." not in parts and "\0" not in path
    if not parts or not is_plain or path == MANIFEST_NAME:
        raise ValueError(f"{path!r} is no path of an output")
    if path.startswith("/") or windows.drive or windows.root or ".." in windows.parts:
        raise ValueError(f"{path!r} leaves the folder")
    return path


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise ValueError(f"{value!r} is no text")
    return value


def _table(name: str, entries: Mapping[str, Entry]) -> str:
    by_source: dict[str, list[str]] = {}
    for path, entry in sorted(entries.items()):
        output = f"{_quoted(path.rpartition('/')[2])}: {_quoted(entry.digest)}"
        by_source.setdefault(entry.source, []).append(output)
    lines = ",\n".join(
        f"    {_quoted(source)}: {{{', '.join(outputs)}}}"
        for source, outputs in sorted(by_source.items())
    )
    return f'  "{name}": {{\n{lines}\n  }}' if lines else f'  "{name}": {{}}'


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)
