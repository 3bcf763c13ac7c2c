"""Hook of mkdocs: a page for each declaration of the library, made when the site is built."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).parent.parent
sys.path[:0] = [str(REPOSITORY), str(Path(__file__).parent)]

from site_pictures import picture  # noqa: E402

from osc2tx.reference import (  # noqa: E402
    Entry,
    as_markdown,
    entries,
    topic_as_markdown,
    topics,
)

FOLDER = "reference/library"
KINDS = {
    "action": "Actions",
    "modifier": "Modifiers",
    "actor": "Actors",
    "struct": "Structs",
    "enum": "Enums",
    "type": "Physical types",
}
# Place, title and kinds of the pages of topics.
TOPICS = (
    ("language", "The language", ()),
    ("methods", "Methods", ("method",)),
    ("units", "Units", ("unit",)),
)
_CODE = re.compile(r"`((?:action|modifier|actor|struct|enum|type) )?([\w.]+)`")


def on_config(config: Any, **_: Any) -> Any:
    """Add the pages to the navigation; called by mkdocs."""
    sections = [{"All names": f"{FOLDER}/index.md"}]
    for place, title, _ in TOPICS:
        sections.append({title: f"{FOLDER}/{place}.md"})
    for kind, title in KINDS.items():
        pages = sorted(_of_kind(kind), key=lambda entry: entry.declaration.name)
        sections.append({title: [{entry.declaration.name: _place(entry)} for entry in pages]})
    config.nav.append({"Library": sections})
    return config


def on_files(files: Any, config: Any, **_: Any) -> Any:
    """Make the pages; called by mkdocs."""
    from mkdocs.structure.files import File

    pages = {_place(entry): page_of(entry) for entry in entries()}
    pages[f"{FOLDER}/index.md"] = index()
    for place, title, kinds in TOPICS:
        pages[f"{FOLDER}/{place}.md"] = topic_page(title, kinds)
    for entry in entries():
        svg = picture(entry)
        if svg is not None:
            pages[_picture_of(entry)] = svg
            pages[_place(entry)] = with_picture(pages[_place(entry)], entry)
    for place, text in pages.items():
        files.append(File.generated(config, place, content=text))
    return files


def topic_page(title: str, kinds: tuple[str, ...]) -> str:
    """Return the page of some kinds of topics, of all constructs of the language without kinds."""
    found = [t for t in topics() if (t.kind in kinds if kinds else t.is_of_language)]
    parts = [f"# {title}"]
    for topic in found:
        name = ", ".join(f"`{each}`" for each in topic.names) if not kinds else f"`{topic.name}`"
        parts += [f"## {name}", topic_as_markdown(topic)]
    return "\n\n".join(parts)


def page_of(entry: Entry) -> str:
    """Return the page of a declaration, with links to others."""
    return _linked(as_markdown(entry), entry)


def with_picture(page: str, entry: Entry) -> str:
    """Return the page with the picture of its example."""
    said = f"Effect of its example ({Path(entry.shown.file).name})"
    shown = f"![{said}](../pictures/{Path(_picture_of(entry)).name})"
    head, example, tail = page.partition("\n## Example\n")
    return f"{head}\n## Effect\n\n{shown}\n{example}{tail}"


def _picture_of(entry: Entry) -> str:
    return f"{FOLDER}/pictures/{entry.declaration.kind}-{entry.declaration.name}.svg"


def index() -> str:
    """Return the page with all names."""
    parts = ["# Library\n\nWhat `import osc.standard.all` brings, from `osc2tx reference`."]
    for kind, title in KINDS.items():
        rows = ["| name | section | meaning |", "|---|---|---|"]
        for entry in _of_kind(kind):
            declaration = entry.declaration
            link = f"[{declaration.name}]({kind}/{declaration.name}.md)"
            rows.append(f"| {link} | {declaration.section} | {declaration.meaning} |")
        parts += [f"## {title}", "\n".join(rows)]
    return "\n\n".join(parts) + "\n"


def _of_kind(kind: str) -> list[Entry]:
    return [entry for entry in entries() if entry.declaration.kind == kind]


def _place(entry: Entry) -> str:
    return f"{FOLDER}/{entry.declaration.kind}/{entry.declaration.name}.md"


def _linked(text: str, entry: Entry) -> str:
    """Names of declarations in code become links; those in blocks of code stay."""
    by_key = {each.key: each for each in entries()}
    by_name = {each.own_name: each for each in reversed(entries())}

    def link(match: re.Match[str]) -> str:
        kind, name = match[1] or "", match[2]
        found = by_key.get(f"{kind}{name}") if kind else _meant(name)
        if found is None or found is entry:
            return match[0]
        declaration = found.declaration
        return f"[{match[0]}](../{declaration.kind}/{declaration.name}.md)"

    def _meant(name: str) -> Entry | None:
        wanted = "modifier" if in_modifiers else "action" if in_actions else ""
        return by_key.get(f"{wanted} {name}") if wanted else by_name.get(name) or None

    parts, in_modifiers, in_actions, in_block = [], False, False, False
    for line in text.split("\n"):
        in_block = in_block != line.startswith("```")
        if line.startswith("## "):
            in_modifiers, in_actions = line == "## Modifiers", line == "## Actions"
        row = line.split(" | ")
        if in_block or line.startswith(("#", "```")):
            parts.append(line)
        elif line.startswith("| `") and len(row) > 1:
            row[1] = _CODE.sub(link, row[1])
            parts.append(" | ".join(row))
        elif in_modifiers or in_actions or "## Used by" in parts:
            parts.append(_CODE.sub(link, line))
        else:
            parts.append(line)
    return "\n".join(parts)
