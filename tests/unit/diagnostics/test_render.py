"""How diagnostics look."""

from pathlib import Path

import pytest

from osc2tx.diagnostics import Diagnostic, Label, Severity, SourceFile, Span
from osc2tx.diagnostics.render import display_name, render_all, render_text


def span_of(source: SourceFile, part: str) -> Span:
    start = source.text.index(part)
    return Span(source, start, start + len(part))


def error(span: Span | None, **more: object) -> Diagnostic:
    return Diagnostic("OSC213", Severity.ERROR, "no such thing", span, **more)  # type: ignore[arg-type]


def rows(text: str, part: str) -> list[str]:
    """Return the rendered source lines and marks for a part of a text."""
    source = SourceFile("a.osc", text)
    return render_text(error(span_of(source, part))).splitlines()[1:]


def test_place_severity_code_message_line_and_carets() -> None:
    source = SourceFile("a.osc", "scenario top:\n  hero: vehicel\n")
    assert render_text(error(span_of(source, "vehicel"))) == (
        "a.osc:2:9: error[OSC213]: no such thing\n"
        "   2 |   hero: vehicel\n"
        "     |         ^^^^^^^\n"
    )


def test_section_of_the_standard_stands_behind_the_message() -> None:
    diagnostic = Diagnostic("OSC104", Severity.ERROR, "no block", None)
    assert render_text(diagnostic) == "error[OSC104]: no block (§7.2.1.4)\n"


def test_labels_notes_and_help_follow_in_this_order() -> None:
    source = SourceFile("a.osc", "hero: vehicle\n" + "\n" * 9 + "hero: person\n")
    diagnostic = Diagnostic(
        "OSC213",
        Severity.WARNING,
        "declared twice",
        Span(source, 23, 27),
        labels=(Label(Span(source, 0, 4), "first declared here"),),
        notes=("names count once", "even in extensions"),
        help="rename one",
    )
    assert render_text(diagnostic) == (
        "a.osc:11:1: warning[OSC213]: declared twice\n"
        "   11 | hero: person\n"
        "      | ^^^^\n"
        "  a.osc:1:1: first declared here\n"
        "    1 | hero: vehicle\n"
        "      | ^^^^\n"
        "  note: names count once\n"
        "  note: even in extensions\n"
        "  help: rename one\n"
    )


def test_tabs_become_blanks_and_carets_follow() -> None:
    assert rows("\ta\tbad\n", "bad") == ["   1 |     a   bad", "     |         ^^^"]


def test_wide_characters_take_two_carets_and_accents_none() -> None:
    assert rows("車 = 車両\n", "車両") == ["   1 | 車 = 車両", "     |      ^^^^"]
    assert rows("e\u0301 bad\n", "bad")[1] == "     |   ^^^"


def test_span_over_two_lines_shows_both() -> None:
    assert rows("do serial:\n  wait\n", "serial:\n  wait") == [
        "   1 | do serial:",
        "     |    ^^^^^^^",
        "   2 |   wait",
        "     |   ^^^^",
    ]


def test_span_over_many_lines_leaves_out_the_middle() -> None:
    assert rows("a:\n  b\n  c\n  d\n", "a:\n  b\n  c\n  d") == [
        "   1 | a:",
        "     | ^^",
        " ... |",
        "   4 |   d",
        "     |   ^",
    ]


@pytest.mark.parametrize("text", ["abc", "abc\n"])
def test_empty_span_at_the_end_gets_one_caret(text: str) -> None:
    source = SourceFile("a.osc", text)
    end = Span(source, len(text), len(text))
    assert render_text(error(end)).splitlines()[-1].count("^") == 1


def test_a_text_that_is_not_there_is_not_shown() -> None:
    end = Span(SourceFile("a.osc", ""), 0, 0)
    assert render_text(error(end)) == "a.osc:1:1: error[OSC213]: no such thing\n"


def test_span_of_a_line_end_points_behind_the_line() -> None:
    assert rows("abc\r\ndef\n", "\r\n") == ["   1 | abc", "     |    ^"]


def test_long_line_is_cut_around_the_span() -> None:
    line, marks = rows("x" * 500 + "bad" + "y" * 500, "bad")
    assert len(line) < 180
    assert line.count("…") == 2
    assert line[marks.index("^") :].startswith("bady")


def test_nothing_in_a_source_steers_the_terminal() -> None:
    source = SourceFile("a\x1b[2J.osc", "a \x1b[31m\u202e bad\n")
    diagnostic = Diagnostic("OSC213", Severity.ERROR, "no `\x07`\nat all", span_of(source, "bad"))
    text = render_text(diagnostic)
    assert not {"\x1b", "\x07", "\u202e"} & set(text)
    assert text.count("\n") == 3


def test_color_only_when_asked_for() -> None:
    source = SourceFile("a.osc", "bad\n")
    diagnostic = error(span_of(source, "bad"))
    assert "\x1b[" not in render_text(diagnostic)
    assert "\x1b[31merror[OSC213]" in render_text(diagnostic, color=True)


def test_several_are_separated_by_an_empty_line() -> None:
    assert render_all([error(None), error(None)]).count("\n\n") == 1
    assert render_all([]) == ""


def test_files_are_cited_relative_to_the_folder_of_the_reader(tmp_path: Path) -> None:
    inside = SourceFile("x.osc", "", tmp_path / "sub" / "x.osc")
    outside = SourceFile("y.osc", "", tmp_path.parent / "y.osc")
    assert display_name(inside, tmp_path.resolve()) == "sub/x.osc"
    assert display_name(outside, tmp_path.resolve()) == str(tmp_path.parent.resolve() / "y.osc")
    assert display_name(SourceFile("z.osc", ""), tmp_path) == "z.osc"
    assert display_name(inside, None) == "x.osc"
