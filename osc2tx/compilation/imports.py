"""Finds and parses imported files (§7.7.5)."""

from __future__ import annotations

import os
import posixpath
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import lru_cache
from itertools import takewhile
from pathlib import Path
from stat import S_ISLNK
from urllib.parse import unquote, urlsplit

from osc2tx.compilation.roots import Roots
from osc2tx.diagnostics import Diagnostic, DiagnosticSink, SourceFile, Span
from osc2tx.diagnostics.suggestions import nearest
from osc2tx.support.paths import real_path
from osc2tx.syntax import ast, parse, read_source
from osc2tx_shared.classes import dataclass

SUFFIX = ".osc"
LIBRARIES_KEPT = 256  # parsed, by the process
SEPARATORS = frozenset("/\\:")  # on some system


def module_place(module: Sequence[str]) -> Path | None:
    """Return the file of a module below a folder: `a/b.osc` for `a.b`.

    Returns:
        The relative path; `None` if a name of the module cannot be the name of a file, as names
        between bars (`|..|`) can hold anything.
    """
    if not all(map(_is_file_name, module)):
        return None
    return Path(*module[:-1], module[-1] + SUFFIX)


def _is_file_name(name: str) -> bool:
    return name.isprintable() and name[:1] not in ("", ".") and not SEPARATORS & set(name)


def places_text(place: Path, folders: Sequence[Path]) -> str:
    """Return a sentence on the searched folders.

    Args:
        place: Its file, relative to each of the folders.
        folders: Those besides the folder of the importing file, in the order of the search.
    """
    looked = (f"`{folder}`" + ("" if folder.is_dir() else " (no folder)") for folder in folders)
    return f"looked for `{place.as_posix()}` " + ", ".join(["beside this file", *looked])


def similar_module(module: Sequence[str], folders: Sequence[Path]) -> tuple[str, ...] | None:
    """Return the names of the module in the folders that looks most like one, if any does."""
    known = {".".join(found): found for folder in folders for found in _alike(folder, module)}
    close = nearest(".".join(module), known)
    return known[close] if close else None


def _alike(folder: Path, module: Sequence[str]) -> Iterator[tuple[str, ...]]:
    """Yield the modules in the folder that the names lead to if each may be misspelt."""
    names: list[str] = []
    for name in module[:-1]:
        found = nearest(name, _entries(folder, is_folder=True))
        if found is None:
            return
        folder /= found
        names.append(found)
    for last in _entries(folder, is_folder=False):
        yield (*names, last)


def _entries(folder: Path, *, is_folder: bool) -> list[str]:
    """Return the folders in a folder, or its modules; no links, nothing if it is unreadable."""
    try:
        with os.scandir(folder) as entries:
            found = [
                entry.name
                for entry in entries
                if (entry.is_dir if is_folder else entry.is_file)(follow_symlinks=False)
            ]
    except OSError:
        return []
    if not is_folder:
        found = [name.removesuffix(SUFFIX) for name in found if name.endswith(SUFFIX)]
    return [name for name in found if _is_file_name(name)]


@dataclass(frozen=True, slots=True)
class Lookup:
    """The search result at a possible path of an imported file.

    Attributes:
        path: The place, links followed; empty if no file can have such a name.
        text: The content of the file; `None` if it was not read.
        is_refused: Whether a file may exist that was not read, or could not be.
    """

    path: str
    text: str | None = None
    is_refused: bool = False


