"""The keys of a settings file, as tables; `docs/config.md` is made from them."""

from __future__ import annotations

from osc2tx.options import (
    DEFAULT_XML_VERSION,
    DIALECTS,
    ONE_OF_POLICIES,
    STANDARDS,
    TARGETS,
    XML_PROFILES,
    XML_VERSIONS,
)
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True)
class Setting:
    """A key of a settings file.

    Attributes:
        key: Its spelling.
        help: Description for the reference; the runtime has that of its own options.
        choices: Its values, if they are few; then the first is the default.
        is_list: Whether it is a list of texts.
        is_path: Whether its texts are paths, relative to the settings file.
        is_single: Whether it is one number, or one text that is no path.
        is_flag: Whether it is `true` or `false`, which is the default.
    """

    key: str
    help: str = ""
    choices: tuple[str, ...] = ()
    is_list: bool = False
    is_path: bool = False
    is_single: bool = False
    is_flag: bool = False

    @property
    def default(self) -> str | bool | tuple[str, ...]:
        """The value where it is not stated."""
        if self.is_list:
            return ()
        return False if self.is_flag else self.choices[0]


# For all files, or in the table of one.
COMPILE_SETTINGS = (
    Setting("std", "Version of the standard.", STANDARDS),
    Setting("dialect", "Dialect of the sources.", DIALECTS),
    Setting("one_of", "Meaning of `one_of`.", ONE_OF_POLICIES),
    Setting("target", "Outputs; `all`: modules, and XML where it is exact.", TARGETS),
    Setting(
        "xml_version",
        "Version of OpenSCENARIO XML.",
        (DEFAULT_XML_VERSION, *(v for v in reversed(XML_VERSIONS) if v != DEFAULT_XML_VERSION)),
    ),
    Setting("xml_profile", "Tool that is to read the XML.", XML_PROFILES),
    Setting("allow_approx", "Write approximated XML as well.", is_flag=True),
    Setting(
        "import_paths",
        "Folders where `import a.b` finds `a/b.osc`, if it is not in the project.",
        is_list=True,
        is_path=True,
    ),
)
# For `osc2tx build` started in the folder of the file or below.
PROJECT_SETTINGS = (
    Setting("sources", "Files and folders to build.", is_list=True, is_path=True),
    Setting("out", "Folder of the outputs.", is_path=True),
    Setting("baseline", "File of warnings that are known and not reported.", is_path=True),
    Setting("map_paths", "Folders with maps, for all commands.", is_list=True, is_path=True),
)
VERDICTS = ("success", "failure", "timeout", "error", "skip")
# In the tables of scenarios and of patterns of files.
TEST_SETTINGS = (
    Setting("verdict", "Expected result of a test; `skip`: no test of these files.", VERDICTS),
)
# In the table of a pattern of files, besides those of a scenario.
FILES_SETTINGS = (
    Setting("errors", "Codes of warnings that are errors in these files.", is_list=True),
    Setting("ignore", "Codes of warnings that are not reported in these files.", is_list=True),
)
# Options of `osc2tx run` for one file, by their names on the command line.
RUN_SETTINGS = (
    Setting("map-path", is_list=True, is_path=True),
    Setting("world", is_single=True),
    Setting("control", is_list=True),
    Setting("expect", is_flag=True),
    Setting("physics", is_single=True),
    Setting("conduct", is_single=True),
    Setting("fail-on", is_list=True),
    Setting("signal", is_list=True),
    Setting("spawn", is_list=True),
    Setting("destination", is_list=True),
    Setting("set", is_list=True),
    Setting("seed", is_single=True),
    Setting("dt", is_single=True),
    Setting("max-time", is_single=True),
)
# Options of `osc2tx campaign run` for one file, likewise.
CAMPAIGN_SETTINGS = (
    Setting("samples", "Number of rows.", is_single=True),
    Setting("sampler", "Method that chooses the values of rows.", is_single=True),
    Setting("search", "The KPI whose worst value is searched.", is_single=True),
    Setting("search-batch", "Number of rows that a search chooses together.", is_single=True),
    Setting("levels", "Values of a range for grid and pairwise.", is_single=True),
    Setting("kpi", "Measures to take.", is_list=True),
    Setting("fail-if", "A row also fails if this condition holds.", is_list=True),
    Setting("timeout", "Wall-clock seconds that a row may take.", is_single=True),
    Setting("workers", "Number of processes.", is_single=True),
    Setting("digests", "Compute each trace, and store its digest.", is_flag=True),
)
TABLES = ("scenarios", "files")  # of tables, one for each scenario file or pattern of files
