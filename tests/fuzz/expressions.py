"""Random expressions, mostly of the type that is asked for."""

from __future__ import annotations

from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import ActorSymbol
from tests.fuzz.vocabulary import OFF_TYPE, PLAIN, STRINGS, UNITS, Vocabulary, library


class Expressions(Vocabulary):
    """Writes expressions."""

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

    def objects(self, kind: str) -> list[str]:
        scope = library(self.standard, self.dialect)
        names: list[str] = []
        for own, known in self.actors.items():
            symbol = next(s for s in scope.types_named(own) if isinstance(s, ActorSymbol))
            if kind in [above.name for above in supertypes(symbol)]:
                names += known
        return names

    def truth(self, depth: int, steady: bool) -> str:
        form = self.random.randrange(7)
        if form == 6:
            return self.about_list(depth)
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

    def about_list(self, depth: int) -> str:
        """Return a condition on a list, a declared one if there is any."""
        name = self.one(self.lists) if self.lists else f"[{self.literal('int')}, 3]"
        number = self.value("int", depth - 1, steady=True)
        forms = (
            f"{name}.size() > {number}",
            f"{name}.has(it == {number})",
            f"{name}.filter(it > {number}).size() == 1",
            f"{name}.map(it * 2).first_index(it == {number}) == -1",
            f"{number} in {name}",
            f"{name}[0] == {number}",
        )
        return self.one(forms)
