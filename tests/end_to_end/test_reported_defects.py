"""Small scenarios that once went wrong: each has the outcome that the standard gives it.

The files are test data, in the folder `defects`; its README names the right outcome of each.
"""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path

import pytest

from osc2tx.options import XmlOptions, XmlProfile
from osc2tx_runtime import RunSettings
from tests.unit.backends.xosc.checks import schema_errors
from tests.unit.cli.shell import Shell
from tests.xosc.parity import FINE, LONG, Given, check, is_exact, played, scenarios

# What is never read and what never changes: that is in the nature of small cases.
OF_SMALL_CASES = {"OSC430", "OSC431", "OSC436", "OSC437"}
FOUND = re.compile(r"^[\w.]+:(\d+):\d+: (?:error|warning)\[(OSC\d+)\]: (.*)$", re.M)


@dataclass(frozen=True)
class Row:
    """A file with its outcome.

    Attributes:
        file: Its name.
        end: Seconds that the run takes.
        events: All that happen, in order, where the file tells by them.
        code: Of the command.
        found: Diagnostics as line and code, in order.
        says: Part of the first message, or of what is printed.
        options: Of the command.
        seeds: How many runs have this outcome.
    """

    file: str
    end: float | None = None
    events: str | None = None
    code: int = 0
    found: tuple[str, ...] = ()
    says: str = ""
    options: tuple[str, ...] = ()
    seeds: int = 1

    def __str__(self) -> str:
        return " ".join((self.file, *self.options))


def refused(file: str, found: str, says: str, *options: str, code: int = 3) -> Row:
    return Row(file, code=code, found=(found,), says=says, options=options)


def failed(file: str, found: str, says: str) -> Row:
    return refused(file, found, says, code=5)


STEPS = (("--dt", "0.05"), ("--dt", "0.1"), ("--dt", "0.02"))
COLLISION = "collision at 1.85 s: ego, other"

