"""Single edits of real scenarios, and how many committed lines each of them changes.

Nothing is stripped: `git diff --numstat` counts the lines of all files that a repository with this
one's `.gitignore` would commit.
"""

import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from osc2tx.building.build import BuildOptions, build
from osc2tx.config import GivenOptions

REPOSITORY = Path(__file__).parent.parent.parent
SCENARIOS = REPOSITORY / "scenarios"
COMMENT = "# Reviewed twice."


@dataclass(frozen=True)
class Edit:
    """One edit of one scenario file.

    Attributes:
        file: The file below `scenarios/`, without suffix.
        kind: What sort of edit it is.
        old: A part of the text that it holds once.
        new: What stands there afterwards.
    """

    file: str
    kind: str
    old: str
    new: str

    def __str__(self) -> str:
        return f"{self.kind} {self.file}: {' '.join(self.new.split())}"

    def apply(self, text: str) -> str:
        """Return the edited text."""
        assert text.count(self.old) == 1, (self, text.count(self.old))
        return text.replace(self.old, self.new)


def comment(file: str) -> Edit:
    """Return the edit that adds a comment on top."""
    first = text_of(file).partition("\n")[0]
    return Edit(file, "comment", f"{first}\n", f"{COMMENT}\n{first}\n")


def statement(file: str, before: str, line: str) -> Edit:
    """Return the edit that inserts a statement above another one."""
    return Edit(file, "statement", *inserted(file, before, line))


def actor(file: str, before: str, line: str) -> Edit:
    """Return the edit that declares one more actor above another declaration."""
    return Edit(file, "actor", *inserted(file, before, line))


def inserted(file: str, before: str, line: str) -> tuple[str, str]:
    (found,) = re.findall(rf"(?m)^( *)({re.escape(before)}.*\n)", text_of(file))
    indent, rest = found
    return f"\n{indent}{rest}", f"\n{indent}{line}\n{indent}{rest}"


def value(file: str, old: str, new: str) -> Edit:
    """Return the edit that changes a value."""
    return Edit(file, "value", old, new)


def label(file: str, old: str, new: str) -> Edit:
    """Return the edit that changes a label that nothing else names."""
    return Edit(file, "label", old, new)


def rename(file: str, old: str, new: str) -> Edit:
    """Return the edit that renames a scenario."""
    return Edit(file, "rename", f"scenario {old}:", f"scenario {new}:")


def text_of(file: str) -> str:
    return (SCENARIOS / f"{file}.osc").read_text(encoding="utf-8")


@dataclass(frozen=True)
class Cost:
    """What an edit changes.

    Attributes:
        source: Lines added to and removed from the scenario.
        outputs: The same by suffix of the outputs.
    """

    source: int
    outputs: Counter[str]

    @property
    def ratio(self) -> float:
        """Changed lines of outputs for each changed line of the source."""
        return self.outputs.total() / self.source


class Project:
    """A repository with one scenario and its outputs."""

    def __init__(self, folder: Path, file: str) -> None:
        """Build the scenario as it stands and commit all."""
        self._folder = folder
        self._source = folder / "scenarios" / f"{file}.osc"
        self._text = text_of(file)
        self._source.parent.mkdir(parents=True)
        shutil.copy(REPOSITORY / ".gitignore", folder)
        shutil.copy(SCENARIOS / "osc2tx.toml", folder / "scenarios")
        self._git("init", "--quiet")
        self._build(self._text)
        self._git("add", "--all")
        identity = ("-c", "user.name=test", "-c", "user.email=test@localhost")
        self._git(*identity, "commit", "--quiet", "--message", "before")

    def cost(self, edit: Edit) -> Cost:
        """Return what an edit changes; the project is then as before."""
        self._build(edit.apply(self._text))
        self._git("add", "--all")
        listing = self._git("diff", "--cached", "--numstat", "--find-renames", "-z", "HEAD")
        self._git("reset", "--quiet", "--hard")
        source, outputs = 0, Counter[str]()
        for lines, path in _changes(listing):
            if path.endswith(".osc"):
                source += lines
            elif lines:
                outputs[_suffix(path)] += lines
        return Cost(source, outputs)

    def _build(self, text: str) -> None:
        self._source.write_text(text, encoding="utf-8")
        options = BuildOptions(prune=True)
        folders = [self._folder / "scenarios"]
        result = build(folders, self._folder / "generated", GivenOptions(), options)
        assert not result.bugs, result.bugs
        assert all(each.is_complete for each in result.results), [
            report.message for each in result.results for report in each.reports
        ]

    def _git(self, *arguments: str) -> str:
        ended = subprocess.run(
            ["git", "-C", str(self._folder), *arguments], capture_output=True, text=True, check=True
        )
        return ended.stdout


