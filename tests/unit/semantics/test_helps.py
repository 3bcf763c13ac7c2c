"""What people write who know other tools, or the road: the help names what to write instead."""

from collections.abc import Sequence

import pytest

from tests.unit.semantics.support import build_text

HEAD = """\
import osc.standard.all

namespace null use std, stdtypes

modifier vehicle.calm:
    keep(it.duration == 3s)

scenario vehicle.count:
    var n: int = 3
    do drive(duration: 1s)

"""
FIELDS = ("ego: vehicle", "npc: vehicle", "event e", "l: list of int = [1, 2]")
DRIVE = "ego.drive(duration: 3s) with:\n            "

# At file level: text, code, part of the message, part of the help.
FILE = {
    "global variable": ("global var n: int = 3", "OSC100", "no global variables", "global n: int"),
    "extended modifier": ("extend vehicle.calm:\n    n: int", "OSC321", "a modifier", "of another"),
    "base as in Java": ("actor a extends vehicle", "OSC100", "`extends`", "inherits vehicle"),
    "base as in Python": ("actor a(vehicle):\n    n: int", "OSC100", "`(`", "inherits vehicle"),
    "base as in C++": ("actor a: vehicle", "OSC100", "`vehicle`", "inherits vehicle"),
    "class": ("class a:\n    n: int", "OSC100", "no statement `class`", "`struct`"),
    "function": ("function f():\n    n: int", "OSC100", "no statement", "def name(…)"),
    "enum with a block": ("enum a:\n    b\n    c", "OSC100", "in brackets", "[first, second]"),
}  # fmt: skip

IMPORT = {
    "file of ScenarioRunner": ('import "basic.osc"', "OSC205", "no file", "--dialect carla"),
    "namespace as module": ("import std.domain", "OSC205", "no module", "osc.standard.all"),
}  # fmt: skip

# A field of a scenario.
FIELD = {
    "sampled parameter": ("k: speed = sample(ego.speed, @e)", "OSC100", "only a variable", "`var`"),
    "True": ("a: bool = True", "OSC201", "`True`", "`true`"),
    "TRUE": ("a: bool = TRUE", "OSC201", "`TRUE`", "`true`"),
    "None": ("a: int = None", "OSC201", "`None`", "no empty value"),
    "size": ("a: uint = l.size", "OSC208", "no member `size`", "l.size()"),
    "length": ("a: uint = l.length()", "OSC208", "no method `length`", "`size`"),
    "method of 2.2": ('a: int = "x".length()', "OSC208", "no method", "--std 2.2"),
    "len": ("a: uint = len(l)", "OSC201", "no method `len`", "l.size()"),
    "1.": ("a: float = 1.", "OSC100", "`1.` is not a number", "`1.0`"),
    "digit first": ("1x: int", "OSC100", "`1x` is no name", None),
    "car": ("a: car", "OSC202", "no type `car`", "`vehicle`"),
    "pedestrian": ("a: pedestrian", "OSC202", "no type `pedestrian`", "`person`"),
    "direction": ("a: direction", "OSC202", "no type `direction`", "`side_left_right`"),
    "velocity": ("a: velocity", "OSC202", "no type `velocity`", "`speed`"),
    "list as in Python": ("a: list[int]", "OSC100", "a type name", "list of int"),
    "list as in Java": ("a: list<int>", "OSC100", "list of a type", "list of int"),
    "brackets as type": ("a: [int]", "OSC100", "a type name", "list of int"),
    "two equal signs": ("a: int == 3", "OSC100", "a type name", "int = 3"),
    "choice as in Python": ("a: int = 3 if true else 4", "OSC100", "`if`", "condition ? a : b"),
    "power": ("a: int = 2 ** 3", "OSC100", "no operator `**`", "multiply"),
    "division as in Python": ("a: int = 3 // 2", "OSC111", "a comment starts", "write `/`"),
    "hat": ("a: int = 2 ^ 3", "OSC102", "`^`", "multiply"),
    "percent": ("a: float = 50%", "OSC100", "remainder", "0.5"),
    "kilometres an hour": ("a: speed = 72km/h", "OSC201", "`h`", "`72kph`"),
    "metres a second": ("a: speed = 2.5m/s", "OSC201", "`s`", "`2.5mps`"),
    "kmh": ("a: speed = 72kmh", "OSC209", "no unit `kmh`", "`kph`"),
    "meters": ("a: length = 3meters", "OSC209", "no unit `meters`", "`m`"),
    "blank before a unit": ("a: speed = 20 kph", "OSC100", "without a blank", "`20kph`"),
    "without unit": ("a: speed = 20", "OSC303", "no unit", "`20mps`"),
    "string over two lines": ('a: string = "b\nc"', "OSC103", "no closing", "three quotes"),
    "constructor": ("a: position_3d = position_3d(x: 1m)", "OSC201", "a struct", "a field"),
    "assignment": ("ego.speed = 30kph", "OSC100", "no assignments", "keep(name == value)"),
}  # fmt: skip

