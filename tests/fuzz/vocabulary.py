"""Words of random programs: names, units, literals, and the choices between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cache
from random import Random
from typing import TypeVar

from osc2tx.semantics.declarations.library import shared_library
from osc2tx.semantics.scope import Scope

T = TypeVar("T")

# Names that mean something to Python, to the runtime or to the generated module, and names that
# only differ in what Python cannot tell.
PLAIN_NAMES = (
    "car ego npc other_car x y v gap lag speed_limit flag text count hero_2 _ __ self cls super "
    "lambda class def None True False pass import_ from_ print type object len list str float main "
    "declare behavior create_root Scenario Serial Parallel OneOf Wait Event Vehicle Top top m mps "
    "kph s rise fall name parent children tick status setup start_ world"
)
ESCAPED_NAMES = """|a-b| |a_b| |\"\"\"| |\\n| |ÅÖ| |日本| |'| |#| |x;y| |{x}|"""
NAMES = (*PLAIN_NAMES.split(), *ESCAPED_NAMES.split(), "|a b|")
UNITS = {
    "length": ("m", "km", "cm", "feet"),
    "time": ("s", "ms", "min"),
    "speed": ("mps", "kph", "mph"),
    "acceleration": ("mpsps", "kmphps"),
    "jerk": ("mpspsps",),
    "angle": ("deg", "rad"),
    "angular_rate": ("degps",),
    "temperature": ("celsius", "K"),
    "pressure": ("Pa", "hPa"),
    "mass": ("kg",),
}
PLAIN = ("int", "uint", "float", "bool", "string")
CAST = ("vehicle", "person", "movable_object", "environment", "trailer")
OFF_TYPE = 0.02  # how often a bold program gives a value of some other type
# What tame programs do: the better known part of the library.
ACTIONS = ("drive", "walk", "move", "change_speed", "keep_speed", "follow_lane", "change_lane")
MODIFIERS = ("speed", "lane", "position", "lateral", "change_speed", "keep_lane", "keep_speed")
INDENT = "    "


@cache
def library(standard: str, dialect: str) -> Scope:
    """Return the definitions of the standard library."""
    return shared_library(standard, dialect, "all").scope


STRINGS = (
    '"Town06"',
    '""',
    "'single'",
    '"a \\"quoted\\" word"',
    '"{braces} %s {{}}"',
    '"""three\'s"""',
    '"back\\\\slash"',
    '"\\n"',
    '"ÅÖ 日本"',
    '"#no comment"',
)


@dataclass(slots=True)
class Vocabulary:
    """Chooses words, and remembers those that mean something.

    Attributes:
        random: Where all choices come from.
        standard: Version of the standard.
        dialect: The dialect whose library is used.
        bold: Whether it may be wrong, or use what few back ends support.
        size: How much there may still be; every member costs one.
        values: Names of fields by type, for expressions.
        actors: Names of objects by actor type.
        events: Names of events.
        lists: Names of lists of integers.
        labels: Labels so far.
        structs: Names of structs with their fields.
        behaviors: What can be invoked, with its parameters.
    """

    random: Random
    standard: str = "2.1"
    dialect: str = "asam"
    bold: bool = True
    size: int = 25
    values: dict[str, list[str]] = field(default_factory=dict)
    actors: dict[str, list[str]] = field(default_factory=dict)
    events: list[str] = field(default_factory=list)
    lists: list[str] = field(default_factory=list)
    labels: list[str] = field(default_factory=list)
    structs: dict[str, dict[str, str]] = field(default_factory=dict)
    behaviors: dict[str, dict[str, str]] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)
    lines: list[str] = field(default_factory=list)

    def one(self, options: Sequence[T]) -> T:
        return options[self.random.randrange(len(options))]

    def often(self, chance: float) -> bool:
        return self.random.random() < chance

    def boldly(self, chance: float) -> bool:
        return self.bold and self.often(chance)

    def some(self, options: Sequence[T], most: int) -> list[T]:
        number = self.random.randint(0, min(most, len(options)))
        chosen = sorted(self.random.sample(range(len(options)), number))
        return [options[index] for index in chosen]

    def name(self) -> str:
        """Return a name that was not used before, mostly."""
        text = self.one(NAMES)
        if text in self.used and not self.boldly(OFF_TYPE):
            text = f"n{len(self.used)}"
        self.used.add(text)
        return text

    def line(self, depth: int, text: str) -> None:
        self.lines.append(INDENT * depth + text)
