"""The rules of the style guide (§9.2.2), case by case."""

from __future__ import annotations

from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import DiagnosticSink, SourceFile
from osc2tx.formatter import format_source
from osc2tx.options import CompileOptions
from osc2tx.syntax import parse

LINES = [
    ("after commas", "f( a ,b,c )", "f(a, b, c)"),
    ("after colons", "ego.drive(speed :3mps)", "ego.drive(speed: 3mps)"),
    ("around operators", "keep(a>=b+1m and   not c=>d)", "keep(a >= b + 1m and not c => d)"),
    ("signs", "keep(x == - 3m - -y)", "keep(x == -3m - -y)"),
    ("inside of brackets", "x: length = a[ 1 ]", "x: length = a[1]"),
    ("ranges", "keep(x in [ 1m .. 2m ])", "keep(x in [1m..2m])"),
    ("lists", "keep(x in [1m ,2m])", "keep(x in [1m, 2m])"),
    ("brackets behind words", "keep (not(a) and(b))", "keep(not (a) and (b))"),
    ("the conditional operator", "keep(a==(b?c:d))", "keep(a == (b ? c : d))"),
    ("and a colon behind it", "f(a:b?c:d, e :f)", "f(a: b ? c : d, e: f)"),
    ("enumeration values", "f(color ! red)", "f(color!red)"),
    ("members and casts", "keep(a . b . as ( car ).c)", "keep(a.b.as(car).c)"),
    (
        "methods",
        "def f(x:int=1)->bool is  expression x>0",
        "def f(x: int = 1) -> bool is expression x > 0",
    ),
    ("fields", "x:length=3m", "x: length = 3m"),
    ("events", "event e is @ f as g if g.x>1m", "event e is @f as g if g.x > 1m"),
    ("lists of a type", "x:list   of int", "x: list of int"),
]


@pytest.mark.parametrize(
    ("before", "after"), [case[1:] for case in LINES], ids=[c[0] for c in LINES]
)
def test_blanks(before: str, after: str) -> None:
    assert formatted(f"scenario s:\n\t{before}\n") == f"scenario s:\n    {after}\n"


def test_blanks_at_file_level() -> None:
    assert formatted("export a,*,b::*\n") == "export a, *, b::*\n"
    assert formatted("import  osc . standard\n") == "import osc.standard\n"


def test_blanks_in_behavior() -> None:
    before = "scenario s:\n  do  a :serial (duration:3s) :\n    wait@e\n    b  :emit e\n"
    assert formatted(before) == (
        "scenario s:\n    do a: serial(duration: 3s):\n        wait @e\n        b: emit e\n"
    )


def test_blocks_are_indented_by_four() -> None:
    before = "scenario s:\n  a: car with:\n   keep(it.x == 1)\n  b: car\n"
    assert formatted(before) == (
        "scenario s:\n    a: car with:\n        keep(it.x == 1)\n    b: car\n"
    )


def test_blank_lines() -> None:
    before = "\n\nimport osc.standard\nactor a\nscenario s:\n\n  x: int\n\n\n  y: int"
    before += "\n\n\n\n\nactor b\n\n\n"
    assert formatted(before) == (
        "import osc.standard\nactor a\n\nscenario s:\n    x: int\n\n    y: int\n\n\nactor b\n"
    )


def test_a_declaration_with_a_block_stands_apart_with_its_comment() -> None:
    before = "actor a:\n  x: int\n# of b\nactor b:\n  x: int\nactor c\n"
    assert formatted(before) == (
        "actor a:\n    x: int\n\n# of b\nactor b:\n    x: int\n\nactor c\n"
    )


def test_comments() -> None:
    before = (
        "#one\nactor a: #two\n  x: int#three\n  #four\n #five\n#six\nactor b #  seven\n#!tool\n##\n"
    )
    assert formatted(before) == (
        "# one\nactor a:  # two\n    x: int  # three\n    # four\n    # five\n\n# six\n"
        "actor b  #  seven\n#!tool\n##\n"
    )


def test_comments_that_touch_the_block_above_stay_with_it() -> None:
    before = "actor a:\n  x: int\n# end::a[]\n\nactor b:\n  x: int\n# end::b[]\nactor c\n"
    assert formatted(before) == (
        "actor a:\n    x: int\n# end::a[]\n\nactor b:\n    x: int\n\n# end::b[]\nactor c\n"
    )


def test_comments_deeper_than_the_next_line_stay_with_the_line_above() -> None:
    before = "modifier m\n   # of m\n# of n\nmodifier n\n"
    assert formatted(before) == "modifier m\n    # of m\n# of n\nmodifier n\n"


def test_comments_at_the_end_of_blocks_stay_in_them() -> None:
    before = "scenario s:\n  do serial:\n    wait @e\n    # of the serial\n  # of the scenario\n"
    assert formatted(before) == (
        "scenario s:\n    do serial:\n        wait @e\n        # of the serial\n"
        "    # of the scenario\n"
    )


def test_what_fits_stands_on_one_line() -> None:
    assert formatted("enum e: [\n  a,\n  b\n]\n") == "enum e: [a, b]\n"
    assert formatted("scenario s:\n  keep(a \\\n    == 1)\n") == "scenario s:\n    keep(a == 1)\n"


def in_a_scenario(line: str) -> list[str]:
    """Return the lines of a line of a scenario, formatted, without its indentation."""
    first, *others = formatted(f"scenario s:\n  {line}\n").splitlines()
    assert first == "scenario s:"
    return [each.removeprefix("    ") for each in others]


def parameters(number: int) -> list[str]:
    return [f"parameter_{n}: {n}m" for n in range(number)]