def _changes(listing: str) -> Iterator[tuple[int, str]]:
    """Yield changed lines and path of each file; of a renamed one the new path."""
    parts = iter(listing.split("\0"))
    for part in parts:
        if part:
            added, removed, path = part.split("\t")
            if not path:
                next(parts)
                path = next(parts)
            yield int(added) + int(removed), path


def _suffix(path: str) -> str:
    name = path.rpartition("/")[2]
    endings = (".xosc.report.json", ".params.xosc", ".map.json", ".xosc", ".py")
    return next((ending for ending in endings if name.endswith(ending)), name)


def costs(edits: tuple[Edit, ...], folder: Path) -> dict[Edit, Cost]:
    """Return what each edit changes."""
    projects: dict[str, Project] = {}
    found = {}
    for edit in edits:
        if edit.file not in projects:
            projects[edit.file] = Project(folder / edit.file.replace("/", "-"), edit.file)
        found[edit] = projects[edit.file].cost(edit)
    return found


def _capability(name: str) -> str:
    return f"capabilities/{name}"


C02 = _capability("C02_actor_binding")
C04 = _capability("C04_duration")
C06 = _capability("C06_speed_control")
C11 = _capability("C11_road_path")
C14 = _capability("C14_space_gap")
C16 = _capability("C16_automatic_lights")
C16_WEATHER = _capability("C16_weather")
C17 = _capability("C17_signal_conditions")
C18 = _capability("C18_braking_distances")
C19 = _capability("C19_speed_modifier")
C24 = _capability("C24_temporal_modifiers")
C29 = _capability("C29_crossing")
C30 = _capability("C30_serial")
C31 = _capability("C31_overlaps")
C31_PARALLEL = _capability("C31_parallel")
C32 = _capability("C32_conditional_triggers")
C34 = _capability("C34_override")
C36 = _capability("C36_one_of")
EVADE = "cut_in_and_evade"