ROWS = [
    Row("global_map", 3.0),
    Row("global_actor_placed", 3.0),
    Row("range_in_range_2_2", 0.0, options=("--std", "2.2")),
    refused("speed_beyond_any_world", "6 OSC516", "no world has so large a quantity"),
    Row("override_before_its_base", 1.0),
    Row("until_in_a_range_of_durations", 3.0, "done@3", seeds=10),
    refused("minimum_duration_by_idling", "4 OSC519", "5 s here contradict the 2 s"),
    Row("one_of_shorter_than_asked", 3.0, "long@3", seeds=10),
    Row("one_of_shorter_than_asked", 3.0, "long@3", options=("--one-of", "seeded"), seeds=10),
    Row("one_of_shorter_than_asked", 3.0, "long@3", options=("--one-of", "first")),
    refused("until_against_duration", "8 OSC439", "earlier than its duration of 5 s"),
    Row("short_waits_add_up", 1.1, "done@0.1", found=tuple(f"{n} OSC440" for n in range(6, 16))),
    *(Row("assignments_take_no_time", 5.0, "done@4", options=dt) for dt in STEPS),
    refused("one_occurrence_an_instant", "14 OSC809", "wait k == 2", "--max-time", "5", code=5),
    Row("event_named_by_a_keyword", 1.0, "from@1 seen@1", options=("--signal", "from@1s")),
    Row("handlers_at_the_last_instant", 1.0, "a@1 b@1 c@1 d@1"),
    Row("on_fail_of_a_member", None, "f@0 one.fail@0", 5, ("9 OSC809",), "it takes 500.00 s"),
    Row("modifier_as_a_member", 3.0),
    failed("all_the_time_but_never", "23 OSC810", "`position` does not hold from 1.00 to 3.00 s"),
    failed("distance_cut_by_until", "18 OSC810", "it has covered is 20.00, not 60.00 m"),
    Row("type_as_receiver", 3.0, found=("4 OSC415", "9 OSC415"), says="the only one"),
    Row("dut_as_receiver_carla", 2.0, found=("9 OSC622",), options=("--dialect", "carla")),
    refused("action_without_actor", "7 OSC804", "no global action `log`", code=5),
    refused("struct_member_keep", "12 OSC804", "no action `spawn`", code=5),
    Row("along_with_lane", 3.0),
    Row("same_name_in_two_namespaces", 1.0),
    Row("two_conditional_subtypes", 1.0),
    Row("numeric_equation", 0.0),
    Row("difference_of_dates", 2.0),
    Row("literals", 0.0),
    refused("plus_is_for_floats", "4 OSC100", "numbers with a point or an exponent"),
    refused("unexported_enum", "11 OSC215", "`crimson` is not visible here"),
    refused(
        "silent_other_carriageway", "13 OSC802", "npc overlaps ego by 3.60 m 201 m from", code=5
    ),
    Row("draws_beyond_the_map", seeds=10),
    Row("behind_one_not_yet_placed", 3.0, seeds=10),
    Row("thin_set_of_eight", 0.2, seeds=5),
    Row("division_before_its_guard", 0.2, seeds=20),
    Row("elements_of_a_sized_list", 0.2, seeds=5),
    Row("union_of_ranges", 0.2, seeds=10),
    Row("assign_speed_is_reached", 2.0, "after@1"),
    Row("collision_is_a_success", 11.45, says=COLLISION),
    Row("collision_is_a_success", code=5, says=COLLISION, options=("--fail-on", "collision")),
    Row("draws_from_the_sidecar", 1.0, options=("--scenario", "two", "--seed", "1")),
    Row("comments_attach", 1.0),
    Row("duration_given_to_a_free_change", 7.0, "done@7", seeds=3),
    Row("durations_choose_starts_and_draws", 13.0, "m@2 first@5 second@10 done@13", seeds=5),
    Row("global_fixed_by_a_scenario", 0.0, "done@0"),
    Row("range_that_is_no_literal", options=("--std", "2.2"), seeds=3),
    Row("sample_seen_by_its_own_event", 2.0, "now@1 seen@1"),
    Row(
        "scenario_derived_by_condition",
        4.0,
        "a@1 done@4",
        options=("--scenario", "scenario_derived_by_condition"),
    ),
    Row("constraint_of_constants", code=3, found=("6 OSC421", "7 OSC421")),
    Row("conversion_without_a_member", code=3, found=("6 OSC426", "7 OSC426")),
    Row("enum_value_of_another", 0.0, options=("--std", "2.2")),
    refused("list_too_short_for_an_element", "7 OSC420", "element `l[2]` contradicts"),
    Row("recursive_method_in_a_keep", 1.0),
    Row("undefined_but_never_invoked", 1.0),
    refused("unit_parts_in_order", "3 OSC100", "exponents come first, then `factor`"),
    refused("rate_peak_never_above_zero", "11 OSC513", "`rate_peak` must be above 0"),
    refused("light_has_no_behaviors", "12 OSC301", "<traffic_light_controller>.set_state("),
    refused("map_that_is_not_there", "6 OSC443", "did you mean `highway.xodr`?", code=4),
    Row("set_of_two_values", 2.0, seeds=2),
    Row("end_in_the_lane_of_one_that_moved", 9.0, "done@9"),
    Row("first_instant_sees_an_invented_place", 2.0, "done@2"),
    Row("distance_along_the_road", 1.0, "done@1"),
    Row("enters_in_the_second_phase", 7.0, "done@7"),
    Row("abreast_in_one_lane", 1.0, options=("--std", "2.2")),
    Row("back_from_over_the_line", 7.0, "done@7"),
    Row("range_of_accelerations_to_an_end", 4.0, "done@4", options=("--std", "2.2")),
    Row("event_of_an_element", 2.0, "go_on.begun@0"),
    Row("recursion_with_a_way_out", 1.0),
    Row("behavior_as_a_field", 1.0),
    Row("modifier_with_an_on", 2.0),
    Row("field_added_to_vehicle", 1.0, "done@1"),
    Row("until_cuts_waits_short", 2.0, "done@2", found=("5 OSC433",)),
]

# Documents that are exact.
DOCUMENTS = (
    "xml_trailer_is_not_instant",
    "xml_peak_beyond_default_limits",
    "xml_distance_to_an_oncoming_reference",
    "xml_distance_to_a_turned_obstacle",
    "xml_time_to_collision_beside",
    "xml_start_speed_of_a_later_actor",
    "xml_walker_walks_on",
    "xml_relative_lane_after_a_junction",
    "xml_follows_a_speed_too_fast",
    "xml_offset_against_s",
    "xml_on_then_wait_for_the_same",
    "xml_position_at_the_end",
    "xml_speed_beyond_performance",
    "xml_walker_sets_out",
)
REACTS = "xml_on_reacts_each_time"


# Known and not yet corrected; each gets a row when it is.
OPEN: set[str] = set()


