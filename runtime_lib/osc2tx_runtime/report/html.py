"""Combines data, style and script in one HTML file that loads nothing."""

from __future__ import annotations

import base64
import hashlib
import json
from importlib.resources import files
from string import Template

from .json_values import Json


def resource(name: str) -> str:
    """Return the text of a file of this package."""
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def fill(template: str, style: str, script: str, data: Json) -> str:
    """Return the page of a template with `$style`, `$script`, `$data` and the hashes."""
    return Template(template).substitute(
        style=style,
        script=script,
        style_hash=_csp_hash(style),
        script_hash=_csp_hash(script),
        data=_embed(data),
    )


def _csp_hash(content: str) -> str:
    """The hash of the only script that the browser runs: no content of a trace is executed."""
    digest = hashlib.sha256(content.encode("utf-8")).digest()
    return "sha256-" + base64.b64encode(digest).decode("ascii")


def _embed(data: Json) -> str:
    r"""JSON that cannot close its script block.

    ASCII output writes U+2028 and U+2029 (and lone surrogates) as \u escapes already.
    """
    encoded = json.dumps(data, separators=(",", ":"), ensure_ascii=True, allow_nan=False)
    for character in "<>&":
        encoded = encoded.replace(character, f"\\u{ord(character):04x}")
    return encoded
