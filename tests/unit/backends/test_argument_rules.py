"""The compiler and the runtime read the same rules, and judge alike."""

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any

import pytest

from osc2tx import ir
from osc2tx.backends.py_trees.argument_rules import violations
from osc2tx.backends.py_trees.runtime_api import ArgumentRule, runtime_support
from osc2tx.diagnostics import SourceFile, Span
from osc2tx_runtime.domain.modifiers import MODIFIERS
from osc2tx_runtime.language.argument_rules import Rule
from osc2tx_runtime.language.registry import methods

SPAN = Span(SourceFile("x.osc", "x"), 0, 1)
RULES = {
    **{name: kind.rules for name, kind in MODIFIERS.items()},
    **{f"{m.kind}.{m.name}": m.factory.rules for m in methods.all()},
}


def argument(name: str, value: Any) -> ir.Argument:
    """Make an argument as the lowering does."""
    expression: ir.Expression
    if isinstance(value, str):
        enum = ir.ValueType(ir.Kind.ENUM, "enum")
        expression = ir.EnumValue(span=SPAN, type=enum, member=value, value=0)
    else:
        number = ir.ValueType(ir.Kind.INTEGER, "int")
        expression = ir.Literal(span=SPAN, type=number, value=value)
    return ir.Argument(parameter=name, value=expression, is_positional=False, span=SPAN)


def cases(rules: tuple[Rule, ...]) -> Iterator[Mapping[str, Any]]:
    """Yield up to three of the parameters that rules speak of, with values on both sides."""
    values: dict[str, list[Any]] = {}
    for rule in rules:
        for name in (*rule.of, *rule.when, *rule.unless):
            values.setdefault(name, [rule.least, rule.least - 1])
        for name in rule.when:
            values[name] = [*rule.values[:1], "something else"] if rule.values else [1]
    for size in range(4):
        for names in combinations(sorted(values), size):
            for index in range(2):
                yield {name: values[name][min(index, len(values[name]) - 1)] for name in names}


@pytest.mark.parametrize("name", [name for name in sorted(RULES) if RULES[name]])
def test_both_find_the_same(name: str) -> None:
    table: tuple[ArgumentRule, ...] = runtime_support().rules[name]
    assert len(table) == len(RULES[name])
    judged = set()
    for given in cases(RULES[name]):
        for rule, read in zip(RULES[name], table, strict=True):
            arguments = {each: argument(each, value) for each, value in given.items()}
            found = list(violations(name, [read], SPAN, arguments))
            wrong = rule.violation(given)
            assert bool(found) == (wrong is not None), (given, rule)
            judged.add(wrong is None)
    assert judged == {True, False}


def test_there_are_rules() -> None:
    assert sum(bool(rules) for rules in RULES.values()) >= 12
