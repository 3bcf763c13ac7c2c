"""Random declarations: types, scenarios and their members."""

from __future__ import annotations

from collections.abc import Callable

from tests.fuzz.behaviors import Behaviors
from tests.fuzz.vocabulary import CAST, PLAIN, UNITS


class Writer(Behaviors):
    """Writes one random program."""

    def program(self) -> str:
        """Return a program with a scenario or two."""
        self.line(0, "import osc.standard")
        self.line(0, "")
        for write in self.some(TYPES, 4):
            write(self)
        if self.often(0.3):
            self.line(
                0, f"# {self.one(('what it is', chr(34) * 3, 'ends in a backslash ' + chr(92)))}"
            )
        self.scenario("top" if self.often(0.7) else self.name())
        if self.often(0.2):
            self.values, self.actors, self.events, self.labels, self.lists = {}, {}, [], [], []
            self.scenario(self.name())
        return "\n".join(self.lines) + "\n"

    def enum(self) -> None:
        members = ", ".join(dict.fromkeys(self.name() for _ in range(self.random.randint(1, 3))))
        self.line(0, f"enum {self.name()}: [{members}]")

    def struct(self) -> None:
        """Write a struct, with others, lists and defaults that read each other in it."""
        own, fields = self.name(), dict[str, str]()
        self.line(0, f"struct {own}{self.base()}:")
        for _ in range(self.random.randint(1, 3)):
            kind, name = self.one((*PLAIN, "speed", "length")), self.name()
            default = self.default(kind, constant=True)
            alike = [other for other, its in fields.items() if its == kind]
            if alike and kind not in ("bool", "string") and self.often(0.3):
                default = f" = {self.one(alike)} + {self.literal(kind)}"
            variable = "var " if self.often(0.1) else ""
            self.line(1, f"{variable}{name}: {kind}{default}")
            if not variable:
                fields[name] = kind
        if self.structs and self.often(0.4):
            self.line(1, f"{self.name()}: {self.one(list(self.structs))}")
        if self.often(0.3):
            self.line(1, f"{self.name()}: list of int = [1, 2]")
        if self.often(0.2):
            self.line(1, f"event {self.name()} is elapsed(1s)")
        if self.often(0.5):
            body = f"n * {self.value('int', 1)}"
            self.line(1, f"def {self.name()}(n: int = 2) -> int is expression {body}")
        self.structs[own] = fields

    def base(self) -> str:
        """Return what a struct inherits from, under a condition if there is a field for one."""
        if not self.structs or self.often(0.6):
            return ""
        name, fields = self.one(list(self.structs.items()))
        flags = [field for field, kind in fields.items() if kind == "bool"]
        condition = f"({self.one(flags)} == true)" if flags and self.often(0.5) else ""
        return f" inherits {name}{condition}"

    def actor(self) -> None:
        base = self.one((" inherits vehicle", " inherits person", ""))
        self.line(0, f"actor {self.name()}{base}:")
        self.line(1, f"{self.name()}: int{self.default('int', constant=True)}")
        if self.structs and self.often(0.5):
            self.line(1, f"{self.name()}: {self.one(list(self.structs))}")

    def modifier(self) -> None:
        """Write a modifier that applies another, or says something of the invocation."""
        self.line(0, f"modifier {self.name()} of movable_object.action_for_movable_object:")
        name = self.name()
        self.line(1, f"{name}: speed = {self.literal('speed')}")
        if self.often(0.5):
            self.line(1, f"speed({name})")
        else:
            self.line(1, f"keep(it.duration < {self.literal('time')})")

    def extension(self) -> None:
        if not self.structs:
            return
        self.line(0, f"extend {self.one(list(self.structs))}:")
        self.line(1, f"{self.name()}: bool = true")

    def shared(self) -> None:
        kind, name = self.one(("int", "speed", "bool")), self.name()
        self.line(0, f"global {name}: {kind} = {self.literal(kind)}")

    def behavior(self) -> None:
        """Write a scenario or an action with a `do` that others invoke."""
        word, own = self.one(("scenario", "action")), self.name()
        self.line(0, f"{word} {own}:")
        self.cast()
        parameters = {}
        for _ in range(self.random.randint(0, 2)):
            kind, name = self.one(("int", "speed", "time")), self.name()
            self.line(1, f"{name}: {kind}{self.default(kind, constant=True)}")
            parameters[name] = kind
            self.values.setdefault(kind, []).append(name)
        self.composition(1, "do ")
        self.values, self.actors, self.events, self.labels = {}, {}, [], []
        self.behaviors[own] = parameters

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

    def list_of_numbers(self) -> None:
        name = self.name()
        self.line(1, f"{name}: list of int{self.one((' = [3, 1, 2]', ''))}")
        if not self.lines[-1].endswith("]"):
            self.line(1, f"keep({name}[1] {self.one(('== 4', 'in [1..3]', '> 2'))})")
        self.lists.append(name)

    def object(self) -> None:
        """Declare an object of a struct, and say something of a field."""
        if not self.structs:
            return
        kind, fields = self.one(list(self.structs.items()))
        name = self.name()
        self.line(1, f"{name}: {kind}")
        for field, type_ in self.some(list(fields.items()), 1):
            if self.often(0.3):
                self.line(1, f"remove_default({name}.{field})")
            self.line(1, f"keep({name}.{field} == {self.literal(type_)})")

    def sampled(self) -> None:
        if not self.events:
            return
        initial = self.one(("", f", {self.literal('speed')}"))
        measured = self.measure("speed") or self.literal("speed")
        name = self.name()
        self.line(1, f"var {name}: speed = sample({measured}, @{self.one(self.events)}{initial})")
        if initial:
            self.values.setdefault("speed", []).append(name)

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
        trigger = self.one(("@start", "@end")) if self.often(0.2) else self.trigger()
        self.line(1, f"on {trigger}:")
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


MEMBERS: tuple[Callable[[Writer], None], ...] = (
    Writer.parameter,
    Writer.parameter,
    Writer.parameter,
    Writer.ranged,
    Writer.event,
    Writer.event,
    Writer.list_of_numbers,
    Writer.object,
    Writer.sampled,
)
BOLD_MEMBERS = (*MEMBERS, Writer.keep, Writer.handler, Writer.coverage)
TYPES: tuple[Callable[[Writer], None], ...] = (
    Writer.enum,
    Writer.struct,
    Writer.struct,
    Writer.modifier,
    Writer.actor,
    Writer.extension,
    Writer.shared,
    Writer.behavior,
    Writer.behavior,
)
