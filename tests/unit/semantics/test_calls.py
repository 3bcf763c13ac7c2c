"""Arguments of every kind of call: each mistake is reported once, at the smallest place."""

from collections.abc import Iterator

import pytest

from osc2tx.syntax import ast
from tests.unit.semantics.support import build_text

HEAD = """import osc.standard.all

namespace null use std, stdtypes

"""
PARAMETERS = "    pace: speed\n    count: int\n"
METHOD = "    def go(pace: speed, count: int) -> int is undefined\n"

# Each kind of call, with `{}` for its arguments; the parameters are `pace: speed, count: int`.
CALLS = {
    "scenario": f"scenario go:\n{PARAMETERS}scenario top:\n    do go({{}})\n",
    "scenario of an actor": (
        f"scenario vehicle.go:\n{PARAMETERS}"
        "scenario top:\n    hero: vehicle\n    do hero.go({})\n"
    ),
    "action": (
        f"action vehicle.go:\n{PARAMETERS}" "scenario top:\n    hero: vehicle\n    do hero.go({})\n"
    ),
    "inherited parameters": (
        "scenario base:\n    pace: speed\n    count: int\nscenario go inherits base\n"
        "scenario top:\n    do go({})\n"
    ),
    "modifier": f"modifier go:\n{PARAMETERS}scenario top:\n    go({{}})\n",
    "modifier in with": (
        f"modifier vehicle.go:\n{PARAMETERS}"
        "scenario top:\n    hero: vehicle\n    do hero.drive() with:\n        go({})\n"
    ),
    "modifier of an action": (
        f"modifier go of vehicle.drive:\n{PARAMETERS}"
        "scenario top:\n    hero: vehicle\n    do hero.drive() with:\n        go({})\n"
    ),
    "modifier of a composition": (
        f"modifier go:\n{PARAMETERS}"
        "scenario top:\n    do serial:\n        wait elapsed(1s)\n    with:\n        go({})\n"
    ),
    "method": f"struct box:\n{METHOD}scenario top:\n    b: box\n    n: int = b.go({{}})\n",
    "method of the type": f"struct top:\n{METHOD}    n: int = go({{}})\n",
    "call of a method": f"struct box:\n{METHOD}scenario top:\n    b: box\n    do call b.go({{}})\n",
    "emit": "scenario top:\n    event go(pace: speed, count: int)\n    do emit go({})\n",
    "emit in on": (
        "scenario top:\n    event go(pace: speed, count: int)\n"
        "    on @start:\n        emit go({})\n"
    ),
}
MAY_LEAVE_OUT = {
    "scenario", "scenario of an actor", "action", "inherited parameters",
    "modifier", "modifier in with", "modifier of an action", "modifier of a composition",
}  # fmt: skip

# Each mistake: arguments, code, the text it is reported at, the line of help.
MISTAKES = {
    "unknown name": ("3kph, 4, wind: 3", "OSC402", "wind", None),
    "misspelt name": ("pcae: 3kph, count: 4", "OSC402", "pcae", "did you mean `pace`?"),
    "name of another namespace": ("3kph, 4, std::pace: 3", "OSC402", "std::pace", None),
    "given twice by name": ("pace: 3kph, count: 4, count: 5", "OSC403", "count: 5", None),
    "given twice by place": ("3kph, 4, pace: 5kph", "OSC403", "pace: 5kph", None),
    "positional after named": (
        "pace: 3kph, 4", "OSC109", "4", "name it too, or put it first",
    ),
    "too many": ("3kph, 4, 5", "OSC405", "5", None),
    "wrong type": ('"fast", 4', "OSC301", '"fast"', None),
    "wrong type by name": ('pace: 3kph, count: "four"', "OSC301", '"four"', None),
    "wrong dimension": ("3m, 4", "OSC302", "3m", None),
    "wrong dimension of a product": ("3m * 4s, 4", "OSC302", "3m * 4s", None),
    "without unit": ("3, 4", "OSC303", "3", "write `3mps`"),
    "unknown unit": ("3kpx, 4", "OSC209", "kpx", "did you mean `kph`?"),
    "unknown value": ("3kph, nmber", "OSC201", "nmber", None),
    "wrong range": ("[3m..4m], 4", "OSC302", "3m", None),
}  # fmt: skip


