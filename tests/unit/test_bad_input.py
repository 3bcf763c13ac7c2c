"""Bad input through the whole command line: a diagnostic, never a traceback.

Each case runs in a process of its own, as an overflow of the C stack would end this one.
"""

import os
import re
from pathlib import Path

import pytest

from osc2tx import cli
from tests.processes import Ended, forked

ERRORS, UNREADABLE = 3, 4

HEAD = "import osc.standard\n\n"
DRIVE = HEAD + "scenario top:\n    car: vehicle\n    do serial:\n        car.drive(duration: 3s)\n"


@pytest.fixture(scope="module", autouse=True)
def _everything_is_loaded(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Load the command, all stages and the library: the copies of this process need not."""
    folder = tmp_path_factory.mktemp("loaded")
    (folder / "drive.osc").write_text(DRIVE, encoding="utf-8")
    with pytest.raises(SystemExit) as ended:
        cli.main(["build", str(folder / "drive.osc"), "-o", str(folder / "out")])
    assert ended.value.code == 0
    assert {path.suffix for path in (folder / "out").iterdir()} >= {".py", ".xosc"}


def osc2tx(*arguments: object) -> Ended:
    ended = forked(lambda: cli.main([str(argument) for argument in arguments]))
    assert "Traceback" not in ended.err
    assert "RecursionError" not in ended.err
    assert ended.code >= 0, f"ended by signal {-ended.code}"
    return ended


def codes(ended: Ended) -> list[str]:
    return re.findall(r"error\[(OSC\d+)\]", ended.err)


def build(folder: Path, text: str | bytes, name: str = "input.osc") -> Ended:
    path = folder / name
    path.write_bytes(text.encode() if isinstance(text, str) else text)
    return osc2tx("build", path, "-o", folder / "out")


def assert_refused(ended: Ended, code: str, *, exit_code: int = ERRORS) -> None:
    assert ended.code == exit_code, ended.err
    assert code in codes(ended), ended.err


def assert_built(ended: Ended, folder: Path) -> None:
    assert ended.code == 0, ended.err
    compile((folder / "out" / "input.py").read_text(encoding="utf-8"), "input.py", "exec")


# --- Bytes --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "data",
    [
        DRIVE.encode().replace(b"car", b"c\0r", 1),
        b"\0" * 100,
        DRIVE.encode().replace(b"car", b"c\xffr", 1),
        DRIVE.encode("utf-16"),
        b"\xef\xbb\xbf" + b"\xe9 = 1\n",
        b"\xed\xa0\x80",
        bytes(range(1, 256)),
    ],
    ids=["NUL", "NULs", "latin-1", "utf-16", "BOM and latin-1", "surrogate", "all bytes"],
)
def test_no_text(tmp_path: Path, data: bytes) -> None:
    assert_refused(build(tmp_path, data), "OSC101", exit_code=UNREADABLE)


@pytest.mark.parametrize(
    "data",
    [
        b"\xef\xbb\xbf" + DRIVE.encode(),
        DRIVE.replace("\n", "\r\n").encode(),
        DRIVE.replace("\n", "\r").encode(),
        DRIVE.replace("    ", "\t").encode(),
        DRIVE.rstrip().encode(),
        DRIVE.replace("\n", " \t\n").encode() + b"   ",
    ],
    ids=["BOM", "CR LF", "CR", "tabs", "no last line end", "trailing blanks"],
)
def test_unusual_but_fine(tmp_path: Path, data: bytes) -> None:
    assert_built(build(tmp_path, data), tmp_path)


def test_tabs_and_blanks_in_one_file(tmp_path: Path) -> None:
    text = DRIVE.replace("    do", "\tdo")
    ended = build(tmp_path, text)
    assert ended.code in (0, ERRORS)
    assert ended.code == 0 or codes(ended)


@pytest.mark.parametrize("text", ["", "\n", "\ufeff", "#", "   ", "\t\n"])
def test_nothing(tmp_path: Path, text: str) -> None:
    assert build(tmp_path, text).code == 0


# --- Nesting ------------------------------------------------------------------------------------


def nested_blocks(levels: int) -> str:
    operators = ("serial", "parallel", "one_of")
    lines = [" " * (8 + level) + f"{operators[level % 3]}:" for level in range(levels)]
    lines.append(" " * (8 + levels) + "wait elapsed(3s)")
    return HEAD + "scenario top:\n    do serial:\n" + "\n".join(lines) + "\n"


def nested_brackets(levels: int) -> str:
    value = "(" * levels + "1" + ")" * levels
    return DRIVE.replace("    car: vehicle", f"    a: int = {value}\n    car: vehicle")


def nested_sums(levels: int) -> str:
    condition = "(" * levels + "car.speed" + " + 1mps)" * levels + " > 3mps"
    return DRIVE + f"        wait {condition}\n"


def nested_negations(levels: int) -> str:
    return DRIVE + f"        wait {'not (' * levels}car.speed > 3mps{')' * levels}\n"


def nested_conditions(levels: int) -> str:
    value = "(true ? " * levels + "1" + " : 2)" * levels
    return DRIVE.replace("    car: vehicle", f"    a: int = {value}\n    car: vehicle")


NESTED = [nested_blocks, nested_brackets, nested_sums, nested_negations, nested_conditions]


NEAR_THE_LIMIT = [
    *((make, levels) for make in NESTED for levels in (60, 150)),
    *((make, 195) for make in NESTED),
]


@pytest.mark.parametrize(("make", "levels"), NEAR_THE_LIMIT)
def test_nesting_builds_or_is_refused(tmp_path: Path, make, levels: int) -> None:  # type: ignore[no-untyped-def]
    ended = build(tmp_path, make(levels))
    if ended.code == 0:
        assert_built(ended, tmp_path)
    else:
        assert levels > 60
        assert_refused(ended, "OSC105")


@pytest.mark.parametrize(
    "text",
    [
        nested_brackets(10_000),
        nested_negations(10_000),
        DRIVE + "        wait " + "(" * 10_000 + "\n",
        DRIVE + "        wait " + "[" * 10_000 + "]" * 10_000 + "\n",
        DRIVE + "        wait " + "not " * 10_000 + "true\n",
        DRIVE.replace("3s", "-" * 10_000 + "3s"),
        nested_blocks(1_000),
    ],
    ids=["round", "negations", "unclosed", "square", "not", "minus", "blocks"],
)
def test_nesting_too_deep(tmp_path: Path, text: str) -> None:
    assert_refused(build(tmp_path, text), "OSC105")


@pytest.mark.slow
def test_ten_thousand_blocks(tmp_path: Path) -> None:
    assert_refused(build(tmp_path, nested_blocks(10_000)), "OSC105")


# Flat in the text, yet a deep tree.
CHAINS = {
    "sum": lambda n: f"        wait car.speed{' + 1mps' * n} > 3mps\n",
    "or": lambda n: f"        wait car.speed < 100mps{' or car.speed > 4mps' * n}\n",
    "and": lambda n: f"        wait car.speed > 3mps{' and car.speed > 4mps' * n}\n",
    "implies": lambda n: f"        wait {'car.speed > 3mps => ' * n}car.speed > 3mps\n",
    "members": lambda n: f"        wait car{'.pose' * n} > 3mps\n",
    "indices": lambda n: f"        wait car.axles{'[0]' * n}.wheel_diameter > 3m\n",
}


@pytest.mark.parametrize("length", [150, pytest.param(3000, marks=pytest.mark.slow)])
@pytest.mark.parametrize("chain", CHAINS)
def test_long_chains(tmp_path: Path, chain: str, length: int) -> None:
    ended = build(tmp_path, DRIVE + CHAINS[chain](length))
    if ended.code == 0:
        assert_built(ended, tmp_path)
    else:
        assert ended.code == ERRORS and codes(ended), ended.err


@pytest.mark.slow
def test_a_line_longer_than_anybody_needs(tmp_path: Path) -> None:
    """Its declaration is left out; what follows is still looked at."""
    text = f"struct long:\n    x: int = {'1 + ' * 100_000}1\nstruct next:\n    y: int = true\n"
    ended = build(tmp_path, text)
    assert_refused(ended, "OSC115")
    assert_refused(build(tmp_path, text.rstrip()), "OSC115")


def test_long_path_of_members(tmp_path: Path) -> None:
    text = DRIVE.replace(
        "scenario", "struct node:\n    next: node\n    value: int = 1\n\nscenario", 1
    )
    text = text.replace("    car: vehicle", "    first: node\n    car: vehicle")
    ended = build(tmp_path, text + f"        wait first{'.next' * 3000}.value > 1\n")
    assert ended.code in (0, ERRORS), ended.err


# --- Long declarations --------------------------------------------------------------------------


def fields_before_use(number: int) -> str:
    fields = "".join(f"    v{i}: int = v{i + 1} + 1\n" for i in range(number))
    return DRIVE.replace("    car: vehicle", f"{fields}    v{number}: int = 1\n    car: vehicle")


def fields_after_use(number: int) -> str:
    fields = "".join(f"    v{i + 1}: int = v{i} + 1\n" for i in range(number))
    return DRIVE.replace("    car: vehicle", f"    v0: int = 1\n{fields}    car: vehicle")


def deep_inheritance(number: int) -> str:
    structs = "".join(f"struct s{i} inherits s{i + 1}\n" for i in range(number))
    return DRIVE.replace("scenario", f"{structs}struct s{number}\n\nscenario", 1)


def chained_events(number: int) -> str:
    events = "".join(f"    event e{i} is @e{i + 1}\n" for i in range(number))
    return DRIVE.replace("    car: vehicle", f"{events}    event e{number}\n    car: vehicle")


LONG = [fields_after_use, fields_before_use, deep_inheritance, chained_events]


@pytest.mark.parametrize("number", [3, pytest.param(1000, marks=pytest.mark.slow)])
@pytest.mark.parametrize("make", LONG)
def test_long_dependencies(tmp_path: Path, make, number: int) -> None:  # type: ignore[no-untyped-def]
    ended = build(tmp_path, make(number))
    assert ended.code in (0, ERRORS), ended.err
    if ended.code == 0:
        assert_built(ended, tmp_path)


@pytest.mark.parametrize("number", ["9" * 10_000, "0x" + "F" * 5_000, "1e" + "9" * 5_000])
def test_huge_numbers(tmp_path: Path, number: str) -> None:
    ended = build(
        tmp_path, DRIVE.replace("    car: vehicle", f"    a: float = {number}\n    car: vehicle")
    )
    assert_refused(ended, "OSC107")


# --- Imports and other cycles -------------------------------------------------------------------


def test_cyclic_imports(tmp_path: Path) -> None:
    (tmp_path / "one.osc").write_text('import "two.osc"\nimport "one.osc"\n', encoding="utf-8")
    (tmp_path / "two.osc").write_text('import "input.osc"\nimport "one.osc"\n', encoding="utf-8")
    ended = build(tmp_path, 'import "one.osc"\n' + DRIVE)
    assert_built(ended, tmp_path)  # the standard allows them: every file counts once


@pytest.mark.parametrize("kind", ["struct", "actor", "scenario", "action"])
def test_cyclic_inheritance(tmp_path: Path, kind: str) -> None:
    body = f"{kind} a inherits b\n{kind} b inherits c\n{kind} c inherits a\n{kind} d inherits d\n"
    assert_refused(build(tmp_path, HEAD + body), "OSC307")


@pytest.mark.parametrize(
    "text",
    [
        "scenario top:\n    a: int = b\n    b: int = a\n    do wait elapsed(1s)\n",
        "scenario top:\n    a: int = a\n    do serial:\n        wait elapsed(1s)\n",
        "scenario top:\n    event a is @b\n    event b is @a\n    do serial:\n        wait @a\n",
        "scenario top:\n    do serial:\n        top()\n",
        "struct s:\n    def f() -> int is expression f()\n",
        "struct s:\n    a: s\nscenario top:\n    b: s\n    do serial:\n        wait elapsed(1s)\n",
        "enum e: [a = b, b = a]\n",
    ],
    ids=["fields", "field", "events", "scenario", "method", "struct", "enum"],
)
def test_other_cycles(tmp_path: Path, text: str) -> None:
    ended = build(tmp_path, HEAD + text)
    assert ended.code in (0, ERRORS), ended.err
    assert ended.code == 0 or codes(ended)


def test_missing_imports(tmp_path: Path) -> None:
    ended = build(tmp_path, 'import "nowhere.osc"\nimport nowhere.at.all\n' + DRIVE)
    assert_refused(ended, "OSC205")
    assert codes(ended).count("OSC205") == 2


def test_folder_as_import(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    ended = build(tmp_path, 'import "folder"\nimport "."\nimport ""\n' + DRIVE)
    assert ended.code == ERRORS and len(codes(ended)) >= 2, ended.err


@pytest.mark.parametrize("uri", ["../../../etc/passwd", "file:///etc/passwd", "http://x/y.osc"])
def test_import_outside_of_the_folder(tmp_path: Path, uri: str) -> None:
    ended = build(tmp_path, f'import "{uri}"\n' + DRIVE)
    assert_refused(ended, "OSC205")
    assert "root:" not in ended.err


def test_imported_file_is_no_text(tmp_path: Path) -> None:
    (tmp_path / "other.osc").write_bytes(b"\0\xff")
    assert_refused(build(tmp_path, 'import "other.osc"\n' + DRIVE), "OSC101")


# --- Paths --------------------------------------------------------------------------------------


def test_folder_named_like_a_file(tmp_path: Path) -> None:
    (tmp_path / "folder.osc").mkdir()
    assert osc2tx("check", tmp_path / "folder.osc").code in (2, UNREADABLE)


def test_missing_file(tmp_path: Path) -> None:
    assert osc2tx("check", tmp_path / "nowhere.osc").code == UNREADABLE


@pytest.mark.skipif(os.geteuid() == 0, reason="root reads everything")
def test_unreadable_file(tmp_path: Path) -> None:
    path = tmp_path / "secret.osc"
    path.write_text(DRIVE, encoding="utf-8")
    path.chmod(0)
    assert_refused(osc2tx("check", path), "OSC101", exit_code=UNREADABLE)


@pytest.mark.skipif(not Path("/proc/self/mem").exists(), reason="a file that nobody can read")
def test_input_error(tmp_path: Path) -> None:
    path = tmp_path / "link.osc"
    path.symlink_to("/proc/self/mem")
    assert_refused(osc2tx("check", path), "OSC101", exit_code=UNREADABLE)


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no such files here")
@pytest.mark.parametrize("imported", [False, True])
def test_pipe_that_nobody_writes_to(tmp_path: Path, imported: bool) -> None:
    os.mkfifo(tmp_path / "pipe.osc")
    if imported:
        assert_refused(build(tmp_path, 'import "pipe.osc"\n' + DRIVE), "OSC101")
    else:
        assert_refused(osc2tx("check", tmp_path), "OSC101", exit_code=UNREADABLE)


def test_dangling_link(tmp_path: Path) -> None:
    path = tmp_path / "link.osc"
    path.symlink_to(tmp_path / "nowhere.osc")
    assert osc2tx("check", path).code == UNREADABLE
    assert osc2tx("check", tmp_path).code == UNREADABLE


def test_link_to_itself(tmp_path: Path) -> None:
    path = tmp_path / "link.osc"
    path.symlink_to(path)
    assert osc2tx("check", path).code == UNREADABLE


# --- Size ---------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(
    "text",
    [
        DRIVE + "# " + "x" * 10_000_000 + "\n",
        DRIVE.replace("    car: vehicle", f'    a: string = "{"x" * 10_000_000}"\n    car', 1),
        DRIVE + "\n" * 10_000_000,
        "$" * 10_000_000,
        '"' * 9_999_999,
        "scenario " * 1_000_000,
    ],
    ids=["comment", "string", "lines", "unknown", "quotes", "words"],
)
def test_ten_megabytes_in_a_line(tmp_path: Path, text: str) -> None:
    path = tmp_path / "input.osc"
    path.write_text(text, encoding="utf-8")
    ended = osc2tx("check", path)
    assert ended.code in (0, ERRORS)
    assert len(ended.err) < 100_000


@pytest.mark.parametrize(
    "members",
    [
        "    hop: inner\n",
        "    car: vehicle with:\n        keep(it.vehicle_category == vehicle_category!truck)\n",
        "    car: vehicle\n    keep(car.vehicle_category == vehicle_category!truck)\n",
        "    pair: both with:\n        keep(it.left == 3)\n",
    ],
)
def test_objects_of_what_is_not_invoked_have_no_values(tmp_path: Path, members: str) -> None:
    """A field of a scenario's type stands for the values of it alone (§7.2.2.2)."""
    wait = "    do wait elapsed(1s)\n\n"
    text = (
        f"{HEAD}struct both:\n    left: int\n\n"
        f"scenario inner:\n    number: int with:\n        keep(it == 3)\n{wait}"
        f"scenario middle:\n    size: int with:\n        keep(it == 4)\n{members}{wait}"
        f"scenario top:\n    hop: middle\n    shown: int = hop.size\n    again: top\n{wait}"
    )
    assert_built(build(tmp_path, text), tmp_path)


@pytest.mark.parametrize(
    "members",
    [
        "        go: go.drive(duration: 1s)\n",
        "        go: go.inner.drive(duration: 1s)\n",
        "        one: two.drive(duration: 1s)\n        two: one.drive(duration: 1s)\n",
    ],
)
def test_an_actor_that_depends_on_its_own_invocation(tmp_path: Path, members: str) -> None:
    text = f"{HEAD}scenario top:\n    do serial:\n{members}"
    assert_refused(build(tmp_path, text), "OSC301")