def test_long_lines_are_broken_in_the_last_brackets_first() -> None:
    first = f"f({', '.join(f'argument_{n}' for n in range(5))})"
    assert in_a_scenario(f"x: length = {first} + g(another_name, one_more_name)") == [
        f"x: length = {first} + g(",
        "    another_name, one_more_name",
        ")",
    ]


def test_arguments_share_a_line_of_their_own_if_they_fit() -> None:
    names = ", ".join(parameters(5))
    assert in_a_scenario(f"do some_actor.some_action({names})") == [
        "do some_actor.some_action(",
        f"    {names}",
        ")",
    ]


def test_otherwise_each_argument_has_a_line() -> None:
    names = [*parameters(6), f"another: call({', '.join(parameters(5))})"]
    assert in_a_scenario(f"do some_actor.some_action({', '.join(names)})") == [
        "do some_actor.some_action(",
        *(f"    {name}," for name in parameters(6)),
        "    another: call(",
        f"        {', '.join(parameters(5))}",
        "    )",
        ")",
    ]


def test_a_single_argument_is_broken_inside() -> None:
    names = [f"point_{n}_of_the_path" for n in range(7)]
    assert in_a_scenario(f"do actor.move(along: road.path(points: [{', '.join(names)}]))") == [
        "do actor.move(along: road.path(points: [",
        *(f"    {name}," for name in names[:-1]),
        f"    {names[-1]}",
        "]))",
    ]


def test_a_list_that_is_the_first_argument_is_broken_inside() -> None:
    names = [f"point_{n}_of_the_path" for n in range(7)]
    assert in_a_scenario(f"do actor.move(along: path([{', '.join(names)}], is_open: true))") == [
        "do actor.move(along: path([",
        *(f"    {name}," for name in names[:-1]),
        f"    {names[-1]}",
        "], is_open: true))",
    ]
    others = [f"argument_{n}_of_the_path: true" for n in range(4)]
    assert in_a_scenario(f"do actor.move([{', '.join(names[:2])}], {', '.join(others)})") == [
        "do actor.move(",
        f"    [{', '.join(names[:2])}],",
        *(f"    {each}," for each in others[:-1]),
        f"    {others[-1]}",
        ")",
    ]


def test_long_conditions_are_broken_before_operators() -> None:
    terms = [f"a_rather_long_name_{n} == {n}m" for n in range(4)]
    whole, short = " and ".join(terms), "some_name == 1m and another == 2m or other == 3m"
    assert in_a_scenario(f"keep(not ({short}) or not ({short}))") == [
        "keep(",
        f"    not ({short})",
        f"    or not ({short})",
        ")",
    ]
    assert in_a_scenario(f"keep({whole})") == [
        "keep(",
        f"    {terms[0]}",
        *(f"    and {term}" for term in terms[1:]),
        ")",
    ]


def test_long_comparisons_and_sums_are_broken_before_operators() -> None:
    left, right = (" * ".join(f"{side}_{n}_of_several" for n in range(5)) for side in ("a", "b"))
    assert in_a_scenario(f"do wait rise({left} <= -{right})") == [
        "do wait rise(",
        f"    {left}",
        f"    <= -{right}",
        ")",
    ]
    assert in_a_scenario(f"x: length = f(-{left} - {right})") == [
        "x: length = f(",
        f"    -{left}",
        f"    - {right}",
        ")",
    ]


def test_comments_in_brackets_keep_their_places() -> None:
    before = "enum e: [a, # first\n  # about b\n  b  # last\n  # end\n]\n"
    assert formatted(before) == (
        "enum e: [\n    a,  # first\n    # about b\n    b  # last\n    # end\n]\n"
    )


def test_only_the_author_breaks_long_lines_outside_of_brackets() -> None:
    long = "x: length = " + " + ".join(["some_name"] * 9)
    assert formatted(f"scenario s:\n    {long}\n") == f"scenario s:\n    {long}\n"
    broken = long.replace("some_name + some_name", "some_name \\\n        + some_name", 1)
    assert formatted(f"scenario s:\n  {broken}\n") == f"scenario s:\n    {broken}\n"


def test_line_ends_and_marks() -> None:
    assert formatted("\ufeffactor a:\r\n  x: int\r\n") == "actor a:\n    x: int\n"
    assert formatted("actor a") == "actor a\n"
    assert formatted("") == ""
    assert formatted("# only a comment") == "# only a comment\n"


def test_strings_stay_as_they_are() -> None:
    text = 'scenario s:\n    x: string = """two\n   lines  # no comment"""\n'
    assert formatted(text) == text


def test_comments_of_other_languages_stay_where_they_are_allowed() -> None:
    source = SourceFile("s.osc", "/* one\n two */\nactor /* three */ a\n")
    assert format_source(source) == "/* one\n two */\nactor /* three */ a\n"


def test_a_text_with_syntax_errors_is_refused() -> None:
    compilation = Compilation(Path("s.osc"), "s.osc", CompileOptions(), text="actor (\n")
    assert compilation.formatted is None
    assert compilation.sink.has_errors


def test_a_text_with_errors_of_meaning_is_not() -> None:
    compilation = Compilation(Path("s.osc"), "s.osc", CompileOptions(), text="actor a inherits b\n")
    assert not compilation.check()
    assert compilation.formatted == "actor a inherits b\n"


def formatted(text: str) -> str:
    sink = DiagnosticSink()
    source = SourceFile("s.osc", text)
    parse(source, sink)
    assert not sink.has_errors, sink.sorted()
    return format_source(source)
