"""No input raises, and no input grows the stack."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from osc2tx.semantics.dump import dump_model
from osc2tx.semantics.symbols import EnumSymbol
from tests.unit.semantics.support import build_text, codes

HEAD = "import osc.standard\n\n"
SAMPLE = """import osc.standard.all

namespace demo use std, stdtypes

enum mood: [calm, angry = 7, mad]

struct pair:
    a, b: length with:
        keep(it in [1m..3m])
    def sum() -> length is expression a + b

scenario vehicle.approach:
    lead: vehicle
    p: pair
    event near(gap: length)
    event close is rise(actor.object_distance(lead, longitudinal) < 12m)
    on @near as n if n.gap > 3m:
        emit near(gap: n.gap)
    do serial(duration: [5s..40s]):
        drive() with:
            position(p.sum(), behind: lead, at: start)
            until @close
        one_of:
            w: wait elapsed(3s)
            lead.drive() with:
                keep(it.duration < 3s)

extend vehicle:
    mood: mood = calm
"""
WORDS = sorted(set(SAMPLE.replace("(", " ( ").replace(")", " ) ").replace(".", " . ").split()))


def test_sample_is_valid() -> None:
    _, sink = build_text(SAMPLE)
    assert [d.message for d in sink.sorted()] == []


@pytest.mark.parametrize("operator", ["+", "-", "*", "and", "or", "=>", "==", "in"])
def test_long_chains(operator: str) -> None:
    chain = f" {operator} ".join(["a"] * 2000)
    model, _ = build_text(f"struct s:\n    a: int\n    b: int = {chain}\n")
    assert dump_model(model)


@pytest.mark.parametrize(
    "expression",
    [
        "not " * 150 + "a",
        "(" * 150 + "a" + ")" * 150,
        "f(" * 150 + "a" + ")" * 150,
        "a[" * 150 + "0" + "]" * 150,
        "[" * 150 + "a" + "]" * 150,
        "a" + ".as(bool)" * 2000,
    ],
)
def test_deep_expressions(expression: str) -> None:
    """What the syntax lets through does not end in a `RecursionError`."""
    head = "struct s:\n    a: bool\n    def f(x: bool) -> bool is undefined\n"
    model, sink = build_text(f"{head}    b: bool = {expression}\n")
    assert "OSC105" not in codes(sink)
    assert dump_model(model)


def test_long_paths() -> None:
    model, sink = build_text(f"struct s:\n    a: s\n    b: s = a{'.a' * 3000}\n")
    assert codes(sink) == []
    assert model.types


@pytest.mark.slow
@settings(max_examples=60)
@given(st.data())
def test_mutated_programs(data: st.DataObject) -> None:
    """Swap words of a valid program for others; nothing may raise."""
    lines = SAMPLE.splitlines()
    for _ in range(data.draw(st.integers(1, 4))):
        index = data.draw(st.integers(0, len(lines) - 1))
        words = lines[index].split(" ")
        place = data.draw(st.integers(0, len(words) - 1))
        words[place] = data.draw(st.sampled_from(WORDS))
        lines[index] = " ".join(words)
    dialect = data.draw(st.sampled_from(["asam", "carla"]))
    model, _ = build_text("\n".join(lines) + "\n", dialect=dialect)
    dump_model(model)


@pytest.mark.slow
@settings(max_examples=40)
@given(st.data())
def test_dropped_lines(data: st.DataObject) -> None:
    """Leave lines out; nothing may raise."""
    lines = [line for line in SAMPLE.splitlines() if data.draw(st.integers(0, 4))]
    model, _ = build_text("\n".join(lines) + "\n")
    dump_model(model)


def test_a_long_chain_of_enum_values() -> None:
    """Each link is followed once, whatever their number."""
    last = 20_000
    members = ", ".join(f"m{i} = m{i + 1}" for i in range(last))
    model, sink = build_text(f"enum e: [{members}, m{last} = 7]\n", standard="2.2")
    assert codes(sink) == []
    (symbol,) = model.symbols
    assert isinstance(symbol, EnumSymbol)
    assert {member.value for member in symbol.members.values()} == {7}


def test_a_circle_of_enum_values_is_reported_once() -> None:
    members = ", ".join(f"m{i} = m{(i + 1) % 2000}" for i in range(2000))
    _, sink = build_text(f"enum e: [{members}]\n", standard="2.2")
    assert codes(sink) == ["OSC312"]
