"""Random trees: compositions, actions with modifiers, waits."""

from __future__ import annotations

from osc2tx.semantics.scope import supertypes
from osc2tx.semantics.symbols import ActionSymbol, ActorSymbol, FieldSymbol, ModifierSymbol
from osc2tx.semantics.types import ActorType, EnumType, PhysicalType, PrimitiveType, RangeType
from tests.fuzz.expressions import Expressions
from tests.fuzz.vocabulary import ACTIONS, MODIFIERS, PLAIN, library


class Behaviors(Expressions):
    """Writes what happens in a scenario."""

    def body(self) -> None:
        self.composition(1, "do ")

    def member(self, depth: int) -> None:
        self.size -= 1
        label = self.name() if self.often(0.15) else ""
        if label:
            self.labels.append(label)
            label += ": "
        if self.size > 0 and depth < 8 and self.often(0.3):
            self.composition(depth, label)
        else:
            forms = (self.action, self.action, self.action, self.wait, self.emit, self.invoke)
            self.one(forms)(depth, label)

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

    def invoke(self, depth: int, label: str) -> None:
        """Invoke a scenario or an action with a `do` that stands above."""
        if not self.behaviors:
            return self.wait(depth, label)
        name, parameters = self.one(list(self.behaviors.items()))
        arguments = [
            f"{parameter}: {self.range(kind) if self.often(0.2) else self.value(kind, 1)}"
            for parameter, kind in self.some(list(parameters.items()), 2)
            if kind not in ("bool", "string")
        ]
        head = f"{label}{name}({', '.join(arguments)})"
        rest = [p for p in parameters if p not in head and parameters[p] not in ("bool", "string")]
        if not rest or self.often(0.6):
            return self.line(depth, head)
        parameter = self.one(rest)
        self.line(depth, f"{head} with:")
        if self.often(0.3):
            self.line(depth + 1, f"remove_default(it.{parameter})")
        bound = self.literal(parameters[parameter])
        operator = self.one(("==", "<", ">="))
        self.line(depth + 1, f"keep(it.{parameter} {operator} {bound})")

    def wait(self, depth: int, label: str) -> None:
        self.line(depth, f"{label}wait {self.trigger()}")

    def emit(self, depth: int, label: str) -> None:
        if self.events:
            self.line(depth, f"{label}emit {self.one(self.events)}")
        else:
            self.wait(depth, label)

    def trigger(self) -> str:
        if self.labels and self.often(0.15):
            moment = f"@{self.one(self.labels)}.{self.one(('start', 'end', 'fail'))}"
            guard = self.one(("", "", " if true", f" as {self.name()} if {self.value('bool', 1)}"))
            return moment + guard
        if self.events and self.often(0.1):
            return f"@{self.one(self.events)} if {self.condition()}"
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