# A member of `do serial`.
MEMBER = {
    "condition in a sum": ("wait rise(true) and true", "OSC201", "is used alone", "event e is"),
    "condition negated": ("wait not elapsed(3s)", "OSC201", "is used alone", "event e is"),
    "time alone": ("wait 2s", "OSC301", "not `time`", "elapsed(2s)"),
    "event alone": ("wait e", "OSC301", "not `event`", "`@e`"),
    "emit with @": ("emit @e", "OSC100", "`@`", "emit e"),
    "variable as argument": ("ego.count(n: 4)", "OSC402", "is a variable", "without `var`"),
    "repeat(3)": ("repeat(3):\n            ego.drive()", "OSC100", "no loops", "repeat"),
    "repeat 3": ("repeat 3:\n            ego.drive()", "OSC100", "no loops", "repeat"),
    "for": ("for i in l:\n            ego.drive()", "OSC100", "no loops", "repeat"),
    "while": ("while true:\n            ego.drive()", "OSC100", "no loops", "repeat"),
    "switch": ("switch 2:\n            ego.drive()", "OSC100", "no statement `switch`", "one_of"),
    "if": ("if ego.speed > 3mps:\n            ego.drive()", "OSC100", "no statement", "`wait`"),
    "sequence": ("sequence:\n            ego.drive()", "OSC100", "no composition", "`serial:`"),
    "mix": ("mix:\n            ego.drive()", "OSC100", "no composition", "`parallel:`"),
    "first_of": ("first_of:\n            ego.drive()", "OSC100", "no composition", "`one_of:`"),
    "unknown block": ("try:\n            ego.drive()", "OSC100", "no composition", "`serial:`"),
    "label of a block": ("right:\n            ego.drive()", "OSC100", "no composition", "label"),
    "with": ("ego.drive()\n            with:\n                until @e", "OSC100", "`with", "end"),
    "until behind": ("ego.drive() until @e", "OSC100", "`with:` block", "with:"),
    "for behind": ("ego.drive() for 3s", "OSC100", "behind a call", "duration: 3s"),
    "after behind": ("ego.drive() after 3s", "OSC100", "behind a call", "wait elapsed(3s)"),
    "lane_change": ("ego.lane_change(side: left)", "OSC211", "`lane_change`", "`change_lane`"),
    "set_speed": ("ego.set_speed(3mps)", "OSC211", "`set_speed`", "`assign_speed`"),
    "acceleration": ("ego.assign_acceleration(9.81m/s2)", "OSC201", "`s2`", "`9.81mpss`"),
    "near action": ("ego.drve()", "OSC211", "`drve`", "`drive`"),
    "no such action": ("ego.cut_in()", "OSC211", "`cut_in`", "scenario vehicle.cut_in:"),
    "event as action": ("ego.drive_distance(30m)", "OSC211", "`drive_distance`", "declare it"),
    "modifier as action": ("ego.keep_lane()", "OSC211", "a modifier", "with:"),
    "output": ('log("x")', "OSC211", "`log`", "record(…)"),
    "near name": ("egoo.drive()", "OSC201", "`egoo`", "`ego`"),
    "one more actor": ("npc3.drive()", "OSC201", "`npc3`", "npc3: vehicle"),
    "parameter of 2.2": (DRIVE + "speed(speed_range: [1mps..2mps])", "OSC402", "no", "--std 2.2"),
    "speed as argument": ("ego.drive(speed: 3mps)", "OSC402", "`speed`", "is a modifier"),
    "side as argument": ("ego.change_lane(right: 1)", "OSC402", "`right`", "`side: right`"),
    "lanes": ("ego.change_lane(lanes: 1)", "OSC402", "`lanes`", "`num_of_lanes: …`"),
    "target speed": ("ego.change_speed(speed: 3mps)", "OSC402", "`speed`", "`target: …`"),
    "unknown side": ("ego.change_lane(side: links)", "OSC208", "`links`", "`left`, `right`"),
    "heading": ("wait ego.heading > 1rad", "OSC208", "`heading`", "pose.orientation.yaw"),
    "time to collision": ("wait ego.ttc(npc) < 2s", "OSC208", "`ttc`", "time_to_collision"),
    "event of ScenarioRunner": ("wait @near_collision", "OSC210", "declared", "object_distance"),
    "undeclared event": ("wait @crash", "OSC210", "`crash`", "`event crash`"),
    "serial on one line": ("serial: ego.drive()", "OSC416", "a label", "end the line"),
    "semicolon": ("ego.drive();", "OSC102", "`;`", "semicolon"),
}  # fmt: skip

