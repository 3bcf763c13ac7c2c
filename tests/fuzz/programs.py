"""Random programs that follow the grammar and mostly also the rules of types.

Everything is drawn from a `random.Random`, so that hypothesis (`st.randoms()`) can shrink what
it finds and `run.py` can repeat it from a seed. Arguments of actions and modifiers follow the
standard library as it is loaded, so what is added there is tried at once.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache
from random import Random
from typing import TypeVar

from osc2tx.semantics.library import shared_library
from osc2tx.semantics.scope import Scope, supertypes
from osc2tx.semantics.symbols import ActionSymbol, ActorSymbol, FieldSymbol, ModifierSymbol
from osc2tx.semantics.types import ActorType, EnumType, PhysicalType, PrimitiveType, RangeType

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


@dataclass(slots=True)
class Writer:
    """Writes one random program.

    Attributes:
        random: Where all choices come from.
        standard: Version of the standard.
        dialect: The dialect whose library is used.
        bold: Whether it may be wrong, or use what few back ends support.
        size: How much there may still be; every member costs one.
        values: Names of fields by type, for expressions.
        actors: Names of objects by actor type.
        events: Names of events.
    """

    random: Random
    standard: str = "2.1"
    dialect: str = "asam"
    bold: bool = True
    size: int = 25
    values: dict[str, list[str]] = field(default_factory=dict)
    actors: dict[str, list[str]] = field(default_factory=dict)
    events: list[str] = field(default_factory=list)
    used: set[str] = field(default_factory=set)
    lines: list[str] = field(default_factory=list)

    # --- Choices --------------------------------------------------------------------------------

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

    # --- Text -----------------------------------------------------------------------------------

    def line(self, depth: int, text: str) -> None:
        self.lines.append(INDENT * depth + text)

    def program(self) -> str:
        """Return a program with a scenario or two."""
        self.line(0, "import osc.standard")
        self.line(0, "")
        for write in self.some((self.enum, self.struct, self.modifier, self.actor), 2):
            write()
        if self.often(0.3):
            self.line(
                0, f"# {self.one(('what it is', chr(34) * 3, 'ends in a backslash ' + chr(92)))}"
            )
        self.scenario("top" if self.often(0.7) else self.name())
        if self.often(0.2):
            self.values, self.actors, self.events = {}, {}, []
            self.scenario(self.name())
        return "\n".join(self.lines) + "\n"

    def enum(self) -> None:
        members = ", ".join(dict.fromkeys(self.name() for _ in range(self.random.randint(1, 3))))
        self.line(0, f"enum {self.name()}: [{members}]")

    def struct(self) -> None:
        self.line(0, f"struct {self.name()}:")
        for _ in range(self.random.randint(1, 2)):
            kind = self.one((*PLAIN, "speed", "length"))
            name = self.name()
            self.line(1, f"{name}: {kind}{self.default(kind, constant=True)}")
        self.line(1, f"def {self.name()}(n: int) -> int is expression n * {self.value('int', 1)}")

    def actor(self) -> None:
        self.line(0, f"actor {self.name()} inherits vehicle")

    def modifier(self) -> None:
        self.line(0, f"modifier {self.name()} of movable_object.action_for_movable_object:")
        self.line(1, f"{self.name()}: speed")

    def scenario(self, name: str) -> None:
        self.line(0, f"scenario {name}:")
        for _ in range(self.random.randint(1, 3)):
            self.cast()
        for _ in range(self.random.randint(0, 6)):
            self.one(BOLD_MEMBERS if self.bold else MEMBERS)(self)
        if not self.boldly(0.05):
            self.body()

    # --- Members of scenarios -------------------------------------------------------------------

    def cast(self) -> None:
        kind, name = self.one(CAST) if self.boldly(0.3) else "vehicle", self.name()
        self.line(1, f"{name}: {kind}")
        self.actors.setdefault(kind, []).append(name)

    def parameter(self) -> None:
        kind = self.one((*PLAIN, *UNITS))
        name = self.name()
        self.line(1, f"{'var ' if self.often(0.1) else ''}{name}: {kind}{self.default(kind)}")
        if self.often(0.15) and kind not in ("bool", "string"):
            self.line(1, f"keep({name} in {self.range(kind)})")
        self.values.setdefault(kind, []).append(name)

    def default(self, kind: str, *, constant: bool = False) -> str:
        if self.boldly(0.1):
            return ""
        return f" = {self.literal(kind) if constant else self.value(kind, 3, steady=True)}"

    def ranged(self) -> None:
        kind = self.one(("int", "float", *UNITS))
        name = self.name()
        self.line(1, f"{name}: {kind}{' with:' if self.often(0.3) else ''}")
        if self.lines[-1].endswith(":"):
            self.line(2, f"keep(it in {self.range(kind)})")
        else:
            bounds = (
                f"in {self.range(kind)}",
                f"== {self.literal(kind)}",
                f">= {self.literal(kind)}",
            )
            self.line(1, f"keep({name} {self.one(bounds if self.bold else bounds[:2])})")
        self.values.setdefault(kind, []).append(name)

    def keep(self) -> None:
        strength = self.one(("", "", "default ", "hard "))
        self.line(1, f"keep({strength}{self.value('bool', 2, steady=True)})")

    def event(self) -> None:
        name = self.name()
        form = self.random.randrange(4 if self.bold else 3)
        if form == 0:
            self.line(1, f"event {name}")
        elif form == 1 and self.events:
            self.line(1, f"event {name} is @{self.one(self.events)}")
        elif form < 3:
            self.line(1, f"event {name} is {self.condition()}")
        else:
            self.line(1, f"event {name}(amount: int)")
            return
        self.events.append(name)

    def handler(self) -> None:
        self.line(1, f"on {self.trigger()}:")
        if self.events and self.often(0.7):
            self.line(2, f"emit {self.one(self.events)}")
        else:
            self.line(2, f"call {self.name()}({self.value('int', 1)})")

    def coverage(self) -> None:
        names = [(kind, name) for kind, known in self.values.items() for name in known]
        if names:
            kind, name = self.one(names)
            unit = f", unit: {UNITS[kind][0]}" if kind in UNITS else ""
            self.line(1, f"{self.one(('cover', 'record'))}({name}{unit})")

    # --- Behaviors ------------------------------------------------------------------------------

    def body(self) -> None:
        self.composition(1, "do ")

    def member(self, depth: int) -> None:
        self.size -= 1
        label = f"{self.name()}: " if self.often(0.15) else ""
        if self.size > 0 and depth < 8 and self.often(0.3):
            self.composition(depth, label)
        else:
            self.one((self.action, self.action, self.action, self.wait, self.emit))(depth, label)

    def composition(self, depth: int, label: str) -> None:
        operator = self.one(("serial", "serial", "parallel", "one_of"))
        arguments = ""
        if self.often(0.2):
            arguments = f"(duration: {self.duration()})"
        elif operator == "parallel" and self.often(0.2):
            overlaps = ("equal", "start", "end", "initial", "final", "inside", "any")
            overlap = self.one(overlaps if self.bold else overlaps[:2])
            arguments = f"(overlap: {overlap})"
        self.line(depth, f"{label}{operator}{arguments}:")
        for _ in range(self.random.randint(1, 3)):
            self.member(depth + 1)
        if self.often(0.15):
            self.line(depth, "with:")
            self.line(depth + 1, f"until {self.trigger()}")

    def duration(self) -> str:
        if self.often(0.3):
            return self.range("time")
        return self.value("time", 2) if self.bold else self.literal("time")

    def action(self, depth: int, label: str) -> None:
        name, kind = self.actor_and_kind()
        if name is None:
            return self.wait(depth, label)
        scope = library(self.standard, self.dialect)
        symbol = next(s for s in scope.types_named(kind) if isinstance(s, ActorSymbol))
        above = set(supertypes(symbol))
        actions = [s for s in scope.declared if isinstance(s, ActionSymbol) and s.actor in above]
        known = [a for a in actions if a.name in ACTIONS]
        action = self.one(actions if self.boldly(0.5) or not known else known)
        arguments = self.arguments(action)
        if self.often(0.3):
            arguments.append(f"duration: {self.duration()}")
        block: list[str] = []
        if self.often(0.7) and (self.bold or action.name == "drive"):
            modifiers = [m for m in scope.declared if isinstance(m, ModifierSymbol) and m.target]
            modifiers = [m for m in modifiers if self.bold or m.name in MODIFIERS]
            chosen = [self.one(modifiers) for _ in range(self.random.randint(0, 2))]
            block += [f"{m.name}({', '.join(self.arguments(m))})" for m in chosen]
        if self.often(0.2):
            block.append(f"until {self.trigger()}")
        if self.boldly(0.05):
            block.append(f"keep(it.duration < {self.literal('time')})")
        head = f"{label}{name}.{action.name}({', '.join(arguments)})"
        self.line(depth, f"{head} with:" if block else head)
        for text in block:
            self.line(depth + 1, text)

    def actor_and_kind(self) -> tuple[str | None, str]:
        known = [(name, kind) for kind, names in self.actors.items() for name in names]
        return self.one(known) if known else (None, "")

    def arguments(self, callee: ActionSymbol | ModifierSymbol) -> list[str]:
        parameters = [p for p in callee.members.values() if isinstance(p, FieldSymbol)]
        parameters = [p for p in parameters if p.node]
        chosen = self.some([p for p in parameters if self.bold or self.is_plain(p)], 2)
        if chosen and chosen == parameters[: len(chosen)] and self.often(0.5):
            return [self.argument(p) for p in chosen]
        return [f"{p.name}: {self.argument(p)}" for p in chosen]

    def argument(self, parameter: FieldSymbol) -> str:
        kind = parameter.type
        match kind:
            case EnumType():
                member = self.one(list(kind.symbol.members))
                return f"{kind.symbol.name}!{member}" if self.often(0.3) else member
            case ActorType():
                fitting = self.objects(kind.symbol.name)
                return self.one(fitting) if fitting else self.actor_and_kind()[0] or "nobody"
            case RangeType():
                return self.range(str(kind.element))
            case PhysicalType() | PrimitiveType():
                return self.value(str(kind), 2)
        return self.value(self.one(PLAIN), 1)

    def is_plain(self, parameter: FieldSymbol) -> bool:
        """Whether a tame program gives this parameter."""
        match parameter.type:
            case EnumType():
                return parameter.name not in ("track", "movement_mode", "measure_by")
            case ActorType():
                return bool(self.objects(parameter.type.symbol.name))
            case PhysicalType() | PrimitiveType():
                return True
        return False

    def objects(self, kind: str) -> list[str]:
        scope = library(self.standard, self.dialect)
        names: list[str] = []
        for own, known in self.actors.items():
            symbol = next(s for s in scope.types_named(own) if isinstance(s, ActorSymbol))
            if kind in [above.name for above in supertypes(symbol)]:
                names += known
        return names

    def wait(self, depth: int, label: str) -> None:
        self.line(depth, f"{label}wait {self.trigger()}")

    def emit(self, depth: int, label: str) -> None:
        if self.events:
            self.line(depth, f"{label}emit {self.one(self.events)}")
        else:
            self.wait(depth, label)

    def trigger(self) -> str:
        if self.events and self.often(0.4):
            event = f"@{self.one(self.events)}"
            return f"{event} if {self.value('bool', 2)}" if self.often(0.3) else event
        return self.condition()

    def condition(self) -> str:
        form = self.random.randrange(5)
        if form == 0:
            return f"elapsed({self.duration()})"
        if form == 1:
            return f"every({self.literal('time')})"
        if form == 2:
            return f"{self.one(('rise', 'fall'))}({self.value('bool', 3)})"
        return self.value("bool", 3)

    # --- Expressions ----------------------------------------------------------------------------

    def value(self, kind: str, depth: int, *, steady: bool = False) -> str:
        """Return an expression; a steady one does not read the world."""
        if self.boldly(OFF_TYPE):
            kind = self.one((*PLAIN, *UNITS))
        known = self.values.get(kind, ())
        if depth <= 0 or self.often(0.3):
            return self.one(known) if known and self.often(0.6) else self.literal(kind)
        if kind == "uint" or (kind == "string" and not self.bold):
            return self.literal(kind)
        if kind == "bool":
            return self.truth(depth - 1, steady)
        if kind == "string":
            return f"{self.value('string', depth - 1)} + {self.value('string', depth - 1)}"
        if not steady and self.often(0.3):
            measured = self.measure(kind)
            if measured:
                return measured
        return self.sum(kind, depth - 1, steady)

    def sum(self, kind: str, depth: int, steady: bool) -> str:
        left, right = (self.value(kind, depth, steady=steady) for _ in range(2))
        factor = self.value("int" if kind in PLAIN else "float", depth, steady=steady)
        form = self.random.randrange(7)
        if form == 0 and kind in ("int", "uint"):
            return f"({left} % {right})"
        if form == 1:
            return f"({left} - {right})"
        if form == 2:
            return f"-({left})"
        if form == 3:
            return f"({self.value('bool', depth, steady=steady)} ? {left} : {right})"
        if form == 4:
            return f"{factor} * ({left})"
        if form == 5 and kind in UNITS:
            return f"({left}) / {self.literal('float')}"
        return f"({left} + {right})"

    def measure(self, kind: str) -> str | None:
        moving = [n for n in self.objects("movable_object")]
        if not moving:
            return None
        one, other = self.one(moving), self.one(moving)
        options = {
            "speed": (f"{one}.speed", f"{one}.velocity.translational.x"),
            "length": (
                f"{one}.object_distance({other}, longitudinal)",
                f"{one}.pose.position.x",
                f"{one}.bounding_box.length",
            ),
            "angle": (f"{one}.pose.orientation.yaw",),
            "time": (f"{one}.time_headway({other})", f"{one}.time_to_collision({other})"),
        }.get(kind)
        if not options:
            return None
        return self.one(options if self.bold else options[:1])

    def truth(self, depth: int, steady: bool) -> str:
        form = self.random.randrange(6)
        if form == 0:
            return f"not {self.value('bool', depth, steady=steady)}"
        if form == 1:
            operator = self.one(("and", "or", "=>"))
            sides = (self.value("bool", depth, steady=steady) for _ in range(2))
            return f"({f' {operator} '.join(sides)})"
        kind = self.one(("int", "float", "speed", "length", "time", "string"))
        left = self.value(kind, depth, steady=steady)
        if form == 2 and kind != "string":
            return f"{left} in {self.range(kind)}"
        operators = ("==", "!=") if kind == "string" else ("==", "!=", "<", "<=", ">", ">=")
        return f"{left} {self.one(operators)} {self.value(kind, depth, steady=steady)}"

    def range(self, kind: str) -> str:
        if self.boldly(0.1):
            return f"[{self.literal(kind)}..{self.literal(kind)}]"
        low, high = sorted(self.one((1, 2, 3, 10, 35, 100)) for _ in range(2))
        unit = self.one(UNITS[kind]) if kind in UNITS else ""
        point = ".0" if kind == "float" else ""
        return f"[{low}{point}{unit}..{high}{point}{unit}]"

    def literal(self, kind: str) -> str:
        if kind == "bool":
            return self.one(("true", "false"))
        if kind == "string":
            return self.one(STRINGS)
        number = str(self.one((1, 2, 3, 10, 35, 100)))
        if kind in ("int", "uint"):
            return self.one((number, number, "0x1F", "0" if self.bold else "4"))
        if self.often(0.4):
            number = self.one(("0.5", "1.25e1", ".1", "3.0E-2", "0.0" if self.bold else "0.75"))
        elif kind == "float":
            number += ".0"
        return f"{number}{self.one(UNITS[kind])}" if kind in UNITS else number


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
MEMBERS: tuple[Callable[[Writer], None], ...] = (
    Writer.parameter,
    Writer.parameter,
    Writer.parameter,
    Writer.ranged,
    Writer.event,
    Writer.event,
)
BOLD_MEMBERS = (*MEMBERS, Writer.keep, Writer.handler, Writer.coverage)


def write_program(random: Random, standard: str = "2.1", dialect: str = "asam") -> str:
    """Return a random program; two of three are tame, so that many get to the back end."""
    return Writer(random, standard, dialect, bold=random.random() < 0.34).program()