class ImportLoader:
    """Turns an import statement into the syntax tree of the named file.

    A scenario is untrusted text, so it must not make the compiler read every file that its user can
    read: only files below the given folders are opened, and links are followed before a path is
    checked. A rejection is reported here and gives an empty tree; `None` means that there is
    no such file, which the caller reports.

    Attributes:
        lookups: All paths that were searched; the product depends on their contents.
    """

    def __init__(
        self,
        path: Path,
        name: str,
        roots: Roots,
        sink: DiagnosticSink,
        relaxed: Collection[str],
        import_paths: Sequence[Path] = (),
        unsaved: Mapping[Path, str] | None = None,
    ) -> None:
        """Take the surroundings of the root file.

        Args:
            path: The root file.
            name: Its name; imported files outside of all folders are named relative to
                the same folder.
            roots: Folders whose files may be imported, besides that of the file.
            sink: Receives diagnostics.
            relaxed: Deviations from the grammar that the dialect allows.
            import_paths: Further such folders, which are searched last.
            unsaved: Texts that replace files, by path with links followed.
        """
        self._folder = real_path(path).parent
        self._prefix = posixpath.dirname(name)
        libraries = (Path(os.path.abspath(each)) for each in import_paths)  # a link may be changed
        self._named_from = (*map(real_path, roots), *libraries)
        self._search = tuple(dict.fromkeys((self._folder, *self._named_from)))
        self._real = {root: real_path(root) for root in self._search}
        self._named = Roots(tuple(map(real_path, roots.sources)), roots.settings)
        self._libraries = tuple(map(real_path, import_paths))
        self._sink = sink
        self._relaxed = relaxed
        self._unsaved = unsaved or {}
        self._parsed: dict[Path, ast.File] = {}
        self._read: dict[Path, Lookup] = {}
        self._real_folders: dict[Path, Path] = {}
        self.lookups: dict[Path, Lookup] = {}

    def __call__(self, statement: ast.Import, source: SourceFile) -> ast.File | None:
        """Return the tree of the imported file.

        Args:
            statement: The import.
            source: The file that contains it.
        """
        if source.path is None:
            return None
        folder = self._real_path(source.path).parent
        if statement.uri is None:
            return self._module(statement, folder)
        path = _local_path(statement.uri)
        if path is None:
            return self._refuse(statement, f"`{statement.uri}` is no local file", None)
        plain, decoded = folder / path, folder / unquote(path)
        found = self._open(statement, plain, statement.uri)
        if found is None and decoded != plain:
            found = self._open(statement, decoded, statement.uri)
        return found

    def _module(self, statement: ast.Import, folder: Path) -> ast.File | None:
        """Search `a.b` beside the importing file, then in the roots; the first one counts."""
        place, written = module_place(statement.module), ".".join(statement.module)
        if place is None:
            advice = 'to import a file by its path write `import "lib/cars.osc"`'
            return self._refuse(statement, f"`{written}` is not a name of a module", advice)
        for start in (folder, *self._search):
            found = self._open(statement, start / place, written)
            if found is not None:
                return found
        return None

    def help_for(self, statement: ast.Import) -> str | None:
        """Return the help for a module that is not found."""
        place, source = module_place(statement.module), statement.span.source
        if place is None or source.path is None:
            return None
        own = real_path(source.path).parent
        folders = (own, *(folder for folder in self._search if folder != own))
        looked = places_text(place, folders[1:])
        similar = similar_module(statement.module, folders)
        near = similar and module_place(similar)
        if not similar or not near:
            return looked
        self.lookups |= {folder / near: look_up(folder / near) for folder in folders}
        return f"did you mean `{'.'.join(similar)}`? {looked}"

    def _open(self, statement: ast.Import, path: Path, written: str) -> ast.File | None:
        asked = path
        try:
            path = self._real_path(path)
            allowed = any(path.is_relative_to(root) for root in self._real.values())
            if allowed and path not in self._unsaved and not path.exists():
                self.lookups[asked] = Lookup(str(path))
                return None
        except (OSError, ValueError):  # a name that no file can have
            self.lookups[asked] = Lookup("")
            return None
        if not allowed:
            self.lookups[asked] = Lookup(str(path), is_refused=True)
            return self._refuse(
                statement,
                f"`{written}` is outside of the folders for imports",
                "name the folder that holds both files, put an `osc2tx.toml` there, or name that of"
                " the library with `-I` or in `import_paths`",
            )
        if path not in self._parsed:
            self._parsed[path] = self._parse(statement, path)
        self.lookups[asked] = self._read[path]
        return self._parsed[path]

    def _real_path(self, path: Path) -> Path:
        """Return the path without links; folders of many imports are followed once."""
        try:
            is_plain = path.name not in ("", "..") and not S_ISLNK(path.lstat().st_mode)
        except OSError:  # there is none
            is_plain = path.name not in ("", "..")
        if not is_plain:
            return real_path(path)
        if path.parent not in self._real_folders:
            self._real_folders[path.parent] = real_path(path.parent)
        return self._real_folders[path.parent] / path.name

    def _parse(self, statement: ast.Import, path: Path) -> ast.File:
        name, found = self._name_of(path), DiagnosticSink()
        if path in self._unsaved:
            source: SourceFile | None = SourceFile(name, self._unsaved[path], path)
        else:
            source = read_source(path, name, found)
        if source is not None:
            self._read[path] = Lookup(str(path), source.text)
            file, reports = _parsed(name, source.text, path, frozenset(self._relaxed))
            self._sink.add(reports)
            return file
        self._read[path] = Lookup(str(path), is_refused=True)
        for report in found.sorted():
            self._sink.report(report.code, statement.span, report.message, help=report.help)
        return _nothing(statement)

    def _name_of(self, path: Path) -> str:
        """Return the name of an imported file.

        A file that is hidden by one of the same name in an earlier folder is named by its relative
        path from the root file: no module can import it.
        """
        root = self._named.root_of(path, self._libraries)
        if root is not None:
            relative = path.relative_to(root)
            before = takewhile(lambda each: self._real[each] != root, self._named_from)
            others = [each / relative for each in before]
            self.lookups |= {other: look_up(other) for other in others}
            if not any(self.lookups[other].text is not None for other in others):
                return relative.as_posix()
        relative = Path(os.path.relpath(path, self._folder))
        return posixpath.normpath(posixpath.join(self._prefix, relative.as_posix()))

    def _refuse(self, statement: ast.Import, message: str, help: str | None) -> ast.File:
        self._sink.report("OSC205", statement.span, message, help=help)
        return _nothing(statement)


