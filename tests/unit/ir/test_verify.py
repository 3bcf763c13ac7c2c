"""The verifier refuses IR that no correct lowering makes."""

from dataclasses import replace

import pytest

from osc2tx import ir
from osc2tx.diagnostics import InternalCompilerError, SourceFile, Span
from osc2tx.ir.dump import dump_ir

SPAN = Span(SourceFile("case.osc", "scenario case:\n"), 0, 8)
SPEED = ir.ValueType(ir.Kind.QUANTITY, "speed")
VEHICLE = ir.ValueType(ir.Kind.ACTOR, "vehicle")
KPH = ir.Unit("kph", 1 / 3.6, 0.0, True)


def quantity(value: float) -> ir.Quantity:
    return ir.Quantity(span=SPAN, type=SPEED, value=value, unit=KPH)


def field(name: str, type_: ir.ValueType = SPEED) -> ir.FieldRef:
    return ir.FieldRef(span=SPAN, type=type_, name=name)


def variable(name: str, value: ir.Expression) -> ir.Variable:
    return ir.Variable(name=name, span=SPAN, type=SPEED, value=value)


def event(name: str) -> ir.Event:
    return ir.Event(name=name, span=SPAN, trigger=None, is_implicit=False)


def actor(name: str) -> ir.Actor:
    return ir.Actor(name=name, span=SPAN, type="vehicle", lineage=("vehicle",), values=())


def wait_for(name: str, label: str | None = None) -> ir.Wait:
    trigger = ir.Trigger(span=SPAN, event=ir.EventRef(span=SPAN, name=name), condition=None)
    return ir.Wait(span=SPAN, label=label, name="wait", trigger=trigger)


def serial(*members: ir.Behavior) -> ir.Serial:
    return ir.Serial(span=SPAN, label=None, name="serial", members=members)


def module(*declarations: ir.Declaration, body: ir.Behavior) -> ir.Module:
    scenario = ir.Scenario(
        name="case",
        span=SPAN,
        comments=(),
        declarations=declarations,
        methods=(),
        placements=(),
        body=body,
    )
    return ir.Module(
        source="case.osc", standard="2.1", dialect="asam", one_of="race", scenarios=(scenario,)
    )


GOOD = module(event("go"), variable("v", quantity(3)), body=serial(wait_for("go")))


def test_a_correct_module_passes() -> None:
    ir.verify(GOOD)


@pytest.mark.parametrize(
    ("broken", "message"),
    [
        (module(event("go"), event("go"), body=wait_for("go")), "'go' stands twice"),
        (module(body=wait_for("go")), "reference to event 'go'"),
        (module(event("go"), body=serial()), "empty composition"),
        (
            module(event("go"), body=serial(wait_for("go", "a"), wait_for("go", "a"))),
            "'a' stands twice",
        ),
        (
            module(variable("a", field("b")), variable("b", quantity(1)), body=wait_for("go")),
            "reference to field 'b'",
        ),
        (replace(GOOD, scenarios=GOOD.scenarios * 2), "'case.osc:0' stands twice"),
    ],
)
def test_a_broken_module_is_our_bug(broken: ir.Module, message: str) -> None:
    with pytest.raises(InternalCompilerError, match=message):
        ir.verify(broken)


def test_an_actor_must_act() -> None:
    not_an_actor = ir.Invoke(
        span=SPAN,
        label=None,
        name="drive",
        actor=field("v"),
        owner="vehicle",
        action="drive",
        arguments=(),
        modifiers=(),
    )
    with pytest.raises(InternalCompilerError, match="actor of 'drive'"):
        ir.verify(module(variable("v", quantity(1)), body=not_an_actor))
    ir.verify(module(actor("v"), body=replace(not_an_actor, actor=field("v", VEHICLE))))


def test_the_dump_shows_every_node_with_its_line() -> None:
    assert dump_ir(GOOD) == (
        "module case.osc (standard 2.1, dialect asam, one_of race)\n"
        "  scenario case @1\n"
        "    event go @1\n"
        "    variable v: speed = 3kph @1\n"
        "    Serial 'serial' @1\n"
        "      Wait @go @1\n"
    )
