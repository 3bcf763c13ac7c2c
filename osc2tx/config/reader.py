"""Reads settings files and rejects unknown keys."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from osc2tx.config.model import Config, ConfigError, GivenOptions, ScenarioConfig
from osc2tx.config.settings import (
    CAMPAIGN_SETTINGS,
    COMPILE_SETTINGS,
    FILES_SETTINGS,
    PROJECT_SETTINGS,
    RUN_SETTINGS,
    TABLES,
    TEST_SETTINGS,
    Setting,
)
from osc2tx.diagnostics import CODES, Severity
from osc2tx.diagnostics.suggestions import did_you_mean
from osc2tx.support.paths import SETTINGS_FILES, real_path

EMBEDDED = "embedded"  # the world whose options are all known here


def read_folder(folder: Path) -> Config | None:
    """Return the content of the settings file of a folder; `None` if there is none.

    Raises:
        ConfigError: If it is unreadable or has unknown settings.
    """
    own, project = (folder / name for name in SETTINGS_FILES)
    if own.is_file():
        return _Reader(own, "").config(_read_toml(own))
    if project.is_file():
        tool = _read_toml(project).get("tool", {})
        if isinstance(tool, dict) and "osc2tx" in tool:
            return _Reader(project, "tool.osc2tx").config(tool["osc2tx"])
    return None


def _read_toml(path: Path) -> dict[str, Any]:
    import tomllib  # few folders have a file

    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise ConfigError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise ConfigError(f"{path}: is not UTF-8 text") from None
    except (ValueError, RecursionError) as error:  # also a number of thousands of digits
        raise ConfigError(f"{path}: is not valid TOML: {error}") from None


class _Reader:
    """Turns the tables of one file into a `Config`, checking every key and value."""

    def __init__(self, path: Path, prefix: str) -> None:
        self.path = path
        self.prefix = prefix

    def config(self, table: object) -> Config:
        keys = [setting.key for setting in (*COMPILE_SETTINGS, *PROJECT_SETTINGS)]
        checked = self._table(table, (), (*keys, *TABLES))
        scenarios = self._table(checked.get("scenarios", {}), ("scenarios",), None)
        files = self._table(checked.get("files", {}), ("files",), None)
        project = self._texts(checked, PROJECT_SETTINGS, ())
        sources = tuple(map(Path, project.get("sources", ())))
        folders = (path.parent if path.suffix == ".osc" else path for path in sources)
        return Config(
            path=self.path,
            prefix=self.prefix,
            options=self._options(checked, ()),
            scenarios={
                name: self._scenario(("scenarios", name), value)
                for name, value in scenarios.items()
            },
            files={
                pattern: self._scenario(("files", f'"{pattern}"'), value, FILES_SETTINGS)
                for pattern, value in files.items()
            },
            sources=sources,
            source_folders=tuple(dict.fromkeys(map(real_path, folders))),
            out=Path(project["out"][0]) if "out" in project else None,
            map_paths=project.get("map_paths", ()),
            baseline=self._baseline(project),
        )

    def _baseline(self, project: Mapping[str, tuple[str, ...]]) -> Path | None:
        """Return the place of the baseline; it is written, so it must be in the project."""
        if "baseline" not in project:
            return None
        place = Path(project["baseline"][0])
        if not real_path(place).is_relative_to(real_path(self.path.parent)):
            raise self._error((), f"`baseline` leads to {real_path(place)}, out of the project")
        return place

    def _scenario(
        self, where: tuple[str, ...], table: object, more: Sequence[Setting] = ()
    ) -> ScenarioConfig:
        keys = [setting.key for setting in (*COMPILE_SETTINGS, *TEST_SETTINGS, *more)]
        checked = self._table(table, where, (*keys, "run", "campaign"))
        inner = (*where, "run")
        settings = {item.key: item for item in RUN_SETTINGS}
        run = self._table(checked.get("run", {}), inner, None)
        if run.get("world", EMBEDDED) == EMBEDDED:
            self._table(run, inner, list(settings))
        own = {key: self._own(key, value) for key, value in run.items() if key not in settings}
        stated = self._texts(checked, more, where)
        texts = self._texts(run, [*settings.values(), *own.values()], inner)
        return ScenarioConfig(
            self._options(checked, where),
            {key: texts[key] for key in run},
            self._campaign(checked.get("campaign", {}), (*where, "campaign")),
            {key: self._codes(key, codes, where) for key, codes in stated.items()},
            self._chosen(TEST_SETTINGS, checked, where).get("verdict"),
        )

    def _codes(self, key: str, codes: tuple[str, ...], where: tuple[str, ...]) -> frozenset[str]:
        for code in codes:
            if code not in CODES:
                remedy = did_you_mean(code, CODES) or "`osc2tx explain` lists all"
                raise self._error(where, f"`{key}`: there is no code `{code}`; {remedy}")
            if CODES[code].severity is Severity.ERROR:
                raise self._error(where, f"`{key}`: `{code}` is an error: only warnings can be")
        return frozenset(codes)

    def _campaign(self, table: object, where: tuple[str, ...]) -> dict[str, tuple[str, ...]]:
        checked = self._table(table, where, [setting.key for setting in CAMPAIGN_SETTINGS])
        texts = self._texts(checked, CAMPAIGN_SETTINGS, where)
        kind, colon, file = texts.get("sampler", ("",))[0].partition(":")
        if kind == "table" and colon:  # relative to the file, as other paths
            texts["sampler"] = (f"{kind}:{self.path.parent / file}",)
        return texts

    @staticmethod
    def _own(key: str, value: object) -> Setting:
        """Return the form of an option of another world; the run checks its value."""
        is_list, is_flag = isinstance(value, list), isinstance(value, bool)
        return Setting(key, is_list=is_list, is_flag=is_flag, is_single=not (is_list or is_flag))

    def _options(self, table: Mapping[str, object], where: tuple[str, ...]) -> GivenOptions:
        return GivenOptions(**self._chosen(COMPILE_SETTINGS, table, where))

    def _chosen(
        self, settings: Sequence[Setting], table: Mapping[str, object], where: tuple[str, ...]
    ) -> dict[str, Any]:
        """Return the values of those settings that are there."""
        found: dict[str, Any] = {}
        for setting in settings:
            if setting.key not in table:
                continue
            value = table[setting.key]
            if setting.is_flag:
                found[setting.key] = self._flag(setting.key, value, where)
                continue
            if setting.is_list:
                found[setting.key] = self._text(setting, value, where)
                continue
            if value not in setting.choices:
                problem = f"`{setting.key}` is {_shown(value)}: write {_any_of(setting.choices)}"
                raise self._error(where, problem)
            found[setting.key] = str(value)
        return found

    def _texts(
        self, table: Mapping[str, object], settings: Sequence[Setting], where: tuple[str, ...]
    ) -> dict[str, tuple[str, ...]]:
        """Return the values of those settings that are there, as texts of the command line."""
        return {
            setting.key: self._text(setting, table[setting.key], where)
            for setting in settings
            if setting.key in table
        }

    def _text(self, setting: Setting, value: object, where: tuple[str, ...]) -> tuple[str, ...]:
        if setting.is_flag:
            return (str(self._flag(setting.key, value, where)).lower(),)
        if setting.is_single:
            if isinstance(value, (str, int, float)) and not isinstance(value, bool):
                return (_written(value),)
            raise self._error(where, f"`{setting.key}` is {_shown(value)}: write one value")
        written = value if isinstance(value, list) and setting.is_list else [value]
        items = [item for item in written if isinstance(item, str)]
        if len(items) < len(written):
            wanted = "a list of strings" if setting.is_list else "one string"
            raise self._error(where, f"`{setting.key}` is {_shown(value)}: write {wanted}")
        if setting.is_path and any("\0" in item for item in items):
            raise self._error(where, f"`{setting.key}` is {_shown(value)}: no path has such a name")
        if setting.is_path:  # relative to the file, wherever osc2tx is started
            return tuple(str(self.path.parent / item) for item in items)
        return tuple(items)

    def _flag(self, key: str, value: object, where: tuple[str, ...]) -> bool:
        if isinstance(value, bool):
            return value
        raise self._error(where, f"`{key}` is {_shown(value)}: write true or false")

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
    return f'"{value}"' if isinstance(value, str) else _written(value)


def _written(value: object) -> str:
    """Return a value as text; integers too long for Python to print, in short."""
    try:
        return str(value)
    except ValueError:
        return "a number of thousands of digits"


def _any_of(values: Sequence[str]) -> str:
    return " or ".join(f'"{value}"' for value in values)
