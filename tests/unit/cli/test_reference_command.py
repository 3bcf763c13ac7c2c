"""The reference of the library: every declaration, every member, nothing else."""

from __future__ import annotations

import json
import re

import pytest

from osc2tx.catalogue import catalogue
from osc2tx.reference import Entry, as_data, as_markdown, as_text, entries, find
from osc2tx.stdlib import LIBRARY, member_meanings
from tests.end_to_end.harness import REPOSITORY
from tests.unit.cli.shell import Shell

TEXT = "".join(
    (REPOSITORY / "osc2tx/stdlib" / name).read_text(encoding="utf-8") for name in LIBRARY
)


def test_every_declaration_of_the_library_has_an_entry() -> None:
    declared = re.findall(r"^(actor|action|modifier|struct|enum|type) ([\w.]+)", TEXT, re.MULTILINE)
    assert {each.key for each in entries()} == {f"{kind} {name}" for kind, name in declared}


def test_every_member_says_what_it_means() -> None:
    silent = [
        f"{each.declaration.name}.{member.name}"
        for each in entries()
        for member in each.declaration.members
        if not member.meaning and not _speaks_for_itself(each)
    ]
    silent += [each.key for each in entries() if not each.declaration.meaning]
    assert silent == []


def _speaks_for_itself(entry: Entry) -> bool:
    """Whether the names of the values of an enum are their meaning: all of them, or none."""
    members = entry.declaration.members
    return entry.declaration.kind == "enum" and not any(member.meaning for member in members)


def test_every_meaning_beside_the_library_is_needed() -> None:
    """One that a comment or a narrower one hides, or that no member has, would only mislead."""
    told = {
        (each.declaration.name, member.name): member.meaning
        for each in entries()
        for member in each.declaration.members
    }
    told |= {
        ("declarations", each.declaration.name): each.declaration.meaning for each in entries()
    }
    for owner, members in member_meanings().tables.items():
        for name, meaning in members.items():
            users = [
                key
                for key, found in told.items()
                if key[1] == name and found == meaning and owner in ("members", key[0])
            ]
            assert users, f"[{owner}] {name} is used by no member"


def test_every_action_and_modifier_of_the_catalogue_is_explained() -> None:
    explained = {each.declaration.name for each in entries() if each.shown.xml}
    standard = {name for name, entry in catalogue().actions.items() if entry.section}
    assert standard <= explained


def test_members_of_one_version_say_so() -> None:
    (entry,) = find("movable_object.change_position")
    versions = {each.name: each.version for each in entry.declaration.members}
    assert versions["target_position"] == "2.2"
    assert versions["target_xyz"] == versions["target_st"] == ""


def test_values_of_one_version_say_so(shell: Shell) -> None:
    """What a scenario of 2.1 cannot use is marked: in the enum, and where it is asked for."""
    assert (
        "\nOnly in 2.2: heavy_truck, micro_mobility_device, van,"
        in shell("reference", "vehicle_category").out
    )
    assert shell("reference", "van").out.startswith(
        "enum member vehicle_category.van, OpenSCENARIO DSL 2.2 section 8.7.16, only in 2.2\n"
    )


def test_users_of_a_type_are_named(shell: Shell) -> None:
    """An abstract type leads to those that one can use."""
    assert (
        "Used by: struct relative_path_pose_3d, struct relative_path_st,"
        in shell("reference", "relative_path").out
    )


def test_an_entry_as_the_standard_has_it() -> None:
    """Figures from the parameter table of the standard, 8.8.3.3."""
    data = as_data(find("vehicle.change_lane")[0])
    assert (data["kind"], data["name"]) == ("action", "vehicle.change_lane")
    assert data["section"] == "8.8.3.3"
    assert [(each["name"], each["type"], each["default"]) for each in data["members"]] == [
        ("num_of_lanes", "uint", "1"),
        ("side", "lane_change_side", ""),
        ("reference", "physical_object", "actor"),
        ("offset", "length", "0m"),
        ("rate_profile", "dynamic_profile", "none"),
        ("rate_peak", "speed", ""),
        ("target", "lane", ""),
    ]


def test_a_name_of_two_kinds_finds_both() -> None:
    assert [each.key for each in find("speed")] == ["type speed", "modifier speed"]
    assert [each.key for each in find("modifier speed")] == ["modifier speed"]


@pytest.mark.parametrize("entry", entries(), ids=lambda each: each.key)
def test_it_can_be_written_in_every_form(entry) -> None:
    declaration = entry.declaration
    for text in (as_text(entry), as_markdown(entry)):
        assert declaration.name in text
        assert all(member.name in text for member in declaration.members)
    assert json.loads(json.dumps(as_data(entry)))["name"] == declaration.name


def test_the_command_prints_it(shell: Shell) -> None:
    assert "Ends in the target lane, aligned with it" in shell("reference", "change_lane").out
    listed = shell("reference").out.splitlines()
    assert listed[: len(entries())] == [each.key for each in entries()]
    assert {"directive until", "event condition rise"} <= set(listed)
    names = [each["name"] for each in json.loads(shell("reference", "speed", "--json").out)]
    assert names[:2] == ["speed", "speed"]
    assert "movable_object.speed" in names
    gap = shell("reference", "space_gap").out
    assert gap.startswith("method traffic_participant.space_gap")
    assert "Also: " in shell("reference", "speed").out
    wrong = shell("reference", "chnge_lane")
    assert wrong.code == 2 and "did you mean `change_lane`?" in wrong.err


def test_codes_of_diagnostics_have_their_page_too(shell: Shell) -> None:
    assert shell("reference", "OSC302").out.strip() == shell("explain", "302").out.strip()
    (data,) = json.loads(shell("reference", "OSC302", "--json").out)
    assert data == json.loads(shell("explain", "302", "--json").out)


def test_an_action_shows_an_example_and_what_others_make_of_it(shell: Shell) -> None:
    """In the terminal, on the page and as data; the form is that of the schema."""
    (data,) = json.loads(shell("reference", "vehicle.change_lane", "--json").out)
    (entry,) = find("vehicle.change_lane")
    scenario = (REPOSITORY / data["file"]).read_text(encoding="utf-8")
    assert all(line.strip() in scenario for line in data["example"].splitlines())
    assert "change_lane(" in data["example"]
    assert "<LaneChangeAction>" in data["xml_example"]
    assert re.search(r"since OpenSCENARIO XML 1\.0", data["xml"])
    assert "throttle" in data["carla"]
    for text in (as_text(entry), as_markdown(entry)):
        shown = re.sub(r"^ +", "", text, flags=re.MULTILINE)
        for key in ("file", "example", "xml_example"):
            assert re.sub(r"^ +", "", data[key], flags=re.MULTILINE) in shown
        assert data["carla"].partition(":")[2] in text
