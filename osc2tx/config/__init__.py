"""Settings from files: `[tool.osc2tx]` in pyproject.toml, or osc2tx.toml.

The nearest file above the source is used; in one folder osc2tx.toml precedes pyproject.toml. The
command line overrides the file.

    std = "2.1"
    sources = ["scenarios"]        # what `osc2tx build` builds, and where to
    out = "generated"
    [scenarios.hello_world]        # for hello_world.osc and its module
    dialect = "carla"
    [scenarios.hello_world.run]    # run options, written as on the command line
    signal = ["go_signal@1s"]
    [files."highway/**"]           # for all files of a pattern
    ignore = ["OSC437"]

`settings` holds the tables of all keys, `reader` turns a file into a `Config` of `model`, and
`files` finds the file for a source.
"""

from osc2tx.config.files import ConfigFiles
from osc2tx.config.model import Config, ConfigError, GivenOptions, InForce, Origin, ScenarioConfig
from osc2tx.config.settings import (
    CAMPAIGN_SETTINGS,
    COMPILE_SETTINGS,
    FILES_SETTINGS,
    PROJECT_SETTINGS,
    RUN_SETTINGS,
    TEST_SETTINGS,
    Setting,
)

__all__ = [
    "CAMPAIGN_SETTINGS",
    "COMPILE_SETTINGS",
    "FILES_SETTINGS",
    "PROJECT_SETTINGS",
    "RUN_SETTINGS",
    "TEST_SETTINGS",
    "Config",
    "ConfigError",
    "ConfigFiles",
    "GivenOptions",
    "InForce",
    "Origin",
    "ScenarioConfig",
    "Setting",
]
