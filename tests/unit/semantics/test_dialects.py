"""What `asam` says about the names of a prelude, and what `carla` lets pass."""

import csv
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

from osc2tx.compilation.driver import Compilation
from osc2tx.diagnostics import Severity, SourceFile
from osc2tx.diagnostics.render import render_text
from osc2tx.options import CompileOptions
from osc2tx.semantics.declarations.library import shared_library
from osc2tx.semantics.dialects import (
    BEHAVIOR_ALIASES,
    ENUM_MEMBER_ALIASES,
    MEMBER_ALIASES,
    PARAMETER_ALIASES,
    PRELUDE_BEHAVIORS,
    PRELUDE_MEMBERS,
    PRELUDE_PARAMETERS,
    TYPE_ALIASES,
    UNIT_ALIASES,
)
from osc2tx.semantics.dump import dump_model
from osc2tx.semantics.names.member_lookup import member_names
from osc2tx.semantics.symbols import (
    ActionSymbol,
    ActorSymbol,
    EnumSymbol,
    FieldSymbol,
    ModifierSymbol,
    TypeSymbol,
)
from osc2tx.semantics.types import EnumType
from tests.unit.semantics.support import build, build_text, codes

HEAD = "import osc.standard\n\n"
RUNNER = Path(__file__).parents[2] / "golden" / "semantics" / "scenario_runner"
Golden = Callable[[str, Path], None]

# Files of the corpus in this dialect that check: repository and kind. These numbers only rise.
CHECKED = {
    ("carla-simulator/scenario_runner", "scenario"): 9,
    ("carla-simulator/scenario_runner", "stdlib"): 2,
    ("carla-simulator/scenario_runner", "fragment"): 3,
    ("carla-simulator/scenario_runner", "test"): 12,
    ("guardstrikelab/scenario_runner", "stdlib"): 1,
    ("hupf-PanoSim/PanoSim_OpenScenario2", "test"): 1,
    ("ydavs/scenario_runner", "scenario"): 21,
    ("ydavs/scenario_runner", "stdlib"): 1,
}


def prelude_names() -> tuple[set[str], set[tuple[str, str]], set[tuple[str, str]]]:
    members, parameters, behaviors = set(), set(), set()
    for symbol in shared_library("2.1", "carla", "all").scope.declared:
        if isinstance(symbol, ActionSymbol) and symbol.origin == "prelude":
            assert symbol.actor is not None
            behaviors.add((symbol.actor.name, symbol.name))
        if not isinstance(symbol, TypeSymbol) or symbol.origin == "prelude":
            continue
        for member in symbol.members.values():
            if isinstance(member, FieldSymbol) and member.origin == "prelude":
                if isinstance(symbol, ModifierSymbol | ActionSymbol):
                    parameters.add((symbol.name, member.name))
                elif isinstance(symbol, ActorSymbol):
                    members.add(member.name)
    return members, parameters, behaviors


def standard_members() -> set[str]:
    scope = shared_library("2.1", "asam", "all").scope
    actors = [s for s in scope.declared if isinstance(s, ActorSymbol)]
    return {name for actor in actors for name in member_names(actor)}


def test_asam_knows_what_the_prelude_adds() -> None:
    members, parameters, behaviors = prelude_names()
    assert members - standard_members() <= set(PRELUDE_MEMBERS)
    assert parameters == set(PRELUDE_PARAMETERS)
    assert behaviors == set(PRELUDE_BEHAVIORS)


def test_relaxations_are_reported_once_per_file() -> None:
    text = HEAD + "scenario s:\n    a: speed = 3\n    b: length = 4\n    do wait elapsed(5)\n"
    assert codes(build_text(text, dialect="carla")[1]) == ["OSC605"]
    assert codes(build_text(text)[1]) == ["OSC303"] * 3


def test_carla_needs_no_import() -> None:
    text = "scenario s:\n    v: vehicle\n    do v.drive()\n"
    assert codes(build_text(text, dialect="carla")[1]) == []