def reports(call: str, arguments: str) -> Iterator[tuple[str, str, str | None]]:
    _, sink = build_text(HEAD + CALLS[call].format(arguments))
    for report in sink.sorted():
        assert report.primary is not None
        yield report.code, report.primary.text, report.help


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_reported_once(call: str, mistake: str) -> None:
    arguments, code, place, help_ = MISTAKES[mistake]
    if mistake == "wrong range" and call not in MAY_LEAVE_OUT:
        code, place = "OSC409", "[3m..4m]"
    found = list(reports(call, arguments))
    if mistake == "wrong range":  # both bounds are wrong
        found = found[:1]
    expected = [(code, place)]
    assert [(c, p) for c, p, _ in found] == expected
    if help_ is not None:
        assert found[0][2] == help_


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize(
    "arguments",
    ["3kph, 4", "pace: 3kph, count: 4", "count: 4, pace: 3kph", "3kph, count: 4", "36km / 2h, -4"],
)
def test_all_orders_are_accepted(call: str, arguments: str) -> None:
    assert list(reports(call, arguments)) == []


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("arguments", ["", "3kph", "count: 4"])
def test_a_missing_argument(call: str, arguments: str) -> None:
    """Invocations and modifiers leave parameters to the solver; methods and events do not."""
    if "emit" in call and not arguments:
        return  # `emit go()` is a syntax error of its own
    codes = {code for code, _, _ in reports(call, arguments)}
    assert codes == (set() if call in MAY_LEAVE_OUT else {"OSC404"})


@pytest.mark.parametrize("call", CALLS)
def test_a_range(call: str) -> None:
    """A range bounds a parameter of an invocation; a method takes one value (§7.3.7)."""
    codes = [code for code, _, _ in reports(call, "[3kph..4kph], 4")]
    assert codes == ([] if call in MAY_LEAVE_OUT else ["OSC409"])


COMPOSITION = "scenario top:\n    do {}:\n        wait elapsed(1s)\n        wait elapsed(2s)\n"


@pytest.mark.parametrize(
    ("head", "code", "place", "help_"),
    [
        ("serial(duratoin: 3s)", "OSC402", "duratoin", "did you mean `duration`?"),
        ("serial(overlap: start)", "OSC402", "overlap", None),
        ("one_of(start_to_start: 3s)", "OSC402", "start_to_start", None),
        ("parallel(std::overlap: start)", "OSC100", "std::overlap", None),
        ("serial(duration: 3s, duration: 4s)", "OSC403", "duration: 4s", None),
        ("serial(3s, duration: 4s)", "OSC403", "duration: 4s", None),
        ("serial(3s, 4s)", "OSC405", "4s", None),
        ("parallel(start, 4s)", "OSC405", "4s", None),
        ("parallel(duration: 4s, start)", "OSC109", "start", None),
        ("parallel(strat)", "OSC208", "strat", "did you mean `start`?"),
        ("parallel(overlap: 3s)", "OSC301", "3s", None),
        ("parallel(start_to_start: 3m)", "OSC302", "3m", None),
        ("parallel(end_to_end: 3)", "OSC303", "3", "write `3s`"),
        ("one_of(duration: [3m..4m])", "OSC302", "3m", None),
        ('serial("3s")', "OSC301", '"3s"', None),
        ("serial(duration: lenght)", "OSC201", "lenght", None),
    ],
)
def test_a_mistake_in_a_composition(head: str, code: str, place: str, help_: str | None) -> None:
    _, sink = build_text(HEAD + COMPOSITION.format(head))
    first = sink.sorted()[0]
    assert first.primary is not None
    assert {d.code for d in sink.sorted()} == {code}
    assert first.primary.text == place
    if help_ is not None:
        assert first.help == help_


