"""Jobs: a source file with its settings and import folders."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

from osc2tx.compilation.inputs import Input, find_inputs, is_unicode
from osc2tx.compilation.roots import Roots, innermost
from osc2tx.diagnostics import InternalCompilerError
from osc2tx.support.paths import real_path
from osc2tx_shared.classes import dataclass, replace
from osc2tx_shared.text import visible

if TYPE_CHECKING:
    from osc2tx.compilation.driver import Compilation, Memory
    from osc2tx.config import Config, ConfigFiles, GivenOptions
    from osc2tx.options import CompileOptions
    from osc2tx.support.records import Records

RunTexts: TypeAlias = tuple[tuple[str, tuple[str, ...]], ...]
"""Options of runs as the settings file states them, by name."""


@dataclass(frozen=True, slots=True)
class Job:
    """One source file to compile.

    Attributes:
        path: The file.
        name: How diagnostics and generated files call it.
        options: How to compile it.
        roots: Folders whose files it may import, and to which names are relative.
        is_asked: Whether this very file was named, and not a folder that holds it.
        given: Options that precede those of settings files.
        run: The options of runs that the settings file states for it, as they are written.
    """

    path: Path
    name: str
    options: CompileOptions
    roots: Roots
    is_asked: bool
    given: GivenOptions
    run: RunTexts = ()

    def __hash__(self) -> int:
        """Hash the path, in which jobs differ; the options would take longer."""
        return hash(self.path)

    def compilation(
        self,
        memory: Memory | None = None,
        text: str | None = None,
        unsaved: Mapping[Path, str] | None = None,
        findings: Records | None = None,
    ) -> Compilation:
        """Return its compilation; no stage has run yet.

        Args:
            memory: Facts about imported files, shared with compilations of other jobs.
            text: The text, if it differs from the file.
            unsaved: The texts of imported files that differ from those, by path.
            findings: Findings of earlier builds about documents.
        """
        from osc2tx.compilation.driver import Compilation
        from osc2tx.config import ConfigFiles

        return Compilation(
            self.path,
            self.name,
            self.options,
            roots=self.roots,
            is_trusted=self.is_asked,
            options_of=partial(self.options_of, configs=ConfigFiles()),
            memory=memory,
            text=text,
            unsaved=unsaved or {},
            findings=findings,
        )

    @property
    def libraries(self) -> tuple[Path, ...]:
        """The folders of its libraries, links followed."""
        return tuple(real_path(Path(folder)) for folder in self.options.import_paths)

    def options_of(self, path: Path, configs: ConfigFiles) -> CompileOptions:
        """Return the options for a file that it imports."""
        return options_of(path, self.given, self.roots.settings, configs)

    def for_module_of(self, path: Path, name: str, configs: ConfigFiles) -> Job:
        """Return the job for an imported file whose module the one of this file needs."""
        options = replace(self.options_of(path, configs), target="py")
        return Job(path, name, options, self.roots, is_asked=False, given=self.given)


def options_of(
    path: Path, given: GivenOptions, project: Path | None, configs: ConfigFiles
) -> CompileOptions:
    """Return the options for a file, which need not be among those that were asked for.

    Args:
        path: The file.
        given: Options that precede those of settings files.
        project: The folder of the settings that count for a library that has none of its own.
        configs: The settings files.

    Raises:
        ConfigError: If its settings file is wrong.
    """
    config = configs.for_source(path)
    if config.path is None and project is not None:
        config = configs.for_folder(project)
    return config.options_for(path, given)


def find_jobs(
    paths: Sequence[str | Path], given: GivenOptions, configs: ConfigFiles
) -> tuple[Job, ...]:
    """Return a job for each file that the paths name.

    A file is called, and may import, what its project says, whatever path names it; without
    `sources` in its settings, the folder that was named is the one of the sources.

    Args:
        paths: Files and folders.
        given: Options that precede those of settings files.
        configs: The settings files.

    Raises:
        InputError: If a path does not exist or holds no scenario file.
        ConfigError: If a settings file is wrong.
    """
    follow = cache(real_path)
    jobs: dict[Path, Job] = {}
    for item in find_inputs(paths):
        config = configs.for_source(item.path)
        place = real_source(item, config)
        if place != item.place:
            item = Input(place, place, item.folder, item.is_asked)
        if place not in jobs:
            jobs[place] = job_for(item, given, config, follow)
    return tuple(jobs.values())


def real_source(item: Input, config: Config) -> Path:
    """Return where a source is: a link to another source is that source."""
    if not item.place.is_symlink():
        return item.place
    target = real_path(item.place)
    sources = config.source_folders or (real_path(item.folder),)
    return target if innermost(target, sources) else item.place


def job_for(
    item: Input, given: GivenOptions, config: Config, follow: Callable[[Path], Path] = real_path
) -> Job:
    """Return the job for a file of a project.

    Args:
        item: The file.
        given: Options that precede those of settings files.
        config: The settings of the file.
        follow: Follows links of a folder.
    """
    options = config.options_for(item.path, given)
    libraries = [follow(Path(folder)) for folder in options.import_paths]
    asked = follow(item.folder)
    roots = Roots(config.source_folders or (asked,), config.folder)
    if innermost(item.place, (*roots.sources, *libraries)) is None:
        roots = Roots((asked, *roots.sources), config.folder)
    name = roots.name_of(item.place, libraries) or item.path.name
    name = name if is_unicode(name) else visible(name)
    run = tuple(config.run_settings(item.path).items())
    return Job(item.path, name, options, roots, item.is_asked, given, run)


def job_of_text(name: str, folder: str | Path, given: GivenOptions) -> Job:
    """Return the job of a text that stands for the file `name` of a folder, which need not exist.

    Raises:
        ConfigError: If a settings file is wrong.
    """
    from osc2tx.config import ConfigFiles

    path = Path(folder, name)
    item = Input(path, real_path(path.parent) / path.name, Path(folder), is_asked=True)
    return job_for(item, given, ConfigFiles().for_source(path))


def compile_all(paths: Sequence[str | Path], given: GivenOptions) -> list[Compilation]:
    """Return the compilations of all files that the paths name; no stage has run yet.

    Raises:
        InputError, ConfigError: As `find_jobs`.
    """
    from osc2tx.config import ConfigFiles

    return [job.compilation() for job in find_jobs(paths, given, ConfigFiles())]


def run_all(
    compilations: Sequence[Compilation], stages: Callable[[Compilation], object]
) -> tuple[str, ...]:
    """Run stages on every file; a bug that one file shows does not stop the others.

    Returns:
        The bugs: file and message, for unforeseen ones below their traceback.
    """
    bugs = (find_bug(compilation, stages) for compilation in compilations)
    return tuple(bug for bug in bugs if bug)


def find_bug(
    compilation: Compilation, stages: Callable[[Compilation], object], place: str = ""
) -> str:
    """Run stages on a file; return what mistake of osc2tx itself it shows, if any.

    Args:
        compilation: The file.
        stages: The stages to run.
        place: Description of these stages, if only some of them run.
    """
    told = f"{visible(str(compilation.path))}: internal error{place and f' in {place}'}"
    try:
        stages(compilation)
    except InternalCompilerError as error:
        return f"{told}: {error}"
    except Exception as error:  # an internal error; the other files are compiled all the same
        from traceback import format_exception

        trace = "".join(format_exception(error))
        return f"{trace}{told}: {error!r}"
    return ""
