"""Settings files: which one counts, what they may say, what beats what."""

import runpy
from pathlib import Path

import pytest

from osc2tx.config import RUN_SETTINGS, ConfigError, ConfigFiles, GivenOptions
from osc2tx.options import CompileOptions
from osc2tx_runtime.running.options import OPTIONS

REPOSITORY = Path(__file__).parents[2]


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def options(source: Path, given: GivenOptions | None = None) -> CompileOptions:
    return ConfigFiles().for_source(source).options_for(source, given or GivenOptions())


def test_without_a_file_all_is_default(tmp_path: Path) -> None:
    assert options(tmp_path / "a.osc") == CompileOptions("2.1", "asam", "race")


def test_nearest_file_counts_and_is_the_only_one(tmp_path: Path) -> None:
    write(tmp_path / "pyproject.toml", '[tool.osc2tx]\nstd = "2.2"\none_of = "first"\n')
    write(tmp_path / "sub/osc2tx.toml", 'dialect = "carla"\n')
    assert options(tmp_path / "a.osc") == CompileOptions("2.2", "asam", "first")
    assert options(tmp_path / "sub/deep/a.osc") == CompileOptions("2.1", "carla", "race")


def test_pyproject_without_our_table_is_passed_over(tmp_path: Path) -> None:
    write(tmp_path / "osc2tx.toml", 'std = "2.2"\n')
    write(tmp_path / "sub/pyproject.toml", '[tool.black]\nline-length = 100\n[project]\nname="x"\n')
    assert options(tmp_path / "sub/a.osc").standard == "2.2"


def test_osc2tx_toml_goes_before_pyproject_of_the_same_folder(tmp_path: Path) -> None:
    write(tmp_path / "pyproject.toml", '[tool.osc2tx]\nstd = "2.1"\n')
    write(tmp_path / "osc2tx.toml", 'std = "2.2"\n')
    assert options(tmp_path / "a.osc").standard == "2.2"


def test_command_line_beats_the_table_of_a_file_beats_the_rest(tmp_path: Path) -> None:
    text = 'std = "2.2"\none_of = "first"\ndialect = "asam"\n[scenarios.a]\ndialect = "carla"\n'
    write(tmp_path / "osc2tx.toml", text + 'one_of = "seeded"\n')
    given = GivenOptions(one_of="race")
    assert options(tmp_path / "a.osc", given) == CompileOptions("2.2", "carla", "race")
    assert options(tmp_path / "a.osc") == CompileOptions("2.2", "carla", "seeded")
    assert options(tmp_path / "b.osc") == CompileOptions("2.2", "asam", "first")


def test_run_settings_are_texts_of_the_command_line(tmp_path: Path) -> None:
    text = '[scenarios.a.run]\nsignal = ["go@1s"]\nspawn = "hero=1,-1,5"\nseed = 7\ndt = 0.1\n'
    config = ConfigFiles().for_source(write(tmp_path / "osc2tx.toml", text))
    assert config.run_settings(tmp_path / "a.osc") == {
        "signal": ("go@1s",),
        "spawn": ("hero=1,-1,5",),
        "seed": ("7",),
        "dt": ("0.1",),
    }
    assert config.run_settings(tmp_path / "b.osc") == {}


def test_map_folders_are_relative_to_the_settings_file(tmp_path: Path) -> None:
    write(tmp_path / "osc2tx.toml", '[scenarios.a.run]\nmap-path = ["maps", "/abs"]\n')
    run = ConfigFiles().for_source(tmp_path / "sub/a.osc").run_settings(Path("a.osc"))
    assert run["map-path"] == (str(tmp_path / "maps"), "/abs")


