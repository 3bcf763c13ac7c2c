"""Small projects to build."""

import shutil
from collections.abc import Sequence
from pathlib import Path

from osc2tx.building import build as module
from osc2tx.building.build import BuildOptions, BuildResult
from osc2tx.config import GivenOptions

DRIVE = """import osc.standard

scenario {name}:
  ego: vehicle
  do serial:
    ego.drive(duration: 5s) with:
      speed({speed}kph)
"""


MODULES = GivenOptions(target="py")  # the tests are about files, whatever is in them


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def drive(path: Path, name: str = "top", head: str = "", speed: int = 30) -> Path:
    return write(path, head + DRIVE.format(name=name, speed=speed))


def listing(folder: Path) -> list[str]:
    """Return the files of a folder without what osc2tx notes about them."""
    files = (path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.is_file())
    return sorted(name for name in files if not name.startswith(".osc2tx"))


def contents(folder: Path) -> dict[str, bytes]:
    """Return all files of a folder."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


class Project:
    """A folder `in` of sources and a folder `out` of outputs."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.sources = folder / "in"
        self.out = folder / "out"
        self.compiled: list[str] = []

    def drive(self, name: str, speed: int = 30, head: str = "") -> Path:
        return drive(self.sources / name, speed=speed, head=head)

    def build(
        self,
        *paths: Path,
        given: GivenOptions | None = None,
        check_only: bool = False,
        force: bool = False,
        prune: bool = False,
        workers: int = 1,
        want_texts: bool = False,
    ) -> BuildResult:
        options = BuildOptions(
            check_only=check_only,
            force=force,
            prune=prune,
            workers=workers,
            want_texts=want_texts,
        )
        given = (given or GivenOptions()).over(MODULES)
        return module.build(paths or [self.sources], self.out, given, options)

    def check(self, *paths: Path) -> list[str]:
        """Return what is wrong with the outputs."""
        changes = self.build(*paths, check_only=True).changes
        return [
            f"{change.path.relative_to(self.out).as_posix()} {change.state.value}"
            for change in changes
        ]

    def written(self, result: BuildResult) -> list[str]:
        return [path.relative_to(self.out).as_posix() for path in result.written]

    def copy(self, folder: Path) -> "Project":
        shutil.copytree(self.folder, folder)
        return Project(folder)


def names(paths: Sequence[Path]) -> list[str]:
    return [path.name for path in paths]
