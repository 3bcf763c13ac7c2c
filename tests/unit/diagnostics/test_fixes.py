"""Fixes remove what they are for, and bring no new error."""

import os
import re
from collections import Counter
from pathlib import Path

import pytest

from osc2tx.building.fixing import fix_text
from osc2tx.building.jobs import job_for
from osc2tx.compilation.driver import Compilation
from osc2tx.compilation.inputs import Input
from osc2tx.config import ConfigFiles, GivenOptions
from osc2tx.diagnostics import Diagnostic, Severity, SourceFile, Span
from osc2tx.diagnostics.fixes import Edit, Fix, apply_edits, compatible
from osc2tx.syntax.dump import dump_ast
from osc2tx_shared.classes import replace

HIDING = {"OSC202"}  # a value of an unknown type fits everywhere
DATA = os.environ.get("OSC2TX_TEST_DATA", "")
PUBLIC = sorted(Path(DATA, "corpus").rglob("*.osc")) if DATA else []
CASES = sorted((Path(__file__).parents[2] / "golden" / "diagnostics").glob("*/input.osc"))


def found_in(path: Path, text: str) -> tuple[Diagnostic, ...]:
    compilation = job(path).compilation(text=text)
    compilation.check()
    return compilation.diagnostics


def job(path: Path):  # type: ignore[no-untyped-def]
    item = Input(path, path, path.parent, is_asked=True)
    return job_for(item, GivenOptions(), ConfigFiles().for_source(path))


def errors(found: tuple[Diagnostic, ...]) -> Counter[str]:
    return Counter(d.code for d in found if d.severity is Severity.ERROR)


def is_syntax(code: str) -> bool:
    return code.startswith("OSC1")


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.parent.name)
def test_each_fix_removes_its_diagnostic(path: Path) -> None:
    text = path.read_bytes().decode()
    before = found_in(path, text)
    for diagnostic in before:
        for fix in diagnostic.fixes:
            check_fix(path, text, before, diagnostic, fix)


@pytest.mark.skipif(not PUBLIC, reason="the folder of public scenarios is not named")
def test_fixes_of_public_scenarios() -> None:
    """Of what is found several times in a file, the first is fixed."""
    fixed = 0
    for path in PUBLIC:
        text = path.read_bytes().decode("utf-8", "replace")
        before = found_in(path, text)
        first = {d.code: d for d in reversed(before) if d.fixes}
        for diagnostic in first.values():
            for fix in diagnostic.fixes:
                check_fix(path, text, before, diagnostic, fix)
                fixed += 1
    assert fixed > 200


def check_fix(
    path: Path, text: str, before: tuple[Diagnostic, ...], diagnostic: Diagnostic, fix: Fix
) -> None:
    """Check that a fix removes its diagnostic, and, if it is safe, that no error is new."""
    after = found_in(path, apply_edits(text, fix.edits))
    same, earlier = (Counter((d.code, d.message) for d in found) for found in (after, before))
    key, at = (diagnostic.code, diagnostic.message), line_of(diagnostic)
    stays = any((d.code, d.message) == key and line_of(d) == at for d in after)
    assert not stays or same[key] < earlier[key], (path, diagnostic, fix.title)
    old, new = errors(before), errors(after)
    if any(map(is_syntax, old)):  # what stands behind a syntax error was not found before
        old, new = (Counter({c: n for c, n in e.items() if is_syntax(c)}) for e in (old, new))
    if fix.is_safe and diagnostic.code not in HIDING:
        assert not new - old, (path, diagnostic, fix.title, new - old)