def test_run_keys_are_options_of_the_runtime() -> None:
    outputs = {"trace", "report"}
    dangers = {"allow-external"}  # runs code: not for a file of a stranger's branch to allow
    lists = {option.name for option in OPTIONS if option.repeatable} - dangers
    assert {setting.key for setting in RUN_SETTINGS if setting.is_list} == lists
    flags = {option.name for option in OPTIONS if option.is_flag}
    assert {setting.key for setting in RUN_SETTINGS if setting.is_flag} == flags
    values = {option.name for option in OPTIONS} - lists - flags - outputs - dangers
    assert {setting.key for setting in RUN_SETTINGS if setting.is_single} == values


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('dialekt = "asam"', "unknown key `dialekt`; did you mean `dialect`?"),
        ('one-of = "race"', "unknown key `one-of`; did you mean `one_of`?"),
        (
            "zzz = 1",
            "unknown key `zzz`; known keys: std, dialect, one_of, target, xml_version, xml_profile,"
            " allow_approx, import_paths, sources, out, baseline, map_paths, scenarios, files",
        ),
        ("allow_approx = 1", "`allow_approx` is 1: write true or false"),
        ("std = 2.1", '`std` is 2.1: write "2.1" or "2.2"'),
        ('dialect = "carl"', '`dialect` is "carl": write "asam" or "carla"'),
        ("scenarios = 3", "`scenarios` is not a table"),
        ("[scenarios]\na = 3", "in [scenarios]: `a` is not a table"),
        ("[scenarios.a]\nrunn = {}", "in [scenarios.a]: unknown key `runn`; did you mean `run`?"),
        (
            '[scenarios.a.run]\nmap_path = ["m"]',
            "in [scenarios.a.run]: unknown key `map_path`; did you mean `map-path`?",
        ),
        ("[scenarios.a.run]\nsignal = [1]", "`signal` is [1]: write a list of strings"),
        ("[scenarios.a.run]\nseed = true", "`seed` is True: write one value"),
        ("sources = 3", "`sources` is 3: write a list of strings"),
        ('out = ["a"]', "`out` is ['a']: write one string"),
        ("std =", "is not valid TOML"),
    ],
)
def test_errors_name_file_table_and_key(tmp_path: Path, text: str, message: str) -> None:
    path = write(tmp_path / "osc2tx.toml", text)
    with pytest.raises(ConfigError) as caught:
        ConfigFiles().for_source(tmp_path / "a.osc")
    assert str(caught.value).startswith(f"{path}: ")
    assert message in str(caught.value)


def test_errors_in_pyproject_give_the_whole_table(tmp_path: Path) -> None:
    write(tmp_path / "pyproject.toml", "[tool.osc2tx.scenarios.a]\nx = 1\n")
    with pytest.raises(ConfigError, match=r"in \[tool\.osc2tx\.scenarios\.a\]: unknown key `x`"):
        ConfigFiles().for_source(tmp_path / "a.osc")


def test_text_that_is_no_utf8_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "osc2tx.toml").write_bytes(b"\xff\xfe")
    with pytest.raises(ConfigError, match="is not UTF-8 text"):
        ConfigFiles().for_source(tmp_path / "a.osc")


def test_sources_and_output_folder_are_relative_to_the_settings_file(tmp_path: Path) -> None:
    write(tmp_path / "osc2tx.toml", 'sources = ["scenarios", "more/a.osc"]\nout = "generated"\n')
    (tmp_path / "deep/er").mkdir(parents=True)
    config = ConfigFiles().for_folder(tmp_path / "deep/er")
    assert config.sources == (tmp_path / "scenarios", tmp_path / "more/a.osc")
    assert config.out == tmp_path / "generated"


def test_what_is_in_force_and_from_where(tmp_path: Path) -> None:
    path = write(
        tmp_path / "pyproject.toml",
        '[tool.osc2tx]\nstd = "2.2"\nout = "g"\ntarget = "py"\n'
        '[tool.osc2tx.scenarios.a]\ndialect = "carla"\nallow_approx = true\n'
        "[tool.osc2tx.scenarios.a.run]\nseed = 3\n",
    )
    source = tmp_path / "a.osc"
    config = ConfigFiles().for_source(source)
    rows = config.settings_in_force(source, GivenOptions(one_of="first"))
    table = "tool.osc2tx.scenarios.a"
    assert [(row.name, row.value, row.origin.place, row.origin.path) for row in rows] == [
        ("std", "2.2", "tool.osc2tx", path),
        ("dialect", "carla", table, path),
        ("one_of", "first", "command line", None),
        ("target", "py", "tool.osc2tx", path),
        ("xml_version", "1.3", "default", None),
        ("xml_profile", "generic", "default", None),
        ("allow_approx", True, table, path),
        ("import_paths", (), "default", None),
        ("out", str(tmp_path / "g"), "tool.osc2tx", path),
        ("run.seed", ["3"], f"{table}.run", path),
    ]
    rows = ConfigFiles().for_source(tmp_path / "b.osc").settings_in_force(None, GivenOptions())
    assert [row.origin.place for row in rows][:3] == ["tool.osc2tx", "default", "default"]


def test_tables_of_files_that_do_not_exist(tmp_path: Path) -> None:
    path = write(tmp_path / "osc2tx.toml", "[scenarios.a]\n[scenarios.deep]\n[scenarios.hero]\n")
    write(tmp_path / "sub/deep.osc", "")
    configs = ConfigFiles()
    configs.for_folder(tmp_path)
    assert configs.unmatched_tables() == []  # nobody asked for a source of it
    configs.for_source(tmp_path / "a.osc")
    assert configs.unmatched_tables() == [
        f"{path}: [scenarios.hero] matches no file: there is no `hero.osc`"
    ]