def test_use_statement_is_understood_after_its_report() -> None:
    text = "import osc.standard.all\n\nuse std.stdtypes\n\nscenario s:\n    v: vehicle\n"
    assert codes(build_text(text)[1]) == ["OSC110"]
    assert codes(build_text(text, dialect="carla")[1]) == ["OSC601"]


def test_events_are_declared_by_their_first_use() -> None:
    text = HEAD + (
        "scenario s:\n    do serial:\n        wait @go\n        emit go\n        emit stop(3)\n"
    )
    model, sink = build_text(text, dialect="carla")
    assert codes(sink) == ["OSC603", "OSC603"]
    assert [n for n, m in model.scenarios[0].members.items() if getattr(m, "is_implicit", 0)] == [
        "go",
        "stop",
    ]
    assert codes(build_text(text)[1]) == ["OSC210", "OSC210"]


@pytest.mark.parametrize("dialect", ["asam", "carla"])
def test_scenario_for_scenario_runner(dialect: str, golden: Golden) -> None:
    path = RUNNER / "scenario.osc"
    source = SourceFile(path.name, path.read_text(encoding="utf-8"), path)
    model, sink = build(source, dialect=dialect)
    assert sink.has_errors == (dialect == "asam")
    reports = "\n".join(render_text(d) for d in sink.sorted())
    golden(reports, RUNNER / "expected" / f"{dialect}.txt")
    if dialect == "carla":
        golden(dump_model(model), RUNNER / "expected" / "model.txt")


def test_aliases_name_what_the_library_has() -> None:
    scope = shared_library("2.1", "asam", "all").scope
    for code, standard in TYPE_ALIASES.items():
        assert scope.types_named(standard)
        assert not scope.types_named(code)
    for code, standard in UNIT_ALIASES.items():
        assert scope.unit_named(standard)
        assert not scope.unit_named(code)
    for (enum, member), standard in ENUM_MEMBER_ALIASES.items():
        (symbol,) = [s for s in scope.types_named(enum) if isinstance(s, EnumSymbol)]
        assert standard in symbol.members
        assert member not in symbol.members
    for (owner, member), standard in MEMBER_ALIASES.items():
        (type_,) = scope.types_named(owner)
        assert isinstance(type_, TypeSymbol)
        assert standard in member_names(type_)
        assert member not in member_names(type_)
    for (_, behavior), standard in BEHAVIOR_ALIASES.items():
        assert scope.behaviors_named(standard)
        assert not scope.behaviors_named(behavior)


@pytest.mark.parametrize(("callee", "written"), PARAMETER_ALIASES)
def test_parameter_aliases_name_what_the_library_has(callee: str, written: str) -> None:
    scope = shared_library("2.1", "asam", "all").scope
    alias = PARAMETER_ALIASES[callee, written]
    named = [*scope.modifiers_named(callee), *scope.behaviors_named(callee)]
    (symbol,) = [s for s in named if alias.parameter in s.members]
    assert written not in symbol.members
    if alias.implied is not None:
        parameter, member = alias.implied
        field = symbol.members[parameter]
        assert isinstance(field, FieldSymbol)
        assert isinstance(field.type, EnumType)
        assert member in field.type.symbol.members


def test_alias_means_what_the_standard_writes() -> None:
    text = HEAD + (
        "scenario s:\n    a: vehicle\n    b: vehicle\n    do a.drive() with:\n        lane({})\n"
    )
    dumps = []
    for arguments in ("right_of: b", "side_of: b, side: right"):
        model, _ = build_text(text.format(arguments), dialect="carla")
        (binding,) = [b for b in model.bindings.values() if b.callee.name == "lane"]
        dumps.append([(p.name, model.type_of(value)) for p, value in binding.arguments])
    assert dumps[0] == dumps[1]


