"""What comments suppress, and what is said about comments that do not."""

from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.compilation.file_reports import apply_suppressions
from osc2tx.diagnostics import Diagnostic
from osc2tx.options import CompileOptions

CARLA = CompileOptions(dialect="carla")
GOOD = "import osc.standard\n\nscenario top:\n    do serial:\n        wait @go{}\n"


def compilation(folder: Path, text: str, name: str = "a.osc") -> Compilation:
    path = folder / name
    path.write_text(text, encoding="utf-8")
    made = Compilation(path, name, CARLA)
    made.check()
    return made


def check(folder: Path, text: str) -> list[str]:
    """Return `line:column code` of what is shown."""
    return [place(report) for report in compilation(folder, text).diagnostics]


def place(report: Diagnostic) -> str:
    assert report.primary is not None
    return f"{report.primary.line}:{report.primary.column} {report.code}"


def test_without_a_comment_the_warning_is_there(tmp_path: Path) -> None:
    assert check(tmp_path, GOOD.format("")) == ["5:15 OSC603"]


@pytest.mark.parametrize(
    "comment",
    [
        "  #! allow OSC603",
        "  #! allow osc603: the simulator sends it",
        "  #! allow relaxed-event",
        "  #!allow Relaxed-Event:",
    ],
)
def test_a_warning_is_kept_back(tmp_path: Path, comment: str) -> None:
    assert check(tmp_path, GOOD.format(comment)) == []


def test_a_comment_above_the_statement(tmp_path: Path) -> None:
    text = GOOD.format("").replace("        wait", "        #! allow OSC603\n\n        wait")
    assert check(tmp_path, text) == []


def test_what_is_kept_back_is_counted(tmp_path: Path) -> None:
    settled = apply_suppressions([compilation(tmp_path, GOOD.format("  #! allow OSC603"))])
    assert [place(report) for report in settled.suppressed] == ["5:15 OSC603"]


def test_a_comment_elsewhere_is_not_used(tmp_path: Path) -> None:
    text = GOOD.format("").replace("scenario top:", "scenario top:  #! allow OSC603")
    assert check(tmp_path, text) == ["3:25 OSC701", "5:15 OSC603"]


def test_each_code_of_a_comment_must_be_of_use(tmp_path: Path) -> None:
    assert check(tmp_path, GOOD.format("  #! allow OSC603, OSC604")) == ["5:36 OSC701"]
    assert check(tmp_path, GOOD.format("  #! allow OSC603, OSC603")) == ["5:36 OSC701"]


def test_unknown_codes_are_reported_with_what_was_meant(tmp_path: Path) -> None:
    shown = compilation(tmp_path, GOOD.format("  #! allow OSC6033, relaxed-evnt")).diagnostics
    assert [(report.code, report.help) for report in shown] == [
        ("OSC603", "declare it: `event go`"),
        ("OSC702", "did you mean `OSC603`?"),
        ("OSC702", "did you mean `relaxed-event`?"),
    ]


def test_errors_cannot_be_suppressed(tmp_path: Path) -> None:
    text = "scenario top:\n    hero: nothing  #! allow OSC202\n"
    assert check(tmp_path, text) == ["2:11 OSC202", "2:29 OSC703"]


def test_reports_on_suppressions_cannot_be_suppressed(tmp_path: Path) -> None:
    text = GOOD.format("  #! allow OSC603, OSC604, OSC701")
    assert check(tmp_path, text) == ["5:36 OSC701", "5:44 OSC703"]


def test_a_comment_without_codes(tmp_path: Path) -> None:
    assert check(tmp_path, GOOD.format("  #! allow: yes")) == ["5:15 OSC603", "5:19 OSC704"]


def test_nothing_is_unused_where_errors_hide_what_it_is_for(tmp_path: Path) -> None:
    text = "scenario top:\n    hero: nothing\n    do serial:\n        wait @go  #! allow OSC604\n"
    assert "OSC701" not in " ".join(check(tmp_path, text))


def test_nothing_is_unused_before_all_stages_ran(tmp_path: Path) -> None:
    path = tmp_path / "a.osc"
    path.write_text(GOOD.format("  #! allow OSC603"), encoding="utf-8")
    made = Compilation(path, "a.osc", CARLA)
    assert made.ast is not None
    assert made.diagnostics == ()


def test_a_build_judges_files_without_scenarios_too(tmp_path: Path) -> None:
    path = tmp_path / "a.osc"
    path.write_text("struct s  #! allow OSC603\n", encoding="utf-8")
    made = Compilation(path, "a.osc", CARLA)
    assert made.module is not None
    assert "OSC603" not in made.module.python
    assert [place(report) for report in made.diagnostics] == ["1:20 OSC701"]


def test_comments_of_an_imported_file_count(tmp_path: Path) -> None:
    (tmp_path / "lib.osc").write_text(GOOD.format("  #! allow OSC603"), encoding="utf-8")
    assert check(tmp_path, 'import "lib.osc"\n') == []


def test_version_tags_are_no_suppressions(tmp_path: Path) -> None:
    assert check(tmp_path, "struct s  #! since 2.2\n\nstruct t  #! until 2.1\n") == []
