"""Hook of mkdocs: a page for each declaration of the library, made when the site is built."""

from __future__ import annotations

import re
import sys
from functools import cache
from pathlib import Path
from typing import Any

REPOSITORY = Path(__file__).parent.parent
sys.path.insert(0, str(REPOSITORY))

from osc2tx.reference import Entry, as_markdown, entries  # noqa: E402

FOLDER = "reference/library"
KINDS = {
    "action": "Actions",
    "modifier": "Modifiers",
    "actor": "Actors",
    "struct": "Structs",
    "enum": "Enums",
    "type": "Physical types",
}
LINES_AROUND = 3  # lines of a scenario that an example shows after the first use
_CODE = re.compile(r"`((?:action|modifier|actor|struct|enum|type) )?([\w.]+)`")


def on_config(config: Any, **_: Any) -> Any:
    """Add the pages to the navigation; called by mkdocs."""
    sections = [{"All names": f"{FOLDER}/index.md"}]
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
    for place, text in pages.items():
        files.append(File.generated(config, place, content=text))
    return files


def page_of(entry: Entry) -> str:
    """Return the page of a declaration, with links to others and an example that a test runs."""
    text = _linked(as_markdown(entry), entry)
    found = example(entry)
    if found is None:
        return text
    name, lines = found
    return f"{text}\n## Example\n\nFrom `{name}`, which the tests run:\n\n```\n{lines}\n```\n"


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


def example(entry: Entry) -> tuple[str, str] | None:
    """Return the shortest scenario of the repository that uses an action or modifier.

    Returns:
        Its path and the lines around the first use; None if none uses it.
    """
    kind, own = entry.declaration.kind, entry.own_name
    if kind not in ("action", "modifier"):
        return None
    before = r"\w\." if kind == "action" or "." in entry.declaration.name else r"(?<![\w.])"
    use = re.compile(rf"{before}{own}\(")
    for name, text in _scenarios():
        lines = [line.partition("#")[0] for line in text.splitlines()]
        number = next((i for i, line in enumerate(lines) if use.search(line)), None)
        if number is not None:
            first = max(number - (kind == "modifier") * 2, 0)
            shown = text.splitlines()[first : number + 1 + LINES_AROUND]
            return name, _dedented(shown)
    return None


@cache
def _scenarios() -> tuple[tuple[str, str], ...]:
    texts = [
        (path.relative_to(REPOSITORY).as_posix(), path.read_text(encoding="utf-8"))
        for path in sorted((REPOSITORY / "scenarios").rglob("*.osc"))
        if path.stem != "hello_world"  # in the dialect of CARLA
    ]
    return tuple(sorted(texts, key=lambda item: (len(item[1]), item[0])))


def _dedented(lines: list[str]) -> str:
    width = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
    return "\n".join(line[width:].rstrip() for line in lines).strip("\n")


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
        wanted = "modifier" if in_modifiers else ""
        return by_key.get(f"{wanted} {name}") if wanted else by_name.get(name) or None

    parts, in_modifiers, in_block = [], False, False
    for line in text.split("\n"):
        in_block = in_block != line.startswith("```")
        if line.startswith("## "):
            in_modifiers = line == "## Modifiers"
        row = line.split(" | ")
        if in_block or line.startswith(("#", "```")):
            parts.append(line)
        elif line.startswith("| `") and len(row) > 1:
            row[1] = _CODE.sub(link, row[1])
            parts.append(" | ".join(row))
        elif in_modifiers or "## Used by" in parts:
            parts.append(_CODE.sub(link, line))
        else:
            parts.append(line)
    return "\n".join(parts)
