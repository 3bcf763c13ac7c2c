"""Differences of outputs that a change of the sources causes."""

from __future__ import annotations

import os
import subprocess
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from difflib import unified_diff
from itertools import count
from pathlib import Path, PurePosixPath

from osc2tx.building.jobs import Job, find_jobs
from osc2tx.building.plan import place_outputs
from osc2tx.building.results import FileResult
from osc2tx.building.workers import compile_jobs, with_siblings
from osc2tx.compilation.inputs import InputError
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import Severity
from osc2tx.support.paths import real_path
from osc2tx_shared.classes import dataclass, replace

SETTINGS = ("osc2tx.toml", "pyproject.toml")
LINK = "120000"


@contextmanager
def checked_out(
    paths: Sequence[str | Path], revision: str, import_paths: Sequence[str]
) -> Iterator[tuple[list[Path], tuple[str, ...]]]:
    """Lay out scenario and settings files of a revision; yield where paths and libraries are.

    Nothing of the repository's own folder is touched, and no command of its settings is run: the
    files are read as git stores them.

    Args:
        paths: Files and folders as they are named today; those that the revision does not have
            are left out.
        revision: A commit, in any way git understands.
        import_paths: Folders with libraries; those outside of the repository stay what they are.

    Raises:
        InputError: If the paths are in no repository, or it has no such revision.
    """
    root = _repository(paths)
    commit = _git(
        root,
        "rev-parse",
        "--verify",
        "--quiet",
        "--end-of-options",
        f"{revision}^{{commit}}",
        failure=f"git knows no revision {revision!r}",
    )
    with tempfile.TemporaryDirectory(prefix="osc2tx-revision-") as folder:
        top = Path(os.path.realpath(folder))
        _lay_out(root, commit.decode().strip(), top)
        inside = [top / _place(path).relative_to(root) for path in paths]
        libraries = [(str(path), _place(path)) for path in import_paths]
        yield (
            [path for path in inside if path.exists() and _has_source(path)],
            tuple(
                str(top / place.relative_to(root)) if place.is_relative_to(root) else written
                for written, place in libraries
            ),
        )


def _has_source(path: Path) -> bool:
    return path.is_file() or any(path.rglob("*.osc"))


def _repository(paths: Sequence[str | Path]) -> Path:
    place = _place(paths[0])
    start = place if place.is_dir() else place.parent
    found = _git(start, "rev-parse", "--show-toplevel", failure=f"{start}: is in no git repository")
    root = Path(os.path.realpath(found.decode().rstrip("\n")))
    for path in paths:
        if not _place(path).is_relative_to(root):
            raise InputError(f"{path}: is not in the repository {root}", unreadable=False)
    return root


def _place(path: str | Path) -> Path:
    """Return the absolute path; a link stays a link, as it does in the repository."""
    path = Path(path)
    return Path(os.path.realpath(path.parent), path.name) if path.name else real_path(path)


def _lay_out(root: Path, commit: str, top: Path) -> None:
    """Write the files that a build may read."""
    listing = _git(root, "ls-tree", "-r", "-z", "--full-tree", commit)
    names, hashes, links = [], [], []
    for line in listing.decode("utf-8", "surrogateescape").split("\0"):
        head, _, name = line.partition("\t")
        place = PurePosixPath(name)
        if place.suffix != ".osc" and place.name not in SETTINGS:
            continue
        mode, kind, blob = head.split(" ")
        if kind == "blob":
            names.append(name)
            hashes.append(blob)
            links.append(mode == LINK)
    contents = _blobs(root, hashes)
    for name, is_link, data in zip(names, links, contents, strict=True):
        target = top / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if is_link:
            os.symlink(os.fsdecode(data), target)
        else:
            target.write_bytes(data)


def _blobs(root: Path, hashes: Sequence[str]) -> Iterator[bytes]:
    """Yield the contents of objects, as `git cat-file --batch` writes them."""
    text = _git(root, "cat-file", "--batch", stdin="\n".join(hashes).encode() + b"\n")
    start = 0
    for _ in hashes:
        end = text.index(b"\n", start)
        size = int(text[start:end].split(b" ")[2])
        yield text[end + 1 : end + 1 + size]
        start = end + 1 + size + 1