# A member of the `with:` block of `ego.drive()`.
MODIFIER = {
    "duration as modifier": ("duration(3s)", "OSC212", "not a modifier", "(duration: …)"),
    "duration as field": ("duration: 3s", "OSC108", "does not belong", "(duration: …)"),
    "until as field": ("until: true", "OSC108", "does not belong", "without a colon"),
    "speed as field": ("speed: 3mps", "OSC108", "does not belong", "`speed(…)`"),
    "timeout": ("timeout(3s)", "OSC212", "not a modifier", "(duration: …)"),
    "repeat": ("repeat(3)", "OSC212", "not a modifier", "no loops"),
    "velocity": ("velocity(3mps)", "OSC212", "`velocity`", "`speed`"),
    "right": ("lane(right: 1)", "OSC402", "`right`", "`side: right`"),
    "right of": ("lane(right_of: npc)", "OSC402", "`right_of`", "side_of: …, side: right"),
    "in front": ("position(3m, in_front_of: npc)", "OSC402", "`in_front_of`", "`ahead_of: …`"),
    "near argument": ("position(3m, ahead: npc)", "OSC402", "`ahead`", "`ahead_of`"),
    "begin": ("position(3m, at: begin)", "OSC208", "`begin`", "`start`"),
    "equal sign": ("speed(3mps, at=start)", "OSC100", "`=`", "`at: value`"),
    "range with one unit": ("speed([1..2]mps)", "OSC100", "both bounds", "[1mps..2mps]"),
    "range without brackets": ("speed(1mps..2mps)", "OSC100", "in brackets", "[1mps..2mps]"),
}  # fmt: skip


