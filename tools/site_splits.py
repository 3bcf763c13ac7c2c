"""Hook of mkdocs: long pages become several. In the repository each of them stays one file.

`diagnostics.md` keeps its introduction and tables, and each code gets a page; `coverage.md` keeps
its introduction, and each of its chapters gets a page. Links to their anchors are led there.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

DOCS = Path(__file__).parent.parent / "docs"
_CODE = re.compile(r'^<a id="(osc\d+)"></a>\n\n#### (.*)$', re.MULTILINE)
_CHAPTER = re.compile(r"^## (.*)$", re.MULTILINE)
_TO_CODE = re.compile(r"\]\(((?:\.\./)*)(?:diagnostics\.md)?#(osc\d+)\)")
_TO_CHAPTER = re.compile(r"\]\(((?:\.\./)*)coverage\.md#([\w-]+)\)")


def on_config(config: Any, **_: Any) -> Any:
    """Put the chapters below the page that they come from; called by mkdocs."""
    reference = next(entry["Reference"] for entry in config.nav if "Reference" in entry)
    place = next(i for i, entry in enumerate(reference) if "Coverage" in entry)
    chapters = [{title: name} for title, name, _ in _chapters()]
    reference[place] = {"Coverage": ["coverage.md", *chapters]}
    return config


def on_files(files: Any, config: Any, **_: Any) -> Any:
    """Make the pages; called by mkdocs."""
    from mkdocs.structure.files import File

    pages = {f"diagnostics/{code}.md": text for code, text in _codes().items()}
    pages |= {name: text for _, name, text in _chapters()}
    changes = (DOCS.parent / "CHANGELOG.md").read_text(encoding="utf-8")
    pages["changes.md"] = changes.replace("](docs/", "](")
    for place, text in pages.items():
        files.append(File.generated(config, place, content=text))
    return files


def on_page_markdown(markdown: str, *, page: Any, **_: Any) -> str:
    """Cut what has pages of its own, and lead the links there; called by mkdocs."""
    here = page.file.src_uri
    if here == "diagnostics.md":
        markdown = markdown[: _first(_CODE, markdown)]
    elif here == "coverage.md":
        links = "\n".join(f"- [{title}]({name})" for title, name, _ in _chapters())
        markdown = f"{markdown[: _first(_CHAPTER, markdown)]}{links}\n"
    markdown = _TO_CODE.sub(r"](\1diagnostics/\2.md)", markdown)
    return _TO_CHAPTER.sub(_lead_to_chapter, markdown)


def _lead_to_chapter(link: re.Match[str]) -> str:
    """The page that has the anchor; a wrong one stays, for mkdocs to find."""
    for _, name, text in _chapters():
        anchors = [_slug(title) for title in re.findall(r"^#+ (.*)$", text, re.MULTILINE)]
        if link[2] in anchors:
            anchor = "" if link[2] == anchors[0] else f"#{link[2]}"
            return f"]({link[1]}{name}{anchor})"
    return link[0]


def _codes() -> dict[str, str]:
    """Pages by code: heading, error, breaking text, remedy, mended text."""
    text = (DOCS / "diagnostics.md").read_text(encoding="utf-8")
    parts = _CODE.split(text)[1:]
    triples = zip(parts[::3], parts[1::3], parts[2::3], strict=True)
    return {code: f"# {title}\n\n{body.strip()}\n" for code, title, body in triples}


def _chapters() -> list[tuple[str, str, str]]:
    """Title, place and text of the chapters of the coverage page."""
    text = (DOCS / "coverage.md").read_text(encoding="utf-8")
    parts = _CHAPTER.split(text)[1:]
    found = []
    for title, body in zip(parts[::2], parts[1::2], strict=True):
        name = title.partition(":")[0]
        lifted = re.sub(r"^###", "##", body, flags=re.MULTILINE)
        found.append((name, f"coverage-{_slug(name)}.md", f"# {title}\n{lifted}"))
    return found


def _slug(title: str) -> str:
    return re.sub(r"[^\w]+", "-", title.lower()).strip("-")


def _first(pattern: re.Pattern[str], text: str) -> int:
    match = pattern.search(text)
    if match is None:
        raise ValueError(f"nothing in the page looks like {pattern.pattern}")
    return match.start()