@pytest.fixture
def folder(test_data: Path) -> Path:
    found = test_data / "defects"
    if not found.is_dir():
        pytest.skip("the test data have no folder `defects`")
    return found


def header_and_events(trace: Path) -> tuple[dict[str, object], str]:
    """Return the first line of a trace, and all events as `name@time`."""
    lines = [json.loads(line) for line in trace.read_text(encoding="utf-8").splitlines()]
    events = (f"{each['name']}@{each['t']:g}" for each in lines if each["kind"] == "event")
    return lines[0], " ".join(events)


def test_every_file_has_a_row(folder: Path) -> None:
    listed = {row.file for row in ROWS} | {*DOCUMENTS, REACTS, *OPEN}
    assert listed == {path.stem for path in folder.glob("*.osc")}


@pytest.mark.parametrize("row", ROWS, ids=str)
def test_outcome(row: Row, folder: Path, shell: Shell) -> None:
    shell.write(f"{row.file}.osc", (folder / f"{row.file}.osc").read_text(encoding="utf-8"))
    for seed in range(row.seeds):
        given = row.options if "--seed" in row.options else ("--seed", seed, *row.options)
        ended = shell("run", *given, "--trace", "trace.jsonl", f"{row.file}.osc")
        said = ended.err + ended.out  # why a run fails is what the command is asked for
        found = [each for each in FOUND.findall(said) if each[1] not in OF_SMALL_CASES]
        assert ended.code == row.code, ended.err
        assert tuple(f"{line} {code}" for line, code, _ in found) == row.found
        assert row.says in said
        if row.end is not None:
            assert f"success after {row.end:.2f} s" in said
        if row.events is not None:
            assert header_and_events(Path("trace.jsonl"))[1] == row.events


@pytest.mark.parametrize("profile", ["generic", "esmini"])
@pytest.mark.parametrize("file", DOCUMENTS)
def test_document(file: str, profile: XmlProfile, folder: Path) -> None:
    xml = XmlOptions(profile=profile)
    given = Given(folder / f"{file}.osc", RunSettings(dt=FINE), xml=xml)
    (document,) = scenarios(given)
    assert is_exact(document), document.report.obstacles
    assert document.xml is not None
    assert schema_errors(document.xml, given.xml.version) == []
    check(given, document)


def test_a_document_reacts_each_time(folder: Path, tmp_path: Path) -> None:
    """Its parallel is over before its duration: the run fails, and the document still ends."""
    text = (folder / f"{REACTS}.osc").read_text(encoding="utf-8")
    path = tmp_path / f"{REACTS}.osc"
    path.write_text(text, encoding="utf-8")
    (whole,) = scenarios(Given(path))
    assert whole.xml is not None
    assert played(whole.xml, 0.1).end < LONG
    shorter = tmp_path / "shorter.osc"
    shorter.write_text(text.replace("(duration: 20s)", ""), encoding="utf-8")
    given = Given(shorter)
    (document,) = scenarios(given)
    assert is_exact(document)
    check(given, document)


MOTION = """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    spot: position_3d with:
        keep(it.x == 200m)
        keep(it.y == -8m)
        keep(it.z == 0m)
    do serial:
        {0}
            {1}
            speed(10mps, at: start)
        ego.change_lane(side: left, duration: 3s)
"""
AT_POINT = "position(at_point: spot, at: start)"
CHANGE = (
    "ego.change_speed(target: 30mps, rate_peak: 1mpss, rate_profile: constant, duration: {}) with:"
)


@pytest.mark.parametrize("lane", ["", "\n            lane(3, at: start)"])
def test_a_point_is_moved_to_the_nearest_lane_of_a_known_map(tmp_path: Path, lane: str) -> None:
    path = tmp_path / "point.osc"
    text = MOTION.format("ego.drive(duration: 2s) with:", AT_POINT + lane)
    path.write_text(text, encoding="utf-8")
    given = Given(path)
    (document,) = scenarios(given)
    assert is_exact(document), document.report.obstacles
    check(given, document)


@pytest.mark.parametrize(("duration", "fits"), [("1s", False), ("20s", True)])
def test_no_document_of_a_change_that_always_fails(
    tmp_path: Path, duration: str, fits: bool
) -> None:
    path = tmp_path / "change.osc"
    path.write_text(MOTION.format(CHANGE.format(duration), AT_POINT), encoding="utf-8")
    (document,) = scenarios(Given(path))
    assert (document.xml is not None) is fits
    reasons = [entry.reason for entry in document.report.obstacles]
    assert fits or "with rate_peak 1 m/s^2 it takes 20.00 s, not 1 s: every run fails" in reasons


