"""Settings from files: `[tool.osc2tx]` in `pyproject.toml`, or `osc2tx.toml`.

The file nearest to the source, upward, is the one that counts; in one folder `osc2tx.toml` goes
before `pyproject.toml`. What the command line says beats what a file says.

    std = "2.1"
    [scenarios.hello_world]        # for hello_world.osc and its module
    dialect = "carla"
    [scenarios.hello_world.run]    # run options, written as on the command line
    signal = ["go_signal@1s"]
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from osc2tx.diagnostics.nearest import did_you_mean
from osc2tx.options import DIALECTS, ONE_OF_POLICIES, STANDARDS, CompileOptions

COMPILE_KEYS: Mapping[str, Sequence[str]] = {
    "std": STANDARDS,
    "dialect": DIALECTS,
    "one_of": ONE_OF_POLICIES,
}
RUN_LISTS = ("map-path", "signal", "spawn", "destination", "set")
RUN_VALUES = ("seed", "dt", "max-time")


class ConfigError(Exception):
    """A settings file that cannot be used; the message names file and key."""


@dataclass(frozen=True, slots=True)
class GivenOptions:
    """Compile options as far as one place states them; `None` leaves the choice to others."""

    std: str | None = None
    dialect: str | None = None
    one_of: str | None = None

    def over(self, other: GivenOptions) -> GivenOptions:
        """Return these options, with those of `other` where nothing is stated here."""
        return GivenOptions(
            std=self.std or other.std,
            dialect=self.dialect or other.dialect,
            one_of=self.one_of or other.one_of,
        )

    def complete(self) -> CompileOptions:
        """Return the options with the defaults for what nobody stated."""
        stated = {"standard": self.std, "dialect": self.dialect, "one_of": self.one_of}
        values: dict[str, Any] = {key: value for key, value in stated.items() if value is not None}
        return CompileOptions(**values)


@dataclass(frozen=True, slots=True)
class ScenarioConfig:
    """The table of one scenario file.

    Attributes:
        options: Compile options of this file.
        run: Run option to what is written for it, in the syntax of the command line.
    """

    options: GivenOptions = GivenOptions()
    run: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Config:
    """What a settings file says.

    Attributes:
        path: The file; `None` if there is none and all is default.
        options: Compile options for all files.
        scenarios: Tables of single files, by the stem of the file name.
    """

    path: Path | None = None
    options: GivenOptions = GivenOptions()
    scenarios: Mapping[str, ScenarioConfig] = field(default_factory=dict)

    @property
    def roots(self) -> tuple[Path, ...]:
        """The folder that the file stands for: all in it belongs to one project."""
        return (self.path.parent,) if self.path else ()

    def options_for(self, source: Path, given: GivenOptions) -> CompileOptions:
        """Return the options for a file: the command line, then its table, then the file's."""
        table = self.scenarios.get(source.stem, ScenarioConfig())
        return given.over(table.options).over(self.options).complete()

    def run_settings(self, source: Path) -> Mapping[str, tuple[str, ...]]:
        """Return the run options of a file."""
        return self.scenarios.get(source.stem, ScenarioConfig()).run


class ConfigFiles:
    """Finds the settings of source files; every settings file is read once."""

    def __init__(self) -> None:
        """Start with nothing read."""
        self._by_folder: dict[Path, Config] = {}

    def for_source(self, source: Path) -> Config:
        """Return the settings for a source file.

        Raises:
            ConfigError: If the settings file is unreadable or says something unknown.
        """
        return self._for_folder(source.resolve().parent)

    def _for_folder(self, folder: Path) -> Config:
        if folder not in self._by_folder:
            found = _read_folder(folder)
            if found is None:
                found = Config() if folder == folder.parent else self._for_folder(folder.parent)
            self._by_folder[folder] = found
        return self._by_folder[folder]


def _read_folder(folder: Path) -> Config | None:
    own, project = folder / "osc2tx.toml", folder / "pyproject.toml"
    if own.is_file():
        return _Reader(own, "").config(_read_toml(own))
    if project.is_file():
        tool = _read_toml(project).get("tool", {})
        if isinstance(tool, dict) and "osc2tx" in tool:
            return _Reader(project, "tool.osc2tx").config(tool["osc2tx"])
    return None


def _read_toml(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise ConfigError(f"{path}: is not UTF-8 text") from None
    except tomllib.TOMLDecodeError as error:
        raise ConfigError(f"{path}: is not valid TOML: {error}") from None


class _Reader:
    """Turns the tables of one file into a `Config`, checking every key and value."""

    def __init__(self, path: Path, prefix: str) -> None:
        self.path = path
        self.prefix = prefix

    def config(self, table: object) -> Config:
        checked = self._table(table, (), (*COMPILE_KEYS, "scenarios"))
        scenarios = self._table(checked.get("scenarios", {}), ("scenarios",), None)
        return Config(
            path=self.path,
            options=self._options(checked, ()),
            scenarios={name: self._scenario(name, value) for name, value in scenarios.items()},
        )

    def _scenario(self, name: str, table: object) -> ScenarioConfig:
        where = ("scenarios", name)
        checked = self._table(table, where, (*COMPILE_KEYS, "run"))
        run = self._table(checked.get("run", {}), (*where, "run"), (*RUN_LISTS, *RUN_VALUES))
        texts = {key: self._run_texts(key, value, (*where, "run")) for key, value in run.items()}
        return ScenarioConfig(self._options(checked, where), texts)

    def _options(self, table: Mapping[str, object], where: tuple[str, ...]) -> GivenOptions:
        found = {}
        for key, allowed in COMPILE_KEYS.items():
            if key not in table:
                continue
            value = table[key]
            if value not in allowed:
                raise self._error(where, f"`{key}` is {_shown(value)}: write {_any_of(allowed)}")
            found[key] = str(value)
        return GivenOptions(**found)

    def _run_texts(self, key: str, value: object, where: tuple[str, ...]) -> tuple[str, ...]:
        if key in RUN_VALUES:
            if isinstance(value, (str, int, float)) and not isinstance(value, bool):
                return (str(value),)
            raise self._error(where, f"`{key}` is {_shown(value)}: write one number")
        written = value if isinstance(value, list) else [value]
        items = [item for item in written if isinstance(item, str)]
        if len(items) < len(written):
            raise self._error(where, f"`{key}` is {_shown(value)}: write a list of strings")
        if key == "map-path":  # relative to the file, wherever osc2tx is started
            return tuple(str(self.path.parent / item) for item in items)
        return tuple(items)

    def _table(
        self, value: object, where: tuple[str, ...], keys: Sequence[str] | None
    ) -> dict[str, Any]:
        """Return a table whose keys are all among the given ones, if any are given."""
        if not isinstance(value, dict):
            raise self._error(where[:-1], f"`{(where or ('osc2tx',))[-1]}` is not a table")
        for key in value:
            if keys is not None and key not in keys:
                meant = did_you_mean(key.replace("_", "-"), keys)
                meant = meant or did_you_mean(key.replace("-", "_"), keys)
                remedy = meant or f"known keys: {', '.join(keys)}"
                raise self._error(where, f"unknown key `{key}`; {remedy}")
        return value

    def _error(self, where: tuple[str, ...], message: str) -> ConfigError:
        table = ".".join(part for part in (self.prefix, *where) if part)
        return ConfigError(f"{self.path}: " + (f"in [{table}]: " if table else "") + message)


def _shown(value: object) -> str:
    return f'"{value}"' if isinstance(value, str) else str(value)


def _any_of(values: Sequence[str]) -> str:
    return " or ".join(f'"{value}"' for value in values)