def test_asam_says_which_dialect_has_a_type_or_modifier() -> None:
    declared = shared_library("2.1", "carla", "all").scope.declared
    prelude = [s for s in declared if s.origin == "prelude"]
    types = [s.name for s in prelude if isinstance(s, ActorSymbol | EnumSymbol)]
    fields = "".join(f"    f{index}: {name}\n" for index, name in enumerate(types))
    _, sink = build_text(f"{HEAD}scenario s:\n{fields}")
    assert [(d.code, d.help) for d in sink.sorted()] == [
        ("OSC202", "check with `--dialect carla`")
    ] * len(types)
    modifiers = [s.name for s in prelude if isinstance(s, ModifierSymbol)]
    lines = "".join(f"    v.{name}()\n" for name in modifiers)
    _, sink = build_text(f"{HEAD}scenario s:\n    v: vehicle\n{lines}")
    assert {d.code for d in sink.sorted()} == {"OSC212"}


def test_block_comments_and_imports_without_quotes(tmp_path: Path) -> None:
    path = tmp_path / "top.osc"
    (tmp_path / "basic.osc").write_text("actor Path\nactor Model3\n", encoding="utf-8")
    text = "import basic.osc\n/* a comment\n   of two lines */\nscenario top:\n    hero: Model3\n"
    path.write_text(text, encoding="utf-8")
    carla = Compilation(path, path.name, CompileOptions(dialect="carla"))
    assert carla.model is not None
    assert {d.code for d in carla.diagnostics} == {"OSC610", "OSC616", "OSC617"}
    asam = Compilation(path, path.name, CompileOptions())
    assert asam.model is None
    assert [d.code for d in asam.diagnostics] == ["OSC111"]


def test_each_name_is_reported_once() -> None:
    text = HEAD + "scenario s:\n    a, b: velocity\n    c: velocity\n    d: Model3\n    e: Model3\n"
    assert codes(build_text(text, dialect="carla")[1]) == ["OSC612", "OSC610"]


def test_own_declarations_come_before_the_prelude() -> None:
    text = HEAD + (
        "actor Path:\n    width: length\n\nscenario s:\n    p: Path with:\n"
        "        keep(it.width == 3m)\n"
    )
    assert codes(build_text(text, dialect="carla")[1]) == []


def test_type_of_a_field_brings_its_constraints() -> None:
    text = HEAD + (
        'actor cab inherits Model3:\n    keep(it.color == "0,0,0")\n\n'
        'scenario s:\n    c: cab with:\n        keep(it.name == "ego")\n'
    )
    model, sink = build_text(text, dialect="carla")
    assert not sink.has_errors
    field = model.scenarios[0].members["c"]
    assert isinstance(field, FieldSymbol)
    assert [c.expression.span.text for c in field.constraints] == [
        'it.model == "vehicle.tesla.model3"',
        'it.color == "0,0,0"',
        'it.name == "ego"',
    ]


def test_units_declared_again_keep_the_value_of_the_library() -> None:
    text = HEAD + (
        "unit kph of speed is SI(m: 1, s: -1, factor: 0.2778)\n\nscenario s:\n    a: speed = 1kph\n"
    )
    model, sink = build_text(text, dialect="carla")
    assert codes(sink) == ["OSC616"]
    assert [unit.origin for node, unit in model.units.items() if node.span.text == "1kph"] == [
        "library"
    ]
    assert codes(build_text(text)[1]) == ["OSC203"]


@pytest.mark.slow
def test_corpus_checks_at_least_as_well_as_it_did(test_data: Path) -> None:
    corpus = test_data / "corpus"
    with (corpus / "MANIFEST.csv").open(newline="", encoding="utf-8") as manifest:
        rows = [row for row in csv.DictReader(manifest) if row["dialect"] == "carla-sr"]
    passed: Counter[tuple[str, str]] = Counter()
    for row in rows:
        options = CompileOptions(dialect="carla")
        compilation = Compilation(corpus / row["file"], row["file"], options)
        checks = compilation.model is not None and not any(
            d.severity is Severity.ERROR and not d.code.startswith("OSC5")
            for d in compilation.diagnostics
        )
        passed[row["repo"], row["kind"]] += checks
    assert {key: passed[key] for key in CHECKED if passed[key] < CHECKED[key]} == {}
