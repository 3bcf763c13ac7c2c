"""Compiled templates, kept where Python keeps compiled modules: in `__pycache__` beside them.

Who may write there may change osc2tx itself, so they are trusted as it is. Jinja compares the text
of a template and its own version.
"""

from __future__ import annotations

import sys
from importlib.util import cache_from_source
from pathlib import Path

from jinja2 import BytecodeCache
from jinja2.bccache import Bucket

from osc2tx_shared.cache import read_own, write_own


class CompiledTemplates(BytecodeCache):
    """The compiled templates of a folder."""

    def __init__(self, folder: Path) -> None:
        """Take the folder of the templates."""
        self._folder = folder

    def load_bytecode(self, bucket: Bucket) -> None:
        """Load a compiled template, if there is one."""
        found = read_own(self._place(bucket))
        if found is not None:
            bucket.bytecode_from_string(found)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Keep a compiled template, where Python may keep compiled modules."""
        if not sys.dont_write_bytecode:
            write_own(self._place(bucket), bucket.bytecode_to_string())

    def _place(self, bucket: Bucket) -> Path:
        return Path(cache_from_source(str(self._folder / f"{bucket.key}.py"))).with_suffix(".j2c")