def test_no_actor_and_no_method_is_no_error_of_a_check(folder: Path, shell: Shell) -> None:
    """It warns that no installed package brings the action, as a run would refuse it."""
    for file in ("action_without_actor", "struct_member_keep"):
        checked = shell("check", folder / f"{file}.osc")
        assert checked.code == 0
        assert re.findall(r"(\w+)\[(\w+)\]", checked.err) == [("warning", "OSC804")]


def test_values_in_order_are_in_order(folder: Path, shell: Shell) -> None:
    shell("run", "--trace", "trace.jsonl", folder / "thin_set_of_eight.osc")
    values = header_and_events(Path("trace.jsonl"))[0]["parameters"]
    assert isinstance(values, dict)
    assert len(values) == 8
    assert list(values.values()) == sorted(values.values())


def test_drawn_values_lie_where_they_may(folder: Path, shell: Shell) -> None:
    """Of a union, between elements of a list, and of what a division must not meet."""
    for seed in range(10):
        values = {}
        for file in ("union_of_ranges", "elements_of_a_sized_list", "division_before_its_guard"):
            shell("run", "--seed", seed, "--trace", "trace.jsonl", folder / f"{file}.osc")
            found = header_and_events(Path("trace.jsonl"))[0]["parameters"]
            assert isinstance(found, dict)
            values.update(found)
        assert 0.0 <= values["b"] <= 4.0 or 6.0 <= values["b"] <= 8.0
        assert 1.0 <= values["xs.0"] <= 2.0
        assert 12 / (values["i"] - values["j"]) > 3


def test_the_module_alone_decides_what_is_drawn(folder: Path, shell: Shell) -> None:
    path = shell.write("two.osc", (folder / "draws_from_the_sidecar.osc").read_text("utf-8"))
    shell("build", "--target", "py", "-o", "out", path)
    drawn = []
    for edit in (None, "{}", "away"):
        sidecar = Path("out", "two.map.json")
        if edit == "away":
            sidecar.unlink()
        elif edit is not None:
            sidecar.write_text(edit, encoding="utf-8")
        options = ("--scenario", "two", "--seed", "1", "--trace", "trace.jsonl")
        assert shell("run", *options, "out/two.py").code == 0
        drawn.append(header_and_events(Path("trace.jsonl"))[0]["parameters"])
    assert drawn[0] == drawn[1] == drawn[2]


def test_comments_stand_above_what_they_are_about(folder: Path, shell: Shell) -> None:
    shell("build", "--target", "py", "-o", "out", folder / "comments_attach.osc")
    text = Path("out", "comments_attach.py").read_text(encoding="utf-8")
    assert "end::a" not in text.partition("class Top")[2]
    rows = [row.strip() for row in text.splitlines()]
    below = rows.index("# speed(99kph)")
    assert rows[below - 2 : below] == ["self.ego.drive(", "speed(30 * kph)"]


def test_a_replayed_path_takes_a_new_speed_at_once(tmp_path: Path, shell: Shell) -> None:
    """A replay need not be physical: 100 m at 20 m/s take 5 s, in world and XML."""
    path = shell.write(
        "replay.osc",
        """import osc.standard.all

namespace null use std, stdtypes

scenario top:
    road: map with:
        keep(it.map_file == "highway.xodr")
    ego: vehicle
    begin: pose_3d with:
        keep(it.position.x == 50m)
        keep(it.position.y == -8.75m)
        keep(it.position.z == 0m)
    far: pose_3d with:
        keep(it.position.x == 150m)
        keep(it.position.y == -8.75m)
        keep(it.position.z == 0m)
    way: path with:
        keep(it.points == [begin, far])
        keep(it.interpolation == straight_line)
    do serial:
        ego.drive(duration: 1s) with:
            position(45m, at: start)
            lane(2)
            speed(5mps)
        ego.replay_path(absolute: way) with:
            speed(20mps)
""",
    )
    ended = shell("run", path)
    assert ended.code == 0
    assert "success after 6.00 s" in ended.out + ended.err
    given = Given(path)
    (document,) = scenarios(given)
    assert is_exact(document), document.report.obstacles
    check(given, document)
