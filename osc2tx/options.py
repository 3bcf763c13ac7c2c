"""Options of a compilation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal, TypeAlias

from osc2tx_shared.classes import dataclass

Standard: TypeAlias = Literal["2.1", "2.2"]
Dialect: TypeAlias = Literal["asam", "carla"]
OneOfPolicy: TypeAlias = Literal["race", "first", "seeded"]
ProductName: TypeAlias = Literal["ast", "model", "ir", "py", "xosc"]
Target: TypeAlias = Literal["all", "py", "xosc"]
XmlVersion: TypeAlias = Literal["1.0", "1.1", "1.2", "1.3", "1.4"]
XmlProfile: TypeAlias = Literal["generic", "esmini", "scenario_runner"]

STANDARDS: tuple[Standard, ...] = ("2.1", "2.2")
DIALECTS: tuple[Dialect, ...] = ("asam", "carla")
ONE_OF_POLICIES: tuple[OneOfPolicy, ...] = ("race", "first", "seeded")
PRODUCT_NAMES: tuple[ProductName, ...] = ("ast", "model", "ir", "py", "xosc")  # of `--emit`
TARGETS: tuple[Target, ...] = ("all", "py", "xosc")
XML_VERSIONS: tuple[XmlVersion, ...] = ("1.0", "1.1", "1.2", "1.3", "1.4")
DEFAULT_XML_VERSION: XmlVersion = "1.3"  # the newest that tools read
ONLY_VERSIONS: Mapping[str, XmlVersion] = {"scenario_runner": "1.0"}  # of profiles that have one
XML_PROFILES: tuple[XmlProfile, ...] = ("generic", "esmini", "scenario_runner")


@dataclass(frozen=True, slots=True)
class XmlOptions:
    """Options of OpenSCENARIO XML.

    Attributes:
        version: Version of the standard to write.
        profile: The tool that is to read it.
        allow_approx: Whether constructs may be approximated.
        signals: Events from outside with their times, as for `osc2tx run --signal`.
        spawns: Start places of actors that the scenario does not place, as for `--spawn`.
        map_path: Folders with maps, besides that of the source and the built-in ones.
        verify: Whether builds play the documents, to measure their grades.
    """

    version: XmlVersion = DEFAULT_XML_VERSION
    profile: XmlProfile = "generic"
    allow_approx: bool = False
    signals: tuple[str, ...] = ()
    spawns: tuple[str, ...] = ()
    map_path: tuple[str, ...] = ()
    verify: bool = True


@dataclass(frozen=True, slots=True)
class CompileOptions:
    """The options of one compilation: all inputs of its output besides the source.

    Attributes:
        standard: Version of OpenSCENARIO DSL.
        dialect: The set of accepted deviations from the standard.
        one_of: The policy of `one_of`.
        target: The outputs: modules, OpenSCENARIO XML, or both, then XML only where it can express
            the scenario.
        xml: Options of OpenSCENARIO XML.
        import_paths: Folders with libraries, which are searched after the project.
    """

    standard: Standard = "2.1"
    dialect: Dialect = "asam"
    one_of: OneOfPolicy = "race"
    target: Target = "all"
    xml: XmlOptions = XmlOptions()
    import_paths: tuple[str, ...] = ()