# What users of ScenarioRunner write, in dialect `carla`: a field or modifier of the scenario, a
# member of its `do`, or a modifier of `npc.drive(path)`.
CARLA_HEAD = """\
import basic.osc

scenario {name}:
    path: Path
    npc: Model3
{fields}    do serial:
        {member}
"""
CARLA = {
    "unknown model": ("    a: Mercedes\n", "", "OSC624", "actor Mercedes inherits vehicle"),
    "set_map alone": ('    set_map("Town05")\n', "", "OSC407", "path.set_map(…)"),
    "unit of a fork": ("    a: acceleration = 3kphps\n", "", "OSC613", "kmphps"),
    "True": ("    a: bool = True\n", "", "OSC201", "`true`"),
    "name alone": ("    npc3\n", "", "OSC100", "npc3: type"),
    "control in quotes": (
        "",
        'npc.drive(path) with:\n            follow_trajectory(control: "physics")',
        "OSC301",
        "`physics`",
    ),
    "adjust": ("", "npc.drive(path, adjust: true)", "OSC402", "leave `adjust: true` out"),
    "blank before a unit": (
        "",
        "npc.drive(path) with:\n            speed(20 kph)",
        "OSC100",
        "`20kph`",
    ),
    "speed in quotes": (
        "",
        'npc.drive(path) with:\n            speed("20kph")',
        "OSC301",
        "`20kph`",
    ),
    "side as name": (
        "",
        "npc.drive(path) with:\n            change_lane(lane_changes: 1, right: left)",
        "OSC402",
        "`side: left`",
    ),
    "label of two words": (
        "",
        "switch 2: parallel():\n            npc.drive(path)",
        "OSC100",
        "switch_2:",
    ),
    "label twice": (
        "",
        "get_ahead: npc.drive(path, duration: 1s)\n        get_ahead: npc.drive(path)",
        "OSC625",
        "a label of its own",
    ),
    "actor of the caller": ("", "other()", "OSC628", "npc: Model3"),
    "event of the runner": ("", "wait @drive_distance", "OSC603", "object_distance"),
}  # fmt: skip


@pytest.mark.parametrize(("fields", "member", "code", "help_"), CARLA.values(), ids=CARLA)
def test_constructs_of_users_of_scenario_runner(
    fields: str, member: str, code: str, help_: str
) -> None:
    """Each is a coded warning, or an error with what to write instead."""
    text = CARLA_HEAD.format(name="top", fields=fields, member=member or "npc.drive(path)")
    text += "\nscenario other:\n    do npc.drive(duration: 1s)\n"
    _, sink = build_text(text, dialect="carla")
    (report,) = [report for report in sink.sorted() if report.code == code]
    assert help_ in (report.help or "")
    assert report.severity.value == ("warning" if code.startswith("OSC6") else "error")
    errors = {r.code for r in sink.sorted() if r.severity.value == "error"}
    assert errors <= {code}


def scenario(*, fields: Sequence[str] = (), member: str = "wait elapsed(1s)") -> str:
    """A scenario with two vehicles."""
    lines = "".join(f"    {line}\n" for line in (*FIELDS, *fields))
    return f"{HEAD}scenario top:\n{lines}    do serial:\n        {member}\n        wait @e\n"


CASES = [
    *(pytest.param(text + "\n" + HEAD, *says, id=name) for name, (text, *says) in IMPORT.items()),
    *(pytest.param(HEAD + text + "\n", *says, id=name) for name, (text, *says) in FILE.items()),
    *(
        pytest.param(scenario(fields=[text]), *says, id=name)
        for name, (text, *says) in FIELD.items()
    ),
    *(
        pytest.param(scenario(member=text), *says, id=name)
        for name, (text, *says) in MEMBER.items()
    ),
    *(
        pytest.param(scenario(member=DRIVE + text), *says, id=name)
        for name, (text, *says) in MODIFIER.items()
    ),
]


@pytest.mark.parametrize(("text", "code", "message", "help_"), CASES)
def test_the_help_names_what_to_write(
    text: str, code: str, message: str, help_: str | None
) -> None:
    _, sink = build_text(text)
    reports = [report for report in sink.sorted() if report.code == code]
    assert len(reports) == 1, "one mistake, one report"
    assert [report.code for report in sink.sorted()] == [code]
    assert message in reports[0].message
    assert help_ is None or help_ in (reports[0].help or "")


def test_a_value_is_named_for_the_parameter_of_its_type() -> None:
    """A duration fits `time` and, as a range of one, `time_range` of 2.2."""
    _, sink = build_text(scenario(member=DRIVE + "position(2s, behind: npc)"), standard="2.2")
    (report,) = sink.sorted()
    assert (report.code, report.help) == ("OSC302", "write `time: 2s`")
