"""The order of parameters against trying out all values."""

from itertools import product
from operator import eq, ge, gt, le, lt, ne

from hypothesis import given
from hypothesis import strategies as st

from osc2tx.analysis.constraints.domains import ANY_BOOL, ANY_INT
from osc2tx.analysis.constraints.linear_equations import find_contradiction
from osc2tx.analysis.constraints.operation_list import Key, Operation, OperationList
from osc2tx.analysis.constraints.solver import solve
from osc2tx.diagnostics import SourceFile, Span
from osc2tx.semantics.symbols import FieldSymbol

OPERATORS = {"<": lt, "<=": le, ">": gt, ">=": ge, "==": eq, "!=": ne}
NAMES = "abcd"
SPAN = Span(SourceFile("case.osc", ""), 0, 0)
KEYS: dict[str, Key] = {
    name: (FieldSymbol(name=name, namespace="", span=SPAN, owner=None),) for name in NAMES
}

# One constraint: comparisons that hold together.
Comparison = tuple[str, str, str]
comparisons = st.tuples(
    st.sampled_from(NAMES), st.sampled_from(sorted(OPERATORS)), st.sampled_from(NAMES)
)
constraints = st.lists(st.lists(comparisons, min_size=1, max_size=2), min_size=1, max_size=6)


def operations_of(constraint: list[Comparison]) -> OperationList:
    operations = OperationList()
    roots = []
    for left, name, right in constraint:
        operands = tuple(
            operations.add(Operation("var", "int", ANY_INT, key=KEYS[side]))
            for side in (left, right)
        )
        roots.append(operations.add(Operation(name, "bool", ANY_BOOL, operands)))
    while len(roots) > 1:
        roots.append(
            operations.add(Operation("and", "bool", ANY_BOOL, (roots.pop(0), roots.pop(0))))
        )
    return operations


def can_hold(constraint: list[list[Comparison]]) -> bool:
    """Whether some values satisfy all: as many different ones as there are names are enough."""
    return any(
        all(
            OPERATORS[name](values[NAMES.index(left)], values[NAMES.index(right)])
            for each in constraint
            for left, name, right in each
        )
        for values in product(range(len(NAMES)), repeat=len(NAMES))
    )


@given(constraints)
def test_what_is_called_a_contradiction_is_one(given: list[list[Comparison]]) -> None:
    expressions = [operations_of(constraint) for constraint in given]
    conflict = find_contradiction(expressions, range(len(expressions)))
    if conflict:
        assert not can_hold([given[index] for index in conflict])


@given(constraints)
def test_every_contradiction_is_found(given: list[list[Comparison]]) -> None:
    """But for `a != a`, which is true of a number that is none."""
    given = [
        [each for each in constraint if each[0] != each[2] or each[1] != "!="]
        for constraint in given
    ]
    given = [constraint for constraint in given if constraint]
    expressions = [operations_of(constraint) for constraint in given]
    assert bool(solve(expressions, range(len(expressions))).conflict) is not can_hold(given)