@lru_cache(maxsize=LIBRARIES_KEPT)
def _parsed(
    name: str, text: str, path: Path, allow: frozenset[str]
) -> tuple[ast.File, tuple[Diagnostic, ...]]:
    """Return the tree of a library and its diagnostics; many files import the same ones.

    Its comments travel to its own module, and to none of a file that imports it: an edit of them
    changes nothing there.
    """
    found = DiagnosticSink()
    source = SourceFile(name, text, path)
    return parse(source, found, allow=allow, with_comments=False), found.sorted()


def _nothing(statement: ast.Import) -> ast.File:
    source = SourceFile(f"<{statement.span}>", "")
    return ast.File(span=Span(source, 0, 0), imports=(), statements=())


def _local_path(uri: str) -> str | None:
    """Return the path in a URI reference; `None` if it names no file of this machine."""
    try:
        parts = urlsplit(uri)
    except ValueError:
        return uri
    if parts.scheme == "file":
        return parts.path if parts.netloc in ("", "localhost") else None
    if len(parts.scheme) > 1 and "://" in uri:  # one letter is a drive
        return None
    return uri


def look_up(place: Path) -> Lookup:
    """Return the content of a path, for a file that is no scenario."""
    try:
        path = real_path(place)
        return Lookup(str(path), path.read_text(encoding="utf-8"))
    except (FileNotFoundError, NotADirectoryError):
        return Lookup(str(path))
    except (OSError, ValueError):
        return Lookup("", is_refused=True)


def leads_outside(path: Path, folders: Sequence[Path]) -> bool:
    """Return whether a file is a link to something that is in none of the folders."""
    if not path.is_symlink():
        return False
    try:
        target = real_path(path)
    except (OSError, RuntimeError):  # a link to itself is for the reader to report
        return False
    return not any(target.is_relative_to(real_path(folder)) for folder in folders)
