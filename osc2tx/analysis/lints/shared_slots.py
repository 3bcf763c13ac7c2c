"""Members that begin together and control the same slot of one actor (§7.3.13).

Only certain conflicts are reported: actions of the library that begin at the same instant.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from osc2tx.analysis.library_facts import entry_of, is_instant, library_modifiers
from osc2tx.analysis.tree_walk import NodesByKind
from osc2tx.catalogue import catalogue
from osc2tx.diagnostics import DiagnosticSink, Label
from osc2tx.options import OneOfPolicy
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.semantics.builtins import OVERRIDE
from osc2tx.syntax import ast
from osc2tx_shared.classes import dataclass

Op = ast.CompositionOperator

APART = "let them run one after the other"


@dataclass(frozen=True, slots=True)
class _Claim:
    """A claim of an action: a slot of an actor."""

    actor: sym.Symbol | None
    slot: str
    node: ast.Invocation


def report_shared_slots(
    model: SemanticModel, nodes: NodesByKind, sink: DiagnosticSink, one_of: OneOfPolicy = "race"
) -> None:
    """Report the `parallel` compositions of the root file of which no run gets beyond the start.

    Args:
        model: The checked program.
        nodes: The nodes of the root file.
        sink: Receives reports.
        one_of: Which member of a `one_of` counts.
    """
    together = (Op.PARALLEL, Op.ONE_OF) if one_of == "race" else (Op.PARALLEL,)
    starts = _Starts(model, together)
    if any(_overrides(model, node) for node in nodes.of(ast.ModifierApplication)):
        return  # it ends one of them by its label, from anywhere
    for node in nodes.of(ast.Composition):
        if node.operator is Op.PARALLEL and starts.are_together(node):
            _report(map(starts.of, node.members), sink)


def _overrides(model: SemanticModel, node: ast.ModifierApplication) -> bool:
    binding = model.bindings.get(node)
    return binding is not None and binding.callee is OVERRIDE


def _report(starts: Iterable[Iterable[_Claim]], sink: DiagnosticSink) -> None:
    """Report the slots that two members claim, once for each slot of an actor."""
    holders: dict[tuple[sym.Symbol | None, str], tuple[int, _Claim]] = {}
    told = set()
    for number, claims in enumerate(starts):
        for claim in claims:
            what = (claim.actor, claim.slot)
            holder, former = holders.setdefault(what, (number, claim))
            if holder == number or what in told:
                continue
            told.add(what)
            who = "the actor" if claim.actor is None else f"`{claim.actor.name}`"
            sink.report(
                "OSC442",
                claim.node.behavior.span,
                f"two members of `parallel` control the {claim.slot} motion of"
                f" {who} from the same instant on: every run ends there",
                labels=[Label(former.node.behavior.span, "the other member")],
                help=APART,
            )


@dataclass(frozen=True, slots=True)
class _Starts:
    """The actions that begin at the instant at which a member of a `do` tree begins.

    Attributes:
        model: The checked program.
        together: The compositions whose members all begin at the same instant.
    """

    model: SemanticModel
    together: tuple[ast.CompositionOperator, ...]

    def are_together(self, node: ast.Composition) -> bool:
        """Whether the members of a composition begin together, and only a stated end ends them."""
        only_length = all(a.name is not None and a.name.text == "duration" for a in node.arguments)
        is_plain = not any(isinstance(m, ast.ModifierApplication) for m in node.with_members)
        return node.operator in self.together and only_length and is_plain

    def of(self, member: ast.BehaviorMember) -> Iterator[_Claim]:
        """Yield the slots that those actions control."""
        match member:
            case ast.Composition(operator=Op.SERIAL):
                first = next((m for m in member.members if not self._takes_no_time(m)), None)
                if first is not None:
                    yield from self.of(first)
            case ast.Composition() if self.are_together(member):
                for inner in member.members:
                    yield from self.of(inner)
            case ast.Invocation():
                yield from self._claims(member)
            case _:
                return

    def _claims(self, node: ast.Invocation) -> Iterator[_Claim]:
        binding = self.model.bindings.get(node)
        action = None if binding is None else binding.callee
        if not isinstance(action, sym.ActionSymbol) or action.origin == "user":
            return
        entry = entry_of(action)
        whose = binding.receiver if binding is not None else None
        actor = None if whose is None else self.model.symbol_of(whose)
        is_own = whose is None or isinstance(whose, ast.NameExpression)
        if entry is None or entry.is_momentary or not is_own or (whose is not None and not actor):
            return
        for slot in sorted({*entry.slots, *self._modified(node)}):
            yield _Claim(actor, slot, node)

    def _modified(self, node: ast.Invocation) -> Iterator[str]:
        """Yield the slots that the modifiers of an action control after its start."""
        for member in node.with_members:
            if not isinstance(member, ast.ModifierApplication):
                continue
            for modifier in library_modifiers(self.model, member):
                entry = catalogue().modifiers.get(modifier.modifier.text)
                at = [a for a in modifier.arguments if a.name and a.name.text == "at"]
                if entry is not None and not at:
                    yield from entry.slots

    def _takes_no_time(self, member: ast.BehaviorMember) -> bool:
        if isinstance(member, ast.Invocation):
            binding = self.model.bindings.get(member)
            callee = None if binding is None else binding.callee
            return isinstance(callee, sym.ActionSymbol) and is_instant(callee)
        return isinstance(member, ast.EmitDirective | ast.CallDirective)
