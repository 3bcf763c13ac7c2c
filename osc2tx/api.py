"""The library: compile a file or a text from a program of your own.

>>> from osc2tx import compile_text
>>> result = compile_text('''
... import osc.standard
...
... scenario cruise:
...     ego: vehicle
...     do serial:
...         ego.drive(duration: 3s) with:
...             speed(30kph)
... ''', name="cruise.osc")
>>> result.ok, sorted(result.outputs)
(True, ['cruise.map.json', 'cruise.py', 'cruise.xosc'])
>>> "class Cruise(Scenario):" in result.python
True
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TypedDict, Unpack

from osc2tx.building.fixing import fix_text
from osc2tx.building.jobs import find_jobs, job_of_text
from osc2tx.building.ownership import beside
from osc2tx.compilation.driver import Compilation
from osc2tx.compilation.inputs import InputError
from osc2tx.compilation.needed_modules import sibling_modules
from osc2tx.compilation.products import files_of_module
from osc2tx.config import COMPILE_SETTINGS, ConfigFiles, GivenOptions
from osc2tx.diagnostics import Diagnostic, Severity
from osc2tx.options import Dialect, OneOfPolicy, Standard, Target, XmlProfile, XmlVersion
from osc2tx.support.paths import MODULE
from osc2tx_shared.classes import dataclass

__all__ = [
    "CheckResult",
    "CompileResult",
    "apply_fixes",
    "check_text",
    "compile_file",
    "compile_text",
]

_CHOICES = {setting.key: setting.choices for setting in COMPILE_SETTINGS}


@dataclass(frozen=True, slots=True)
class CompileResult:
    """The outcome of one source.

    Attributes:
        name: Name of the source in diagnostics and generated files.
        diagnostics: Reports without those that a comment suppresses, in order of position.
        outputs: Names of files to their contents: the module, the map of its nodes to lines of the
            source, and for each scenario OpenSCENARIO XML, if XML can express it, and the report on
            constructs that are not exact; then the modules of imported files that the module
            needs. Empty for a source with errors, or without scenarios.
        levels: Scenario to `abstract`, `logical` or `concrete` (§5.2).
        python: The py_trees module; `None` if there is none.
    """

    name: str
    diagnostics: tuple[Diagnostic, ...]
    outputs: Mapping[str, str]
    levels: Mapping[str, str]
    python: str | None

    @property
    def ok(self) -> bool:
        """Whether there are no errors; warnings are fine."""
        return _has_no_error(self.diagnostics)

    @property
    def xml(self) -> str | None:
        """The OpenSCENARIO XML of the first scenario that has some; `None` if none has."""
        made = (n for n in self.outputs if n.endswith(".xosc") and ".params." not in n)
        return next((self.outputs[name] for name in made), None)

    def write(self, folder: str | Path) -> list[Path]:
        """Write all outputs into a folder, which is made when needed; return their paths.

        Raises:
            OSError: If a file cannot be written.
        """
        place = Path(folder)
        for name, text in self.outputs.items():
            (place / name).parent.mkdir(parents=True, exist_ok=True)
            (place / name).write_text(text, encoding="utf-8", newline="\n")
        return [place / name for name in self.outputs]


@dataclass(frozen=True, slots=True)
class CheckResult:
    """The result of a check.

    Attributes:
        name: Name of the source in diagnostics.
        diagnostics: Reports without those that a comment suppresses, in order of position.
        levels: Scenario to `abstract`, `logical` or `concrete` (§5.2).
    """

    name: str
    diagnostics: tuple[Diagnostic, ...]
    levels: Mapping[str, str]

    @property
    def ok(self) -> bool:
        """Whether there are no errors; warnings are fine."""
        return _has_no_error(self.diagnostics)


def _has_no_error(found: Iterable[Diagnostic]) -> bool:
    return all(each.severity is not Severity.ERROR for each in found)


class Options(TypedDict, total=False):
    """Compile options; open ones come from settings files, then from the defaults.

    Attributes:
        std: Version of the standard.
        dialect: Dialect of the source.
        one_of: Meaning of `one_of`.
        target: The outputs.
        xml_version: Version of OpenSCENARIO XML.
        xml_profile: Tool that is to read the XML.
        allow_approx: Whether XML may be approximated.
        import_paths: Folders with libraries, which are searched after the project.
        verify: Whether XML is played, to measure its grades.
    """

    std: Standard | None
    dialect: Dialect | None
    one_of: OneOfPolicy | None
    target: Target | None
    xml_version: XmlVersion | None
    xml_profile: XmlProfile | None
    allow_approx: bool | None
    import_paths: tuple[str, ...] | None
    verify: bool | None


def compile_file(
    path: str | Path,
    **options: Unpack[Options],
) -> CompileResult:
    """Compile a scenario file as `osc2tx build` does, without writing anything.

    The file may import from its folder and from that of the settings file, the nearest
    `osc2tx.toml` or `pyproject.toml`.

    Args:
        path: The file.
        **options: See `Options`.

    Raises:
        InputError: If there is no such file.
        TypeError, ValueError: If there is no such option, or no such value of it.
        ConfigError: If a settings file is wrong.
    """
    if Path(path).is_dir():
        raise InputError(f"{path}: is a folder; name one scenario file")
    (job,) = find_jobs([path], _given(options), ConfigFiles())
    return _result(job.compilation())


def compile_text(
    text: str,
    *,
    name: str = "scenario.osc",
    folder: str | Path = ".",
    **options: Unpack[Options],
) -> CompileResult:
    """Compile a text as if it were the file `name` of a folder; that file need not exist.

    Examples:
        >>> from osc2tx import compile_text
        >>> (found,) = compile_text("actor car inherits vehicel").diagnostics
        >>> found.code, found.primary.line, found.primary.column
        ('OSC202', 1, 20)

    Args:
        text: The text.
        name: Its name in diagnostics and generated files.
        folder: Folder of imported files, from which settings files are searched upward.
        **options: See `Options`.

    Raises:
        TypeError, ValueError: If there is no such option, or no such value of it.
        ConfigError: If a settings file is wrong.
    """
    job = job_of_text(name, folder, _given(options))
    return _result(job.compilation(text=text))


def check_text(
    text: str,
    *,
    name: str = "scenario.osc",
    folder: str | Path = ".",
    **options: Unpack[Options],
) -> CheckResult:
    r"""Check a text as `osc2tx check` does; no outputs are written, which is several times faster.

    Examples:
        >>> from osc2tx import apply_fixes, check_text
        >>> text = "import osc.standard\n\nactor tram inherits vehicel\n"
        >>> result = check_text(text)
        >>> result.ok, result.diagnostics[0].fixes[0].title
        (False, 'write `vehicle`')
        >>> check_text(apply_fixes(text, unsafe=True)).ok
        True

    Args:
        text: The text.
        name: Its name in diagnostics.
        folder: Folder of imported files, from which settings files are searched upward.
        **options: See `Options`.

    Raises:
        TypeError, ValueError: If there is no such option, or no such value of it.
        ConfigError: If a settings file is wrong.
    """
    compilation = job_of_text(name, folder, _given(options)).compilation(text=text)
    compilation.check()
    return CheckResult(
        name=compilation.name,
        diagnostics=compilation.diagnostics,
        levels={entry.name: entry.level for entry in compilation.scenarios},
    )


def apply_fixes(
    text: str,
    *,
    unsafe: bool = False,
    name: str = "scenario.osc",
    folder: str | Path = ".",
    **options: Unpack[Options],
) -> str:
    """Return a text with the fixes of its diagnostics, as `osc2tx check --fix` applies them.

    Args:
        text: The text.
        unsafe: Whether to apply also fixes whose result the author may not have meant.
        name: As for `check_text`.
        folder: As for `check_text`.
        **options: See `Options`.

    Raises:
        TypeError, ValueError: If there is no such option, or no such value of it.
        ConfigError: If a settings file is wrong.
    """
    job = job_of_text(name, folder, _given(options))
    return fix_text(job, text, unsafe=unsafe).text


def _given(options: Options) -> GivenOptions:
    """Return options after a check of their names and values, as a settings file has it."""
    for name, value in options.items():
        if name not in Options.__annotations__:
            known = ", ".join(Options.__annotations__)
            raise TypeError(f"there is no option `{name}`; known options: {known}")
        choices = _CHOICES.get(name)
        if value is not None and choices and value not in choices:
            raise ValueError(f"{name} is {value!r}: write {' or '.join(map(repr, choices))}")
    return GivenOptions(**options)


def _result(compilation: Compilation) -> CompileResult:
    outputs = {
        f"{compilation.stem}{output.suffix}": output.text for output in compilation.outputs()
    }
    for sibling in sibling_modules(compilation):
        for output in files_of_module(sibling):
            outputs[beside(sibling.source, f"{sibling.stem}{output.suffix}")] = output.text
    return CompileResult(
        name=compilation.name,
        diagnostics=compilation.diagnostics,
        outputs=outputs,
        levels={entry.name: entry.level for entry in compilation.scenarios},
        python=outputs.get(f"{compilation.stem}{MODULE}"),
    )