def test_the_reference_is_up_to_date() -> None:
    tool = runpy.run_path(str(REPOSITORY / "tools/make_config_doc.py"))
    page = (REPOSITORY / "docs/config.md").read_text(encoding="utf-8")
    assert page == tool["render"](), "run `make docs-config`"


PATTERNS = """
sources = ["scenarios"]
map_paths = ["maps"]
std = "2.1"
[files."highway/**"]
std = "2.2"
target = "py"
ignore = ["OSC437"]
run = {seed = 3, max-time = 9}
[files."**/cut_*.osc"]
target = "xosc"
errors = ["OSC437"]
run = {seed = 4, map-path = ["more"]}
[scenarios.cut_in]
one_of = "first"
"""


def test_tables_by_pattern(tmp_path: Path) -> None:
    write(tmp_path / "osc2tx.toml", PATTERNS)
    highway, urban = tmp_path / "scenarios/highway", tmp_path / "scenarios/urban"
    for folder in (highway, urban):
        folder.mkdir(parents=True)

    def of(source: Path) -> tuple[str, str, str]:
        found = options(source)
        return found.standard, found.target, found.one_of

    assert of(highway / "cut_in.osc") == ("2.2", "xosc", "first")  # the later pattern goes before
    assert of(highway / "evade.osc") == ("2.2", "py", "race")
    assert of(urban / "cut_out.osc") == ("2.1", "xosc", "race")
    assert of(urban / "evade.osc") == ("2.1", "all", "race")
    given = GivenOptions(target="all")
    assert options(highway / "cut_in.osc", given).target == "all"
    config = ConfigFiles().for_source(highway / "cut_in.osc")
    maps, more = str(tmp_path / "maps"), str(tmp_path / "more")
    run = config.run_settings(highway / "cut_in.osc")
    assert run == {"seed": ("4",), "max-time": ("9",), "map-path": (more, maps)}
    assert options(highway / "cut_in.osc").xml.map_path == (more, maps)
    assert options(urban / "evade.osc").xml.map_path == (maps,)
    assert config.codes("ignore", highway / "evade.osc") == {"OSC437"}
    assert config.codes("ignore", urban / "evade.osc") == frozenset()
    assert config.codes("ignore", highway / "cut_in.osc") == frozenset()
    assert config.codes("errors", highway / "cut_in.osc") == {"OSC437"}


@pytest.mark.parametrize(
    "pattern, name, fits",
    [
        ("highway/**", "highway/a/b.osc", True),
        ("highway/*", "highway/a/b.osc", False),
        ("**/b.osc", "b.osc", True),
        ("*.osc", "a/b.osc", False),
        ("scenarios/**/b.osc", "a/b.osc", True),  # from the settings file
        ("h?ghway/[x].osc", "highway/[x].osc", True),
    ],
)
def test_patterns(tmp_path: Path, pattern: str, name: str, fits: bool) -> None:
    write(tmp_path / "osc2tx.toml", 'sources = ["scenarios"]\n')
    source = write(tmp_path / "scenarios" / name, "")
    assert ConfigFiles().for_source(source).matches(pattern, source) is fits


@pytest.mark.parametrize(
    "code, message",
    [("OSC999", "there is no code `OSC999`"), ("OSC205", "`OSC205` is an error: only warnings")],
)
@pytest.mark.parametrize("setting", ["ignore", "errors"])
def test_what_cannot_be_ignored(tmp_path: Path, setting: str, code: str, message: str) -> None:
    write(tmp_path / "osc2tx.toml", f'[files."**"]\n{setting} = ["{code}"]\n')
    with pytest.raises(ConfigError, match=f"`{setting}`: {message}"):
        ConfigFiles().for_folder(tmp_path)


@pytest.mark.parametrize("place", ["../known.json", "/etc/known.json", "inner/../../known.json"])
def test_a_baseline_is_in_the_project(tmp_path: Path, place: str) -> None:
    write(tmp_path / "osc2tx.toml", f'baseline = "{place}"\n')
    with pytest.raises(ConfigError, match="out of the project"):
        ConfigFiles().for_folder(tmp_path)


def test_a_table_of_rows_is_beside_the_settings(tmp_path: Path) -> None:
    place = write(tmp_path / "osc2tx.toml", '[scenarios.a.campaign]\nsampler = "table:rows.csv"\n')
    config = ConfigFiles().for_source(tmp_path / "a.osc")
    assert config.scenarios["a"].campaign["sampler"] == (f"table:{place.parent / 'rows.csv'}",)
