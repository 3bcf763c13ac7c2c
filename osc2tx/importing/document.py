"""A document with the files that it names: catalogs, the map, and the places of its start."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path

from osc2tx.importing.reach import Reach
from osc2tx.importing.substitution import (
    scoped,
    substituted,
    values_in,
    with_each,
    with_plain_names,
    with_values,
)
from osc2tx.xosc import Element, Place, Unreadable, read
from osc2tx.xosc import elements as xml
from osc2tx.xosc.arithmetic import text_value
from osc2tx.xosc.reader import Comment
from osc2tx_runtime.domain.map.search import find_map
from osc2tx_runtime.errors import ScenarioError
from osc2tx_shared.classes import dataclass

CATALOG_SIZE = 20_000_000
LONGEST_PATH = 200


class Refused(Exception):
    """A document that is not imported.

    Attributes:
        reason: A sentence without full stop.
        place: Where that shows.
        source: Its file; `None` for standard input.
    """

    def __init__(self, reason: str, place: Place | None = None) -> None:
        """Take what there is to say."""
        super().__init__(reason)
        self.reason, self.place = reason, place
        self.source: Path | None = None


@dataclass(frozen=True, slots=True)
class Folders:
    """Where the files are that documents name.

    Attributes:
        maps: Folders of maps, besides that of the document.
        catalogs: Folders of catalogs, besides those that the document names.
    """

    maps: tuple[Path, ...] = ()
    catalogs: tuple[Path, ...] = ()


NOWHERE = Folders()


class Document:
    """A scenario of OpenSCENARIO XML.

    Attributes:
        root: Its root element.
        path: Its file; `None` for standard input.
        comments: Its comments.
        scoped: Parameters of its parts and of entries of catalogs, with the names of the catalogs.
    """

    def __init__(
        self,
        root: Element,
        path: Path | None,
        comments: Sequence[Comment],
        folders: Folders = NOWHERE,
    ) -> None:
        self.path = path
        self.comments = comments
        self._folders = folders
        self._entries: dict[tuple[str, str], tuple[Element, Path]] | None = None
        self._instances: dict[int, tuple[Element, Path] | None] = {}
        self.scoped = [
            (node, "")
            for part in root.children
            if part.tag != "ParameterDeclarations"
            for node in part.below(xml.ParameterDeclaration)
        ]
        root = with_each(root, with_plain_names)
        self.root = scoped(root) if self.scoped else root
        self._resolutions: dict[int, tuple[Element, Element]] = {}

    def resolved_with(self, values: Mapping[str, str]) -> Element:
        """Return the document as `resolved`, with other values of some parameters."""
        if not values:
            return self.resolved
        return Document(with_values(self.root, values), self.path, (), self._folders).resolved

    @cached_property
    def _by_tag(self) -> dict[str, list[Element]]:
        return _by_tag(self.root)

    @cached_property
    def _resolved_by_tag(self) -> dict[str, list[Element]]:
        return self._by_tag if self.resolved is self.root else _by_tag(self.resolved)

    def tagged(self, *tags: str) -> list[Element]:
        """Return all elements with one of some tags, those of each in the order of the document."""
        return [node for tag in tags for node in self._by_tag.get(tag, ())]

    def resolved_tagged(self, tag: str) -> Sequence[Element]:
        """Return all elements of `resolved` with a tag, in their order."""
        return self._resolved_by_tag.get(tag, ())

    @property
    def folder(self) -> Path:
        """The folder that relative paths start from."""
        return Path() if self.path is None else self.path.parent

    # --- parameters -------------------------------------------------------------------------------

    @cached_property
    def declared(self) -> Mapping[str, str]:
        """The texts of the parameters as they are given."""
        declarations = self.root.find(xml.ParameterDeclarations)
        nodes = () if declarations is None else declarations.all(xml.ParameterDeclaration)
        return values_in(nodes)

    @cached_property
    def parameters(self) -> Mapping[str, str]:
        """The texts of the parameters at their nominal values, computed where they are given so."""
        found: dict[str, str] = {}
        for name, text in self.declared.items():
            found[name] = self.text_at(text, found)
        return found

    def text_at(self, text: str, values: Mapping[str, str] | None = None) -> str:
        """Return a text with its parameters at nominal values; itself if it has no value."""
        value = text_value(text, self.parameters if values is None else values)
        return text if value is None else value

    @cached_property
    def reach(self) -> Reach:
        """The folders from which the document may name files."""
        return Reach(self.folder, (*self._folders.maps, *self._folders.catalogs))

    @cached_property
    def refused(self) -> list[tuple[Element, str]]:
        """The elements that name files which the document may not name, with reasons."""
        found: list[tuple[Element, str]] = []
        if self._logic is not None and self.map_file is None:
            found.append((self._logic, self._problem(self._logic, "filepath", self._folders.maps)))
        for node in self.tagged("Directory"):
            found.append((node, self._problem(node, "path", self._folders.catalogs)))
        return [(node, problem) for node, problem in found if problem]

    def _problem(self, node: Element, name: str, folders: Sequence[Path]) -> str:
        named = self.text_at(node.get(name) or "").replace("\\", "/")
        problem = self.reach.problem(named, (self.folder, *folders))
        return f"{name}={named!r} is not read: {problem}" if problem else ""

    # --- catalogs ---------------------------------------------------------------------------------

    def entry(self, reference: Element) -> tuple[Element, Path] | None:
        """Return the entry that a `CatalogReference` names, with its parameters, and its file."""
        key = id(reference)
        if key not in self._instances:
            self._instances[key] = self._instance(reference)
        return self._instances[key]

    def _instance(self, reference: Element) -> tuple[Element, Path] | None:
        if self._entries is None:
            self._entries = self._read_catalogs()
        names = [self.text_at(reference.get(key) or "") for key in ("catalogName", "entryName")]
        found = self._entries.get((names[0], names[1]))
        if found is None:
            return None
        entry, path = found
        given = values_in(reference.below(xml.ParameterAssignment), "parameterRef")
        declared = list(entry.below(xml.ParameterDeclaration))
        self.scoped += [(node, path.name) for node in declared]
        values = values_in(declared) | given
        children = [child for child in entry.children if child.tag != "ParameterDeclarations"]
        bare = entry.with_children(*children)
        return (substituted(bare, values) if values else bare), path

    def _read_catalogs(self) -> dict[tuple[str, str], tuple[Element, Path]]:
        entries: dict[tuple[str, str], tuple[Element, Path]] = {}
        for path in self._catalog_files():
            try:
                root = read(path.read_bytes()) if path.stat().st_size < CATALOG_SIZE else None
            except (OSError, Unreadable):
                continue
            catalog = None if root is None else root.find(xml.Catalog)
            if catalog is None:
                continue
            for entry in catalog.children:
                key = (catalog.get("name") or "", entry.get("name") or "")
                entries.setdefault(key, (entry, path))
        return entries

    def _catalog_files(self) -> list[Path]:
        folders = list(self._folders.catalogs)
        for node in self.tagged("Directory"):
            named = self.text_at(node.get("path") or "").replace("\\", "/")
            if named and not _is_impossible_path(named):
                folders += [base / named for base in (self.folder, *self._folders.catalogs)]
        files: dict[Path, None] = {}
        for folder in folders:
            if not self.reach.holds(folder):
                continue
            if folder.is_file():
                files[folder] = None
            elif folder.is_dir():
                files |= dict.fromkeys(sorted(folder.glob("*.xosc")))
        return [path.resolve() for path in files if self.reach.holds(path)]

    @cached_property
    def resolved(self) -> Element:
        """The document with the entries of catalogs in it, and parameters at nominal values."""
        return self.resolution(self.root)

    def resolution(self, node: Element) -> Element:
        """Return an element with parameters at nominal values, and entries of catalogs in it."""
        if not node.children and not _is_given(node):
            return node
        known = self._resolutions.get(id(node))
        if known is None or known[0] is not node:
            known = self._resolutions[id(node)] = node, self._resolve(node)
        return known[1]

    def _resolve(self, node: Element) -> Element:
        if isinstance(node, xml.CatalogReference) and (found := self.entry(node)) is not None:
            return self.resolution(found[0])
        if _is_given(node):
            texts = {name: self.text_at(text) for name, text in node.attributes}
            node = node.with_attributes(texts)
        return with_each(node, self.resolution)

    def given(self, node: Element, kind: type[Element]) -> Iterator[Element]:
        """Yield the elements of a kind in a part with the entries of catalogs in it, as given."""
        for each in node.walk():
            if isinstance(each, kind):
                yield each
            elif each.tag == "CatalogReference" and (found := self.entry(each)) is not None:
                yield from self.given(found[0], kind)

    # --- the map ----------------------------------------------------------------------------------

    @cached_property
    def _logic(self) -> Element | None:
        network = self.root.find(xml.RoadNetwork)
        return None if network is None else network.find(xml.LogicFile)

    @cached_property
    def map_file(self) -> Path | None:
        """The file of the map; `None` if the document names none, or it is not found."""
        logic = self._logic
        named = "" if logic is None else self.text_at(logic.get("filepath") or "")
        if not named or _is_impossible_path(named):
            return None
        relative = Path(named.replace("\\", "/"))
        for folder in (self.folder, *self._folders.maps):
            for place in (relative, Path(relative.name)):
                for suffix in ("", ".xodr"):
                    candidate = folder / f"{place}{suffix}"
                    if candidate.is_file() and self.reach.holds(candidate):
                        return candidate
        try:
            return find_map(relative.name, self._folders.maps)
        except ScenarioError:
            return None


def _is_given(node: Element) -> bool:
    """Whether an entry of a catalog or parameters give an element or its attributes."""
    for _, text in node.attributes:  # a loop: documents have many of them
        if text.startswith("$"):
            return True
    return isinstance(node, xml.CatalogReference)


def _by_tag(root: Element) -> dict[str, list[Element]]:
    found: dict[str, list[Element]] = {}
    for node in root.walk():
        found.setdefault(node.tag, []).append(node)
    return found


def _is_impossible_path(named: str) -> bool:
    """Whether no file has such a path."""
    return "\0" in named or len(named) > LONGEST_PATH
