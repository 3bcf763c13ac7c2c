"""The manifest: which files of the output folder osc2tx made, and from which source.

It lies in the output folder, belongs into version control with the outputs, and is the same on
every machine: one line for each source, sorted, so that git merges two changes of different files.

    {
      "format": 3,
      "outputs": {
        "urban/cut_in.osc": ["cut_in.py", "cut_in.xosc"]
      }
    }

Sources are relative to their folder. Outputs lie in the same folder below that of the outputs. A
line changes when a source makes other files, not when it makes other texts: what those were is
known from `written_digests` and from version control. Source maps are not listed: nobody commits
them, and one beside a listed module belongs to it. A manifest may come from a stranger's branch: a
path that leaves the folder makes it invalid.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import field
from pathlib import Path, PurePosixPath, PureWindowsPath

from osc2tx.version import __version__
from osc2tx_shared.classes import dataclass
from osc2tx_shared.text import in_json

MANIFEST_NAME = ".osc2tx-manifest.json"
FORMAT = 3


class ManifestError(Exception):
    """A manifest that cannot be used; the message names it and says what to do."""


@dataclass(frozen=True, slots=True)
class Manifest:
    """What a manifest says.

    Attributes:
        outputs: Path of an output to the name of the source that makes it.
    """

    outputs: Mapping[str, str] = field(default_factory=dict)

    def render(self) -> str:
        """Return the text of the file."""
        by_source: dict[str, list[str]] = {}
        for path, source in sorted(self.outputs.items()):
            by_source.setdefault(source, []).append(path.rpartition("/")[2])
        lines = ",\n".join(
            f"    {_json(source)}: {_json(names)}" for source, names in sorted(by_source.items())
        )
        table = f"{{\n{lines}\n  }}" if lines else "{}"
        return f'{{\n  "format": {FORMAT},\n  "outputs": {table}\n}}\n'


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
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise ManifestError(
            f"{path}: is damaged ({error}); restore it, or remove it: "
            "outputs that are up to date are then entered again"
        ) from None


def _manifest(document: Mapping[str, object]) -> Manifest:
    if document["format"] != FORMAT:
        raise ValueError(f"form {document['format']!r} is not known to osc2tx {__version__}")
    table = document["outputs"]
    if not isinstance(table, dict):
        raise ValueError("the table of outputs is missing")
    return Manifest(
        {
            _checked(beside(source, name)): source
            for source in table
            for name in _names(table, source)
        }
    )


def _names(table: Mapping[str, object], source: str) -> list[str]:
    names = table[source]
    if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
        raise ValueError(f"{source!r} has no list of outputs")
    return names


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


def _json(value: object) -> str:
    return in_json(json.dumps(value, ensure_ascii=False))
