"""Every kind of member that the grammar lets a type have is carried out, refused or explained.

A member that a module silently leaves out is the worst mistake of a compiler. The kinds are those
of the syntax tree, so a new one fails here until somebody says what becomes of it.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import get_args

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.options import CompileOptions
from osc2tx.syntax import ast

HEAD = "import osc.standard.all\n\nnamespace null use std, stdtypes\n\n"


@dataclass(frozen=True)
class Case:
    """A member, and what becomes of it: a code, text of the module, or a reason for neither.

    Attributes:
        member: Its text.
        code: The code that refuses it.
        text: What the module says because of it.
        reason: Why it needs no code.
        before: Members before it.
        use: Member of the scenario in front of its `do`.
        do: Its `do`, if not the usual one.
    """

    member: str
    code: str | None = None
    text: str | None = None
    reason: str | None = None
    before: str = "x: int = 40"
    use: str = ""
    do: str = ""


ANY = "int with:\n        keep(it in [1..99])"
NEVER_READ = "members of an action are for the package that carries it out; nothing can read it"

OBJECT = {
    ast.EventDeclaration: Case("event seen", text="Wait(self.it__seen)", do="wait @it_.seen"),
    ast.ParameterDeclaration: Case("y: int = 41", text="y: int = 41"),
    ast.VariableDeclaration: Case("var y: int = 42", text="y: int = 42", do="wait it_.y == 42"),
    ast.KeepConstraint: Case("keep(x < 43)", text="within(1, 42)", before=f"x: {ANY}"),
    ast.RemoveDefault: Case("remove_default(x)", text='required("it_.x", int)'),
    ast.MethodDeclaration: Case(
        "def y() -> int is expression x * 44", text="* 44", do="wait it_.y() > 1"
    ),
    ast.CoverageDeclaration: Case("cover(x)", text='self.cover("it_.x"'),
}

CASES = {
    "struct": {**OBJECT, ast.ModifierApplication: Case("keep_lane()", code="OSC108")},
    "actor": {**OBJECT, ast.ModifierApplication: Case("speed(7mps)", text="speed(7 * mps)")},
    "action": {
        ast.EventDeclaration: Case(
            "event seen",
            code="OSC506",
            do="serial:\n        a: it_.thing(duration: 1s)\n        wait @a.seen",
        ),
        ast.ParameterDeclaration: Case("y: int = 41", text="y: Late[int] = 41"),
        ast.VariableDeclaration: Case("var y: int = 42", reason=NEVER_READ),
        ast.KeepConstraint: Case(
            "keep(x < 43)", text="self.keep(self.n < 43)", use=f"n: {ANY}", do="it_.thing(x: n)"
        ),
        ast.RemoveDefault: Case(
            "remove_default(x)", reason="what has no value then, is the package's"
        ),
        ast.MethodDeclaration: Case("def y() -> int is expression x * 44", reason=NEVER_READ),
        ast.CoverageDeclaration: Case("cover(x)", code="OSC501"),
        ast.ModifierApplication: Case("keep_lane()", code="OSC406"),
        ast.DoDirective: Case("do wait elapsed(1000ms)", text="Wait(elapsed(1000 * ms))"),
        ast.OnDirective: Case(
            "on elapsed(46s):\n        emit seen", code="OSC506", before="event seen"
        ),
    },
    "modifier": {
        ast.EventDeclaration: Case("event seen", code="OSC508"),
        ast.ParameterDeclaration: Case("y: int = 2", text="lane(2", before="lane(y)"),
        ast.VariableDeclaration: Case("var y: int = 42", code="OSC508"),
        ast.KeepConstraint: Case(
            "keep(x < 43)",
            text="within(1, 42)",
            before="x: int\n    lane(1)",
            use=f"n: {ANY}",
            do="it_.drive(duration: 1s) with:\n        thing(x: n)",
        ),
        ast.RemoveDefault: Case(
            "remove_default(x)",
            text='required("it_.drive.thing.x", int)',
            before="x: int = 1\n    lane(x)",
        ),
        ast.MethodDeclaration: Case(
            "def y() -> int is expression x * 2",
            text="lane(1 * 2)",
            before="x: int = 1\n    lane(y())",
        ),
        ast.CoverageDeclaration: Case("cover(x)", code="OSC508"),
        ast.ModifierApplication: Case("keep_lane()", text="keep_lane()"),
        ast.DoDirective: Case("do wait elapsed(45s)", code="OSC108"),
        ast.OnDirective: Case(
            "on elapsed(46s):\n        emit seen", text="elapsed(46 * s)", before="event seen"
        ),
    },
    "scenario": {
        ast.EventDeclaration: Case("event seen", text="self.seen = Event()"),
        ast.ParameterDeclaration: Case("y: int = 41", text='parameter("y", 41)'),
        ast.VariableDeclaration: Case("var y: int = 42", text="self.y = 42"),
        ast.KeepConstraint: Case("keep(x < 43)", text="at_most(42)"),
        ast.RemoveDefault: Case("remove_default(x)", text='required("x", int)'),
        ast.MethodDeclaration: Case(
            "def y() -> int is expression x * 44", text="def y(self) -> int"
        ),
        ast.CoverageDeclaration: Case("cover(x)", text='self.cover("x"'),
        ast.ModifierApplication: Case("it_.keep_lane()", text="keep_lane()"),
        ast.DoDirective: Case("y: int = 2", text="it_.drive("),
        ast.OnDirective: Case(
            "on elapsed(46s):\n        emit seen", text="elapsed(46 * s)", before="event seen"
        ),
    },
}

KINDS = {
    "struct": get_args(ast.StructMember),
    "actor": get_args(ast.StructMember),
    "action": get_args(ast.BehaviorBodyMember),
    "modifier": get_args(ast.BehaviorBodyMember),
    "scenario": get_args(ast.BehaviorBodyMember),
}

DECLARED = {
    "struct": "struct thing:",
    "actor": "actor thing inherits vehicle:",
    "action": "action vehicle.thing:",
    "modifier": "modifier vehicle.thing:",
}
DO = {
    "action": "it_.thing(duration: 1s)",
    "modifier": "it_.drive(duration: 1s) with:\n        thing()",
}


def source_of(owner: str, case: Case) -> str:
    """Return a scenario in which an object or invocation of such a type takes part."""
    its_type = "thing" if owner in ("struct", "actor") else "vehicle"
    lines = [f"    it_: {its_type}"]
    if owner == "struct":
        lines.append("    ego: vehicle")
    if owner == "scenario":
        lines += [f"    {case.before}", f"    {case.member}"]
    lines += [f"    {case.use}"] if case.use else []
    actor = "ego" if owner == "struct" else "it_"
    lines.append(f"    do {case.do or DO.get(owner, f'{actor}.drive(duration: 1s)')}")
    scenario = "\n".join(["scenario top:", *lines]) + "\n"
    if owner == "scenario":
        return HEAD + scenario
    return f"{HEAD}{DECLARED[owner]}\n    {case.before}\n    {case.member}\n\n{scenario}"


def flat() -> list[tuple[str, type[ast.Statement], Case]]:
    return [(owner, kind, case) for owner, cases in CASES.items() for kind, case in cases.items()]


@pytest.mark.parametrize("owner", list(CASES))
def test_every_kind_of_member_has_a_case(owner: str) -> None:
    kinds = set[type]()
    for kind in KINDS[owner]:
        kinds.update(get_args(kind) or (kind,))
    assert set(CASES[owner]) == kinds


@pytest.mark.parametrize(
    ("owner", "kind", "case"), flat(), ids=lambda each: getattr(each, "__name__", str(each)[:12])
)
def test_carried_out_or_refused(
    tmp_path: Path, owner: str, kind: type[ast.Statement], case: Case
) -> None:
    path = tmp_path / "input.osc"
    path.write_text(source_of(owner, case), encoding="utf-8")
    compilation = Compilation(path, path.name, CompileOptions())
    module = compilation.module
    errors = {d.code for d in compilation.diagnostics if d.severity.name == "ERROR"}
    assert errors == ({case.code} if case.code else set()), compilation.diagnostics
    assert sum(part is not None for part in (case.code, case.text, case.reason)) == 1
    if case.text is not None:
        assert module is not None
        assert case.text in module.python
