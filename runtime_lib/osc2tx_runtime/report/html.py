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


def resources(*names: str) -> str:
    """Return the texts of files of this package, one below the other."""
    return "\n".join(map(resource, names))


def page(body: str, title: str, purpose: str, style: str, script: str, data: Json) -> str:
    """Return a page.

    Args:
        body: The file with its elements.
        title: Its title.
        purpose: What it does with its data, for browsers that run no scripts.
        style: Its style sheet.
        script: The only script that the browser runs.
        data: The data that the script draws.
    """
    return Template(resource("page.html")).substitute(
        title=title,
        purpose=purpose,
        style=style,
        script=script,
        style_hash=_csp_hash(style),
        script_hash=_csp_hash(script),
        body=resource(body),
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
