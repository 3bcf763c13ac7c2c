"""The reference of the language: every example checks, every method has one."""

import re

import pytest

from osc2tx import compile_text
from osc2tx.diagnostics import Severity
from osc2tx.reference import declarations, find_topics, topics
from osc2tx.syntax import tokens as t

LANGUAGE = [topic for topic in topics() if topic.is_of_language]
METHODS = [topic for topic in topics() if topic.kind == "method"]
# Words that are described where they belong to, or that need no description of their own.
PLAIN = {"as", "by", "expression", "external", "hard", "default", "if", "inherits", "is", "of"}
PLAIN |= {"only", "SI", "type", "undefined", "unit"}
# What the lines of methods use, by name.
FIELDS = {
    "road": "road: map",
    "ego": "ego: vehicle",
    "other": "other: vehicle",
    "sky": "sky: environment",
    "way": "way: route",
    "exit": "exit: route",
    "light": "light: traffic_light",
    "lights": "lights: traffic_light_group",
    "bulbs": "bulbs: list of traffic_light_bulb with:\n"
    "        keep(it.size() == 1)\n"
    "        keep(it[0].color == red)",
    "meaning": "meaning: semantic_traffic_light_state",
    "ramp": "ramp: common_speed_shape",
    "goal": "goal: xyz_point = road.create_xyz_point(x: 50m, y: 0m, z: 0m)",
    "along": "along: route_point",
    "spot": 'spot: odr_point = road.create_odr_point(road_id: "1", s: 50m, t: 0m)',
    "from": "from: pose_3d",
    "to": "to: pose_3d",
    "driver": "driver: behavioral_model",
    "ahead": "ahead: relative_path_pose_3d with:\n        keep(it.points == [from, to])",
    "timed": "timed: relative_trajectory_pose_3d with:\n"
    "        keep(it.points == [from, to])\n"
    "        keep(it.time_stamps == [0s, 5s])",
}
NEEDS = {"goal": "road", "spot": "road", "ahead": "from to", "timed": "from to"}


def errors(text: str) -> list[str]:
    found = compile_text(text, name="example.osc").diagnostics
    return [each.message for each in found if each.severity is Severity.ERROR]


def whole(name: str, line: str) -> str:
    """Return a scenario with the line of a method."""
    if line.startswith("def "):
        base = name.partition(".")[0]
        return (
            f"import osc.standard\n\nstruct mine inherits {base}:\n"
            f"    def duration() -> time is only expression 5s\n    {line}\n"
        )
    words = set(re.findall(r"\w+", line)) | {"ego"}
    words |= {word for name in words for word in NEEDS.get(name, "").split()}
    fields = "".join(f"    {FIELDS[word]}\n" for word in FIELDS if word in words)
    head = f"import osc.standard\n\nscenario example:\n{fields}"
    if line.startswith("until "):
        return f"{head}    do serial:\n        ego.drive() with:\n            {line}\n"
    if line.startswith("call "):
        return f"{head}    do serial:\n        ego.drive(duration: 5s)\n        {line}\n"
    return f"{head}    {line}\n    do ego.drive(duration: 5s)\n"


@pytest.mark.parametrize("topic", LANGUAGE, ids=lambda topic: topic.name)
def test_examples_of_the_language_check(topic) -> None:  # type: ignore[no-untyped-def]
    assert errors(f"{topic.example}\n") == []


@pytest.mark.parametrize("topic", METHODS, ids=lambda topic: topic.name)
def test_examples_of_methods_check(topic) -> None:  # type: ignore[no-untyped-def]
    assert topic.names[0] in topic.example
    assert errors(whole(topic.name, topic.example)) == []


def test_every_reserved_word_is_described() -> None:
    known = {name for topic in LANGUAGE for name in topic.names}
    assert set(t.KEYWORDS) - known - PLAIN == set()


def test_every_member_is_found_by_its_name_and_with_its_type() -> None:
    for declaration in declarations.declarations():
        for member in declaration.members:
            name = f"{declaration.name}.{member.name}"
            assert name in [topic.name for topic in find_topics(name)]
            assert name in [topic.name for topic in find_topics(member.name)] or (
                member.name in [topic.name for topic in LANGUAGE]
            )


def test_units_state_their_factor() -> None:
    (kph,) = find_topics("kph")
    assert "0.2777777778" in kph.meaning
    (celsius,) = find_topics("celsius")
    assert "273.15" in celsius.meaning
