"""Hook of mkdocs: links that leave docs/ become plain words, if their targets exist."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).parent.parent
DOCS = REPOSITORY / "docs"
_LINK = re.compile(r"(?<!!)\[([^\]]+)\]\(([^)#\s]+)(#[^)\s]*)?\)")


def on_page_markdown(markdown: str, *, page: Any, **_: Any) -> str:
    """Rewrite one page; called by mkdocs.

    Raises:
        FileNotFoundError: If a link leads to nothing; mkdocs itself looks after those inside.
    """
    folder = (DOCS / page.file.src_uri).parent

    def rewrite(link: re.Match[str]) -> str:
        if "://" in link[2]:
            return link[0]
        target = Path(os.path.normpath(folder / link[2]))
        if target.is_relative_to(DOCS):
            return link[0]
        if not target.exists():
            raise FileNotFoundError(f"{page.file.src_uri}: {link[2]} leads to nothing")
        return link[1] if link[1].startswith("`") else f"`{target.relative_to(REPOSITORY)}`"

    return _LINK.sub(rewrite, markdown)
