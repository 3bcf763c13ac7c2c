"""The own members of each scenario class, and their names.

A class inherits the members that the scenario inherits, with their names in the base class.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from osc2tx import ir
from osc2tx.backends.py_trees.code import PyName
from osc2tx.backends.py_trees.naming import (
    SCENARIO_ATTRIBUTES,
    NameTable,
    class_name,
    identifier,
    method_name,
)
from osc2tx.backends.py_trees.type_methods import TypeMethods
from osc2tx_shared.classes import dataclass

# Compositions nested deeper than this inside one method get a method: far below CPython's limits
# (200 brackets, 99 indents), and readable.
MAX_INLINE_DEPTH = 6

RESERVED = (*SCENARIO_ATTRIBUTES, "Event")  # which classes inside of that of a scenario inherit


def event_class_key(event: str) -> str:
    """Return the key of the class of an event with parameters, in the names of a scenario."""
    return f"class of {event}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Members:
    """The members of one scenario class.

    Attributes:
        base: The scenario that its class inherits from; `None` if that is the runtime's.
        own: The members that it adds to its base; without a base, all members.
        names: Names of all its members.
        constraints: Its own constraints below those of its bases, as they are checked.
        phases: Names of the methods for the parts of its own behavior.
        phase_names: Names of those of all parts, including inherited ones.
    """

    base: ir.AbstractScenario | None
    own: ir.Additions
    names: NameTable
    constraints: tuple[ir.Constraint, ...]
    phases: Mapping[ir.Behavior, PyName]
    phase_names: frozenset[str]


def members_of(module: ir.Module, type_methods: TypeMethods) -> dict[str, Members]:
    """Return the members of the classes of all scenarios of a module, by their keys.

    Args:
        module: The module.
        type_methods: The methods in the classes of types.
    """
    scenarios: dict[str, ir.AbstractScenario] = {}
    found: dict[str, Members] = {}
    for scenario in (*module.bases, *module.scenarios):
        scenarios[scenario.key] = scenario
        base = None if scenario.base is None else scenarios[scenario.base]
        above = None if base is None else found[base.key]
        methods = [each for each in scenario.methods if each.name not in type_methods]
        found[scenario.key] = _members(scenario, base, above, methods)
    return found


def _members(
    scenario: ir.AbstractScenario,
    base: ir.AbstractScenario | None,
    above: Members | None,
    methods: Sequence[ir.Method],
) -> Members:
    added = None if base is None else ir.additions(scenario, base)
    own = added or ir.Additions.all_of(scenario)
    names = NameTable(RESERVED) if above is None else above.names.copy()
    for member in (*scenario.declarations, *methods):
        if member.name not in names:
            names.add(member.name, identifier(member.name))
    for member in scenario.declarations:
        if isinstance(member, ir.Event) and member.parameters:
            key = event_class_key(member.name)
            if key not in names:
                names.add(key, class_name(member.name))
    inherited = frozenset[str]() if above is None else above.phase_names
    phases = {} if own.body is None else _phase_names(own.body, names, inherited)
    return Members(
        base=base,
        own=own,
        names=names,
        constraints=(*(() if above is None else above.constraints), *own.constraints),
        phases=phases,
        phase_names=inherited | {name.text for name in phases.values()},
    )


def _phase_names(
    body: ir.Behavior, names: NameTable, inherited: frozenset[str]
) -> dict[ir.Behavior, PyName]:
    """Name the methods for the parts of a behavior; one replaces that of the base of its name."""
    found: dict[ir.Behavior, PyName] = {}
    wanted = set[str]()
    for node in _phases(body, depth=0):
        name = method_name(node)
        if name in inherited and name not in wanted:
            found[node] = PyName(name)
        else:
            suffix = "" if name in wanted else "_"  # else it is a field that has the name
            found[node] = names.add(f"method at {node.span.start}", name, suffix)
        wanted.add(name)
    return found


def _phases(node: ir.Behavior, *, depth: int) -> Iterator[ir.Composition]:
    """Yield the compositions below a node that get methods of their own, in source order."""
    depth += 1
    match node:
        case ir.Serial() | ir.Parallel() | ir.OneOf():
            for member in node.members:
                is_apart = isinstance(member, ir.Serial | ir.Parallel | ir.OneOf) and (
                    member.is_phase or depth > MAX_INLINE_DEPTH
                )
                if is_apart:
                    yield member  # type: ignore[misc]
                yield from _phases(member, depth=0 if is_apart else depth)
        case ir.On():
            for reaction in node.reactions:
                yield from _phases(reaction, depth=depth)
        case _:
            pass