EDITS = (
    *map(
        comment,
        (
            *("cut_in", EVADE, "follow_leader", "pedestrian_crossing", "hello_world"),
            *(C02, C04, C11, C14, C16, C17, C18, C29, C31, C34),
        ),
    ),
    value("cut_in", "gap: length = 8m", "gap: length = 9m"),
    value("cut_in", "v_ego: speed = 70kph", "v_ego: speed = 75kph"),
    value("cut_in", "[80kph..95kph]", "[80kph..90kph]"),
    value("cut_in", "duration: 5s", "duration: 6s"),
    value(EVADE, "v_hero: speed = 60kph", "v_hero: speed = 65kph"),
    value(EVADE, "lag: length = 5m", "lag: length = 6m"),
    value(EVADE, "azimuth: 270deg", "azimuth: 260deg"),
    value("follow_leader", "v_low: speed = 30kph", "v_low: speed = 20kph"),
    value("follow_leader", "position(25m,", "position(30m,"),
    value("pedestrian_crossing", "v_walk: speed = 1.4mps", "v_walk: speed = 1.5mps"),
    value("pedestrian_crossing", "walker.walk(duration: 8s)", "walker.walk(duration: 9s)"),
    value("hello_world", "var v_hero: speed = 35kph", "var v_hero: speed = 36kph"),
    value("hello_world", "wait elapsed(0.5s)", "wait elapsed(0.75s)"),
    value(C02, "first.gain_speed(target: 16mps)", "first.gain_speed(target: 17mps)"),
    value(C04, "serial(duration: 2s)", "serial(duration: 3s)"),
    value(C06, "v_target: speed = 20mps", "v_target: speed = 22mps"),
    value(C11, "s: 260m", "s: 250m"),
    value(C14, "target: 12m,", "target: 14m,"),
    value(C16, "elevation: 14.9deg", "elevation: 14.8deg"),
    value(C18, "v_full: speed = 15mps", "v_full: speed = 16mps"),
    value(C19, "v_pace: speed = 54kph", "v_pace: speed = 58kph"),
    value(C24, "delay: time = 1.5s", "delay: time = 2s"),
    value(C31, "i2: other.drive(duration: 2s)", "i2: other.drive(duration: 3s)"),
    value(C32, "> -20m", "> -25m"),
    statement("cut_in", "other.change_lane", "wait elapsed(1.25s)"),
    statement("cut_in", "settle: other.drive", "other.drive(duration: 2s)"),
    statement("cut_in", "settle: other.drive", "other.change_speed(target: 60kph)"),
    statement(EVADE, "pass_by: hero.drive", "hero.drive(duration: 2s)"),
    statement(EVADE, "pass_by: hero.drive", "emit crash_avoided"),
    statement(EVADE, "cut_in: npc.change_lane", "wait elapsed(1.25s)"),
    statement(EVADE, "emit obstacle_detected", "npc.drive(duration: 2s)"),
    statement("follow_leader", "speed_up:", "leader.change_lane(num_of_lanes: 1, side: left)"),
    statement("pedestrian_crossing", "wait @road_is_free", "wait elapsed(1s)"),
    statement("pedestrian_crossing", "emit road_is_free", "walker.walk(duration: 2s)"),
    statement("hello_world", "hero.change_speed(target: 0kph", "wait elapsed(1s)"),
    statement("hello_world", "npc.change_lane", "npc.drive(duration: 2s)"),
    statement(C16, "clear: env.fog", "env.rain(intensity: 5mmph)"),
    statement(C16_WEATHER, "env.rain(intensity: 0mmph)", "env.clouds(cloudiness: 3)"),
    statement(C18, "icy: ego.change_speed", "wait elapsed(1s)"),
    statement(C24, "planned: ego.drive", "ego.drive(duration: 2s)"),
    statement(C30, "faster:", "wait elapsed(1s)"),
    statement(C30, "back:", "ego.change_lane(side: left)"),
    statement(C31, "final: parallel", "wait elapsed(1s)"),
    statement(C32, "swerve:", "ego.drive(duration: 1s)"),
    rename("cut_in", "cut_in", "short_cut"),
    rename(EVADE, "cut_in_and_evade", "cut_in_and_swerve"),
    rename("follow_leader", "follow_leader", "follow_the_leader"),
    rename("pedestrian_crossing", "pedestrian_crossing", "pedestrian_walks"),
    rename("hello_world", "hello_world", "hello_town"),
    rename(C02, "actor_binding", "bound_actors"),
    rename(C16, "automatic_lights", "lights_by_themselves"),
    rename(C36, "one_of_race", "race_of_members"),
    label("cut_in", "overtake: ", "pass_by: "),
    label("cut_in", "other_cuts_in: serial", "other_part: serial"),
    label("follow_leader", "slow_down: ", "slower: "),
    label(C04, "hurried: ", "in_haste: "),
    label(C31_PARALLEL, "together: ", "at_once: "),
    label(C36, "race: one_of", "contest: one_of"),
    actor("cut_in", "other: vehicle", "third: vehicle"),
    actor("pedestrian_crossing", "walker: person", "passer_by: person"),
)
"""Edits of 22 scenarios; each of them makes a scenario that builds."""
