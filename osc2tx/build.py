"""`osc2tx build`: files and folders in, a tree of modules out.

Every source file that declares a scenario gives `NAME.py` and its map `NAME.map.json`; the layout
of the sources is mirrored. A file with errors does not stop the others. Outputs appear whole or
not at all, and those that are up to date are not touched.
"""

from __future__ import annotations

import os
import tempfile
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from traceback import format_exception

from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import InternalCompilerError
from osc2tx.driver import Compilation
from osc2tx.inputs import find_inputs


@dataclass(frozen=True, slots=True)
class Output:
    """One file to write."""

    path: Path
    text: str

    @property
    def state(self) -> str:
        """`current`, `missing` or `stale`."""
        try:
            present = self.path.read_bytes()
        except (FileNotFoundError, NotADirectoryError):
            return "missing"
        return "current" if present == self.text.encode() else "stale"

    def write(self) -> None:
        """Put the file in place in one step."""
        folder = self.path.parent
        folder.mkdir(parents=True, exist_ok=True)
        descriptor, temporary = tempfile.mkstemp(dir=folder, prefix=f".{self.path.name}.")
        try:
            with os.fdopen(descriptor, "wb") as file:
                file.write(self.text.encode())
            os.chmod(temporary, _mode(self.path))
            os.replace(temporary, self.path)
        except OSError:
            Path(temporary).unlink(missing_ok=True)
            raise


def _mode(path: Path) -> int:
    """Return the permissions that a plain `open` would have given the file."""
    if path.exists():
        return path.stat().st_mode & 0o777
    mask = os.umask(0)
    os.umask(mask)
    return 0o666 & ~mask


@dataclass(frozen=True, slots=True)
class BuildResult:
    """What a build did, or with `check_only` what it would do.

    Attributes:
        compilations: One for each source file, in order.
        modules: How many modules the sources make.
        changed: Outputs that were missing or stale, in order.
        bugs: Mistakes of osc2tx itself, as `run_all`; their sources make no module.
        collisions: Outputs that several sources make, a sentence each; none of them is written.
        failures: Outputs that could not be written, a sentence each.
    """

    compilations: tuple[Compilation, ...]
    modules: int
    changed: tuple[tuple[str, Path], ...]
    bugs: tuple[str, ...]
    collisions: tuple[str, ...]
    failures: tuple[str, ...]


def compile_all(paths: Sequence[str | Path], given: GivenOptions) -> list[Compilation]:
    """Return the compilations of all files that the paths name; no stage has run yet.

    A file may import what lies in the folder that was named, and what lies in that of its
    settings file.

    Raises:
        InputError: If a path does not exist or holds no scenario file.
        ConfigError: If a settings file is wrong.
    """
    configs = ConfigFiles()
    compilations = []
    for item in find_inputs(paths):
        config = configs.for_source(item.path)
        options = config.options_for(item.path, given)
        roots = (item.folder, *config.roots)
        compilations.append(Compilation(item.path, item.name, options, roots=roots))
    return compilations


def run_all(
    compilations: Sequence[Compilation], stages: Callable[[Compilation], object]
) -> tuple[str, ...]:
    """Run stages on every file; a bug that one file shows does not stop the others.

    Returns:
        The bugs: file and message, for unforeseen ones below their traceback.
    """
    bugs = []
    for compilation in compilations:
        try:
            stages(compilation)
        except InternalCompilerError as error:
            bugs.append(f"{compilation.path}: internal error: {error}")
        except Exception as error:  # whatever it is, it is ours, and the other files need not wait
            trace = "".join(format_exception(error))
            bugs.append(f"{trace}{compilation.path}: internal error: {error!r}")
    return tuple(bugs)


def build(
    paths: Sequence[str | Path],
    out_dir: Path,
    given: GivenOptions,
    *,
    check_only: bool = False,
) -> BuildResult:
    """Compile sources and write the modules they make.

    Args:
        paths: Files and folders.
        out_dir: Folder of the outputs; made when needed.
        given: Options that go before those of settings files.
        check_only: Write nothing, only find out what would change.

    Raises:
        InputError, ConfigError: As `compile_all`.
    """
    compilations = compile_all(paths, given)
    plan: dict[Path, list[Compilation]] = defaultdict(list)

    def make_module(compilation: Compilation) -> None:
        if compilation.module is not None:
            place = PurePosixPath(compilation.name).with_name(f"{compilation.module.stem}.py")
            plan[out_dir / place].append(compilation)

    bugs = run_all(compilations, make_module)
    collisions = [_collision(path, rivals) for path, rivals in plan.items() if len(rivals) > 1]
    changed, failures = [], []
    for output in _outputs(plan):
        try:
            if (state := output.state) != "current":
                changed.append((state, output.path))
                if not check_only:
                    output.write()
        except OSError as error:
            failures.append(f"{output.path}: cannot be written: {error.strerror}")
    return BuildResult(
        compilations=tuple(compilations),
        modules=len(plan) - len(collisions),
        changed=tuple(changed),
        bugs=bugs,
        collisions=tuple(collisions),
        failures=tuple(failures),
    )


def _outputs(plan: Mapping[Path, Sequence[Compilation]]) -> list[Output]:
    outputs = []
    for path, (compilation, *rivals) in plan.items():
        if compilation.module is not None and not rivals:
            outputs.append(Output(path, compilation.module.python))
            outputs.append(Output(path.with_suffix(".map.json"), compilation.module.source_map))
    return outputs


def _collision(path: Path, rivals: Sequence[Compilation]) -> str:
    names = " and ".join(str(rival.path) for rival in rivals)
    return f"{path}: {names} make the same module; rename one of them"
