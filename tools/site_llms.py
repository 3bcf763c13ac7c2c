"""Hook of mkdocs: `llms.txt`, the pages of the site with one line each, for language models.

The form is that of llmstxt.org: a title, a summary, sections with lists of links.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

NAME = "llms.txt"
LONGEST = 160  # characters of a description
_PROSE = re.compile(r"(?m)^(?![#|>!<`\-*:]|\d+\.|\s)\S.*(?:\n(?![#|>!<`\-*:\n]).*)*")
_TITLE = re.compile(r"(?m)^# (.+)$")
_LINK = re.compile(r"\[([^\]]+)\]\([^)]*\)")

_text = ""


def on_nav(nav: Any, config: Any, files: Any) -> Any:
    """List the pages; called by mkdocs."""
    global _text
    sections: dict[str, list[str]] = {}
    in_nav = set()
    for section, title, page in _pages(nav.items, ""):
        in_nav.add(page.file.src_uri)
        sections.setdefault(section, []).append(
            line_of(title, page.file.url, page.file.content_string)
        )
    for file in files.documentation_pages():  # those of single diagnostics, by their folder
        if file.src_uri not in in_nav:
            section = file.src_uri.partition("/")[0].capitalize()
            title = _TITLE.search(file.content_string)
            line = line_of(title[1] if title else file.name, file.url, file.content_string)
            sections.setdefault(section, []).append(line)
    _text = document(config.site_name, config.site_description, sections)
    return nav


def on_post_build(config: Any, **_: Any) -> None:
    """Write the list beside the pages; called by mkdocs."""
    Path(config.site_dir, NAME).write_text(_text, encoding="utf-8", newline="\n")


def document(name: str, summary: str, sections: dict[str, list[str]]) -> str:
    """Return the text of `llms.txt`."""
    parts = [f"# {name}", f"> {summary}"]
    parts.append("Tools for language models: `osc2tx mcp` (Model Context Protocol).")
    for title, lines in sections.items():
        parts += [f"## {title}", "\n".join(lines)]
    return "\n\n".join(parts) + "\n"


def line_of(title: str, url: str, markdown: str) -> str:
    """Return the line of a page: its link, and its first sentence."""
    prose = _PROSE.search(re.sub(r"(?ms)^```.*?^```", "", markdown))
    if prose is None:
        return f"- [{title}]({url})"
    words = _LINK.sub(r"\1", prose[0]).split()
    sentence = re.split(r"(?<=\w)[.:] ", " ".join(words), maxsplit=1)[0].rstrip(".:")
    if len(sentence) > LONGEST:
        sentence = sentence[:LONGEST].rsplit(" ", 1)[0] + " …"
    return f"- [{title}]({url}): {sentence}"


def _pages(items: Any, section: str) -> Iterator[tuple[str, str, Any]]:
    """Yield section, title and page, in the order of the navigation."""
    for item in items:
        if item.is_section:
            yield from _pages(item.children, section or item.title)
        elif item.is_page:
            yield section or "Start", item.title or item.file.name, item