def _git(folder: Path, *arguments: str, stdin: bytes = b"", failure: str = "") -> bytes:
    try:
        ended = subprocess.run(
            ["git", "-C", str(folder), *arguments], input=stdin, capture_output=True, check=False
        )
    except FileNotFoundError:
        raise InputError("--diff-against needs git, and there is none", unreadable=False) from None
    if ended.returncode:
        reason = failure or ended.stderr.decode(errors="replace").strip()
        raise InputError(reason, unreadable=False)
    return ended.stdout


def diff_lines(path: str, old: str | None, new: str | None) -> Iterator[str]:
    """Yield the lines of a diff as git writes it; `None` stands for no file."""
    path = path.lstrip("/")
    yield from (
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
        for line in unified_diff(
            _lines(old),
            _lines(new),
            "/dev/null" if old is None else f"a/{path}",
            "/dev/null" if new is None else f"b/{path}",
        )
    )


def _lines(text: str | None) -> list[str]:
    """Return lines with their ends; only a line feed ends one, unlike in `splitlines`."""
    lines = (text or "").split("\n")
    last = lines.pop()
    return [f"{line}\n" for line in lines] + ([last] if last else [])


@dataclass(frozen=True, slots=True)
class Difference:
    """An output that is not what it was; `None` where there is no such file."""

    path: str
    old: str | None
    new: str | None


@dataclass(frozen=True, slots=True)
class Comparison:
    """The outputs of two states of the sources.

    Attributes:
        results: What came of the sources of today.
        differences: The outputs that differ, in order.
        problems: What keeps outputs from being compared, a sentence each.
        bugs: Mistakes of osc2tx itself.
    """

    results: tuple[FileResult, ...]
    differences: tuple[Difference, ...]
    problems: tuple[str, ...]
    bugs: tuple[str, ...]


def compare_with(
    revision: str,
    paths: Sequence[str | Path],
    given: GivenOptions,
    *,
    workers: int,
    progress: Callable[[int, int], None] = lambda done, total: None,
) -> Comparison:
    """Compile the sources of a revision and those of today, with the settings of each.

    Args:
        revision: A commit, in any way git understands.
        paths: Files and folders of today.
        given: Options that go before those of settings files, in both.
        workers: How many processes may compile.
        progress: Is told how many of how many files are compiled.

    Raises:
        InputError, ConfigError: If either cannot be read.
    """

    def compile_more(jobs: Sequence[Job]) -> list[FileResult]:
        return compile_jobs(jobs, workers)

    new_jobs = find_jobs(paths, given, ConfigFiles())
    libraries = given.import_paths or ()
    with checked_out(paths, revision, libraries) as (old_paths, old_libraries):
        old_given = replace(given, import_paths=old_libraries or None)
        old_jobs = find_jobs(old_paths, old_given, ConfigFiles())
        jobs = (*old_jobs, *new_jobs)
        numbers = count(1)
        results = compile_jobs(jobs, workers, lambda _: progress(next(numbers), len(jobs)))
        old, new = results[: len(old_jobs)], results[len(old_jobs) :]
        old_texts, _ = _texts(
            with_siblings(old, lambda more: compile_jobs(more, workers), ConfigFiles())
        )
    new_texts, problems = _texts(
        with_siblings(new, lambda more: compile_jobs(more, workers), ConfigFiles())
    )
    problems += [
        f"{revision}: {result.job.name} has errors and makes nothing"
        for result in old
        if any(report.severity is Severity.ERROR for report in result.reports)
    ]
    differences = [
        Difference(path, old_texts.get(path), new_texts.get(path))
        for path in sorted(old_texts | new_texts)
        if old_texts.get(path) != new_texts.get(path)
    ]
    return Comparison(
        results=tuple(new),
        differences=tuple(differences),
        problems=tuple(problems),
        bugs=tuple(result.bug for result in results if result.bug),
    )


def _texts(results: Sequence[FileResult]) -> tuple[dict[str, str], list[str]]:
    placed, problems = place_outputs(results)
    texts = {
        item.path: item.made.text
        for item in placed
        if item.is_committed and item.made.text is not None
    }
    return texts, problems