def line_of(diagnostic: Diagnostic) -> int:
    return 0 if diagnostic.primary is None else diagnostic.primary.line


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.parent.name)
def test_a_safe_fix_leaves_other_declarations_alone(path: Path) -> None:
    """Declarations that no edit touches have the same syntax tree before and after."""
    text = path.read_bytes().decode()
    compilation = job(path).compilation(text=text)
    compilation.check()
    if any(is_syntax(code) for code in errors(compilation.diagnostics)):
        return  # the tree of such a text lacks what was not understood
    before = trees(compilation)
    for fix in (f for d in compilation.diagnostics for f in d.fixes if f.is_safe):
        if any(edit.span.source is not compilation.source for edit in fix.edits):
            continue
        fixed = job(path).compilation(text=apply_edits(text, fix.edits))
        kept = [tree for node, tree in before if not any(touches(node, e) for e in fix.edits)]
        after = [tree for _, tree in trees(fixed)]
        assert not Counter(kept) - Counter(after), fix.title


def trees(compilation: Compilation) -> list[tuple[Span, str]]:
    """Return the declarations of a file with their trees, without positions."""
    assert compilation.ast is not None
    found = []
    for node in (*compilation.ast.imports, *compilation.ast.statements):
        statement = replace(compilation.ast, imports=(), statements=(node,))
        _, _, tree = dump_ast(statement).partition("\n")
        found.append((node.span, re.sub(r"\d+:\d+-(\d+:)?\d+", "", tree)))
    return found


def touches(span: Span, edit: Edit) -> bool:
    return edit.span.start <= span.end and span.start <= edit.span.end


def test_how_many_codes_have_fixes() -> None:
    codes = {
        d.code for path in CASES for d in found_in(path, path.read_bytes().decode()) if d.fixes
    }
    assert len(codes) >= 30, sorted(codes)


def span(source: SourceFile, start: int, end: int) -> Span:
    return Span(source, start, end)


def test_edits_are_applied_from_left_to_right_whatever_their_order() -> None:
    source = SourceFile("a.osc", "one two three")
    edits = [
        Edit(span(source, 8, 13), "3"),
        Edit(span(source, 0, 3), "1"),
        Edit(span(source, 3, 3), "!"),
    ]
    assert apply_edits(source.text, edits) == "1! two 3"


def test_overlapping_edits_are_refused() -> None:
    source = SourceFile("a.osc", "one two")
    with pytest.raises(ValueError, match="overlap"):
        apply_edits(source.text, [Edit(span(source, 0, 4), ""), Edit(span(source, 3, 5), "")])


def test_of_fixes_that_touch_each_other_the_first_is_kept() -> None:
    source = SourceFile("a.osc", "one two three")
    first = Fix("first", (Edit(span(source, 0, 3), "1"), Edit(span(source, 8, 13), "3")))
    second = Fix("second", (Edit(span(source, 3, 5), ""),))
    third = Fix("third", (Edit(span(source, 5, 6), ""),))
    assert compatible([third, second, first]) == [first, third]


SLIPS = """import osc.standard

scenaro hello:
    ego: vehicle
    npc: vehicle
    do serial
        ego.drive(duration: 5 s) with:
            speed(10kph..20kph, at start)
            lane(1, side_of: npc, side: left)
        npc.drive(duration = 3s) with:
            speed(30kph)
        wait elapsed(2s);
"""
MENDED = """import osc.standard

scenario hello:
    ego: vehicle
    npc: vehicle
    do serial:
        ego.drive(duration: 5s) with:
            speed([10kph..20kph], at: start)
            lane(1, side_of: npc, side: left)
        npc.drive(duration: 3s) with:
            speed(30kph)
        wait elapsed(2s)
"""


def test_fixes_are_applied_until_none_is_left(tmp_path: Path) -> None:
    fixed = fix_text(job(tmp_path / "a.osc"), SLIPS, unsafe=False)
    assert fixed.text == MENDED
    assert fixed.applied == 7


def test_unsafe_fixes_are_applied_only_on_demand(tmp_path: Path) -> None:
    text = MENDED.replace("vehicle\n    npc", "vehicel\n    npc")
    assert fix_text(job(tmp_path / "a.osc"), text, unsafe=False).text == text
    assert fix_text(job(tmp_path / "a.osc"), text, unsafe=True).text == MENDED