@pytest.mark.parametrize(
    "head",
    [
        "serial", "serial(3s)", "serial(duration: [3s..4s])", "one_of(duration: 3s)",
        "parallel(equal)", "parallel(overlap: end, duration: 9s)",
        "parallel(start_to_start: [1s..2s], end_to_end: 3s)",
    ],
)  # fmt: skip
def test_arguments_of_compositions(head: str) -> None:
    _, sink = build_text(HEAD + COMPOSITION.format(head))
    assert [d.message for d in sink.sorted()] == []


LIBRARY = (
    "scenario top:\n    hero, npc: vehicle\n    walker: person\n    sky: environment\n"
    "    p: route_point\n    do {}\n"
)


@pytest.mark.parametrize(
    ("call", "code", "place"),
    [
        ("hero.drive() with:\n        speed(3kph, faster_than: npc, same_as: npc)",
         "OSC408", "npc"),
        ("hero.drive() with:\n        position(3m, time: 2s, ahead_of: npc)", "OSC408", "2s"),
        ("hero.drive() with:\n        position(3m, ahead_of: npc, behind: hero)", "OSC408", "hero"),
        ("hero.drive() with:\n        lane(side_of: npc, same_as: npc)", "OSC408", "npc"),
        ("hero.assign_position(position: hero.pose.position, route_point: p)", "OSC408", "p"),
        ("hero.change_lane(1, lft)", "OSC208", "lft"),
        ("hero.change_lane(num_of_lans: 1)", "OSC402", "num_of_lans"),
        ("hero.change_speed(30)", "OSC303", "30"),
        ("hero.change_speed(30m)", "OSC302", "30m"),
        ("hero.change_speed(30kph, rate_profile: smoth)", "OSC208", "smoth"),
        ("hero.drive(3m)", "OSC302", "3m"),
        ("hero.drive(duration: 3)", "OSC303", "3"),
        ("hero.drive(length: 3s)", "OSC402", "length"),
        ("walker.change_lane(1, left)", "OSC211", "change_lane"),
        ("hero.walk()", "OSC211", "walk"),
        ("hero.drve()", "OSC211", "drve"),
        ("hreo.drive()", "OSC201", "hreo"),
        ("drive()", "OSC407", "drive"),
        ("hero.speed.drive()", "OSC301", "hero.speed"),
        ("sky.fog(visual_range: 9m) with:\n        lane(1)", "OSC406", "lane"),
        ("hero.drive() with:\n        sped(3kph)", "OSC212", "sped"),
        ("hero.drive() with:\n        drive()", "OSC212", "drive"),
        ("hero.drive() with:\n        speed(3kph, at: middle)", "OSC208", "middle"),
        ("serial:\n        wait elapsed(1s)\n    with:\n        speed(3kph)", "OSC406", "speed"),
    ],
)  # fmt: skip
def test_a_mistake_in_a_call_of_the_library(call: str, code: str, place: str) -> None:
    _, sink = build_text(HEAD + LIBRARY.format(call))
    (report,) = sink.sorted()
    assert report.primary is not None
    assert (report.code, report.primary.text) == (code, place)


@pytest.mark.parametrize(
    ("call", "code", "place"),
    [
        ("numbers.count()", "OSC404", "count"),
        ("numbers.size(3)", "OSC405", "3"),
        ("numbers.count(it > 1, it > 2)", "OSC405", "it > 2"),
        ("numbers.count(when: it > 1)", "OSC402", "when"),
        ("numbers.cuont(it > 1)", "OSC208", "cuont"),
        ("numbers.count(it + 1)", "OSC301", "it + 1"),
        ("numbers.count(it > 3m)", "OSC303", "it"),
    ],
)
def test_a_mistake_in_a_list_operator(call: str, code: str, place: str) -> None:
    _, sink = build_text(f"{HEAD}struct top:\n    numbers: list of int\n    n: int = {call}\n")
    (report,) = sink.sorted()
    assert report.primary is not None
    assert (report.code, report.primary.text) == (code, place)


def test_every_argument_is_bound() -> None:
    model, _ = build_text(HEAD + CALLS["scenario"].format("count: 4, pace: 3kph"))
    (binding,) = [b for n, b in model.bindings.items() if isinstance(n, ast.Invocation)]
    assert [p.name for p, _ in binding.arguments] == ["count", "pace"]
