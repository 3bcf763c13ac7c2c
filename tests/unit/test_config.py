"""Settings files: which one counts, what they may say, what beats what."""

from pathlib import Path

import pytest

from osc2tx.config import RUN_LISTS, RUN_VALUES, ConfigError, ConfigFiles, GivenOptions
from osc2tx.options import CompileOptions
from osc2tx_runtime.settings import OPTIONS


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
    lists = {option.name for option in OPTIONS if option.repeatable}
    assert set(RUN_LISTS) == lists
    assert set(RUN_VALUES) == {option.name for option in OPTIONS} - lists - outputs


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('dialekt = "asam"', "unknown key `dialekt`; did you mean `dialect`?"),
        ('one-of = "race"', "unknown key `one-of`; did you mean `one_of`?"),
        ("zzz = 1", "unknown key `zzz`; known keys: std, dialect, one_of, scenarios"),
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
        ("[scenarios.a.run]\nseed = true", "`seed` is True: write one number"),
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
