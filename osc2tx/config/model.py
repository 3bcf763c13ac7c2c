"""Settings as data."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from functools import lru_cache
from pathlib import Path
from typing import Any

from osc2tx.config.settings import COMPILE_SETTINGS, RUN_SETTINGS, VERDICTS
from osc2tx.options import ONLY_VERSIONS, CompileOptions, XmlOptions
from osc2tx.support.paths import real_path
from osc2tx_shared.classes import dataclass, replace


class ConfigError(Exception):
    """A settings file that cannot be used; the message names file and key."""


@dataclass(frozen=True, slots=True)
class GivenOptions:
    """Compile options as far as one source states them; `None` leaves the choice to others.

    `signal`, `spawn` and `map_path` are run options that OpenSCENARIO XML contains as well.
    """

    std: str | None = None
    dialect: str | None = None
    one_of: str | None = None
    target: str | None = None
    xml_version: str | None = None
    xml_profile: str | None = None
    allow_approx: bool | None = None
    import_paths: tuple[str, ...] | None = None
    signal: tuple[str, ...] | None = None
    spawn: tuple[str, ...] | None = None
    map_path: tuple[str, ...] | None = None
    verify: bool | None = None

    def over(self, other: GivenOptions) -> GivenOptions:
        """Return these options, with those of `other` where nothing is stated here."""
        stated = {name: getattr(self, name) for name in (*_COMPILE, *_XML)}
        chosen = {
            name: getattr(other, name) if value is None else value for name, value in stated.items()
        }
        return GivenOptions(**chosen)

    def complete(self) -> CompileOptions:
        """Return the options with the defaults for all that are open."""
        xml = self._stated(_XML)
        only = ONLY_VERSIONS.get(self.xml_profile or "")
        if only is not None:
            xml.setdefault("version", only)
        return CompileOptions(**self._stated(_COMPILE), xml=XmlOptions(**xml))

    def _stated(self, names: Mapping[str, str]) -> dict[str, Any]:
        values = {option: getattr(self, name) for name, option in names.items()}
        return {option: value for option, value in values.items() if value is not None}


# Field of `GivenOptions` -> field of `CompileOptions`, and of `XmlOptions`.
_COMPILE = {
    "std": "standard",
    "dialect": "dialect",
    "one_of": "one_of",
    "target": "target",
    "import_paths": "import_paths",
}
_XML = {
    "xml_version": "version",
    "xml_profile": "profile",
    "allow_approx": "allow_approx",
    "signal": "signals",
    "spawn": "spawns",
    "map_path": "map_path",
    "verify": "verify",
}


@dataclass(frozen=True, slots=True)
class ScenarioConfig:
    """The table of one scenario file, or of a pattern of files.

    Attributes:
        options: Compile options of this file.
        run: Run option to its text, in the syntax of the command line.
        campaign: Option of `osc2tx campaign run`, likewise.
        codes: Codes of warnings, by their setting.
        verdict: The expected verdict of a test of its scenarios.
    """

    options: GivenOptions = GivenOptions()
    run: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    campaign: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    codes: Mapping[str, frozenset[str]] = field(default_factory=dict)
    verdict: str | None = None

    def given(self) -> GivenOptions:
        """Return its compile options, and its run options as far as XML holds them."""
        return self.options.over(
            GivenOptions(
                signal=self.run.get("signal"),
                spawn=self.run.get("spawn"),
                map_path=self.run.get("map-path"),
            )
        )


_RUN_PATHS = {setting.key for setting in RUN_SETTINGS if setting.is_path}


@dataclass(frozen=True, slots=True)
class Origin:
    """Where a setting is from: a table of a file, or without file the command line or a default."""

    place: str
    path: Path | None = None


@dataclass(frozen=True, slots=True)
class InForce:
    """A setting that counts, as one would write it, and where it is from; paths are whole."""

    name: str
    value: str | bool | Sequence[str]
    origin: Origin
    is_path: bool = False


@dataclass(frozen=True, slots=True)
class Config:
    """The content of a settings file.

    Attributes:
        path: The file; `None` if there is none and every setting has its default.
        prefix: The table of osc2tx in the file; empty for the whole file.
        options: Compile options for all files.
        scenarios: Tables of single files, by the stem of the file name.
        files: Tables by pattern of the paths of files; a later one overrides an earlier one.
        sources: Files and folders of the project.
        source_folders: Their folders, links followed.
        out: The output folder.
        map_paths: Folders with maps, for all files.
        baseline: The file of warnings that are known.
    """

    path: Path | None = None
    prefix: str = ""
    options: GivenOptions = GivenOptions()
    scenarios: Mapping[str, ScenarioConfig] = field(default_factory=dict)
    files: Mapping[str, ScenarioConfig] = field(default_factory=dict)
    sources: tuple[Path, ...] = ()
    source_folders: tuple[Path, ...] = ()
    out: Path | None = None
    map_paths: tuple[str, ...] = ()
    baseline: Path | None = None

    @property
    def folder(self) -> Path | None:
        """The folder of the project: all files in it belong to it."""
        return self.path.parent if self.path else None

    def tables_for(self, source: Path) -> list[tuple[str, ScenarioConfig]]:
        """Return the tables of a file with their names, the overriding one first."""
        names = self._names_of(source) if self.files else ()
        found = [
            (f'files."{pattern}"', table)
            for pattern, table in reversed(list(self.files.items()))
            if any(_pattern(pattern).fullmatch(name) for name in names)
        ]
        if source.stem in self.scenarios:
            found.insert(0, (f"scenarios.{source.stem}", self.scenarios[source.stem]))
        return found

    def matches(self, pattern: str, source: Path) -> bool:
        """Return whether a file is one of a pattern.

        Its path counts from the folder of sources that holds it, or from the settings file; `*` is
        any part of a name, `**` any number of folders.
        """
        return any(_pattern(pattern).fullmatch(name) for name in self._names_of(source))

    def _names_of(self, source: Path) -> Sequence[str]:
        place = real_path(source.parent) / source.name
        folders = (*self.source_folders, *(() if self.folder is None else (self.folder,)))
        return [
            place.relative_to(each).as_posix() for each in folders if place.is_relative_to(each)
        ]

    def options_for(self, source: Path, given: GivenOptions) -> CompileOptions:
        """Return the options for a file: the command line, then its tables, then the file's."""
        for _, table in self.tables_for(source):
            given = given.over(table.given())
        found = given.over(self.options).complete()
        if not self.map_paths:
            return found
        maps = (*found.xml.map_path, *self.map_paths)
        return replace(found, xml=replace(found.xml, map_path=maps))

    def run_settings(self, source: Path) -> Mapping[str, tuple[str, ...]]:
        """Return the run options of a file."""
        found = self._merged("run", source)
        if self.map_paths:
            found["map-path"] = (*found.get("map-path", ()), *self.map_paths)
        return found

    def campaign_settings(self, source: Path) -> Mapping[str, tuple[str, ...]]:
        """Return the options of the campaign of a file."""
        return self._merged("campaign", source)

    def _merged(self, part: str, source: Path) -> dict[str, tuple[str, ...]]:
        tables = (getattr(table, part) for _, table in reversed(self.tables_for(source)))
        return {key: texts for table in tables for key, texts in table.items()}

    def codes(self, setting: str, source: Path) -> frozenset[str]:
        """Return the codes of warnings that a setting (`ignore`, `errors`) names for a file.

        A table removes its codes from those that overridden tables name.
        """
        found: set[str] = set()
        for _, table in reversed(self.tables_for(source)):
            for key, codes in table.codes.items():
                found = found | codes if key == setting else found - codes
        return frozenset(found)

    def verdict(self, source: Path) -> str:
        """Return the expected verdict of a test of the scenarios of a file."""
        stated = (table.verdict for _, table in self.tables_for(source))
        return next((each for each in stated if each is not None), VERDICTS[0])

    def is_source(self, path: Path) -> bool:
        """Return whether a file is one of the `sources`, or below one."""
        place = real_path(path.parent) / path.name
        return any(place.is_relative_to(real_path(source)) for source in self.sources)

    def settings_in_force(self, source: Path | None, given: GivenOptions) -> Iterator[InForce]:
        """Yield the effective settings of a file, or of a folder, with their origins."""
        tables = self.tables_for(source) if source else []
        layers = [
            (given, Origin("command line")),
            *((table.options, self._origin(name)) for name, table in tables),
            (self.options, self._origin("")),
        ]
        for setting in COMPILE_SETTINGS:
            stated = ((getattr(layer, setting.key), origin) for layer, origin in layers)
            default = (setting.default, Origin("default"))
            value, origin = next((pair for pair in stated if pair[0] is not None), default)
            yield InForce(setting.key, value, origin, setting.is_path)
        if self.sources:
            sources = [str(path) for path in self.sources]
            yield InForce("sources", sources, self._origin(""), is_path=True)
        if self.out is not None:
            yield InForce("out", str(self.out), self._origin(""), is_path=True)
        if self.map_paths:
            yield InForce("map_paths", self.map_paths, self._origin(""), is_path=True)
        if self.baseline is not None:
            yield InForce("baseline", str(self.baseline), self._origin(""), is_path=True)
        seen: set[str] = set()
        for part in ("run", "campaign"):
            for name, table in tables:
                for key, texts in getattr(table, part).items():
                    if f"{part}.{key}" not in seen:
                        seen.add(f"{part}.{key}")
                        origin, is_path = self._origin(f"{name}.{part}"), key in _RUN_PATHS
                        yield InForce(f"{part}.{key}", list(texts), origin, is_path)
        for name, table in tables:
            for key, codes in table.codes.items():
                yield InForce(key, sorted(codes), self._origin(name))
        for name, table in tables:
            if table.verdict is not None:
                yield InForce("verdict", table.verdict, self._origin(name))
                break

    def _origin(self, table: str) -> Origin:
        return Origin(".".join(part for part in (self.prefix, table) if part), self.path)


@lru_cache(maxsize=256)
def _pattern(written: str) -> re.Pattern[str]:
    """Return the regular expression of a pattern of paths."""
    parts = re.split(r"(\*\*/|\*\*|\*|\?)", written)
    meanings = {"**/": "(?:.*/)?", "**": ".*", "*": "[^/]*", "?": "[^/]"}
    return re.compile("".join(meanings.get(part, re.escape(part)) for part in parts), re.DOTALL)
