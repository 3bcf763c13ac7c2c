"""The compiler and the runtime see the same calls, and find the same wrong with them."""

from collections.abc import Iterator, Mapping
from itertools import combinations
from typing import Any

import pytest

from osc2tx import ir
from osc2tx.catalogue import catalogue
from osc2tx.diagnostics import SourceFile, Span
from osc2tx.rules.given import GivenArguments
from osc2tx_runtime.language.actions.argument_rules import GivenValues
from osc2tx_shared.rules import (
    Rule,
    above,
    at_least,
    at_least_one,
    at_most_one,
    none_of,
    violations,
)

SPAN = Span(SourceFile("x.osc", "x"), 0, 1)
LIBRARY = catalogue()
RULES = {
    name: entry.rules
    for name, entry in (*LIBRARY.modifiers.items(), *LIBRARY.actions.items())
    if entry.rules
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
        beyond = rule.number + (1 if rule.kind == "at_most" else -1)
        for name in (*rule.of, *rule.when, *rule.unless):
            values.setdefault(name, [rule.number, beyond])
        for name in rule.when:
            values[name] = [*rule.values[:1], "something else"] if rule.values else [1]
    for size in range(4):
        for names in combinations(sorted(values), size):
            for index in range(2):
                yield {name: values[name][min(index, len(values[name]) - 1)] for name in names}


@pytest.mark.parametrize("name", sorted(RULES))
def test_both_find_the_same(name: str) -> None:
    judged = set()
    for given in cases(RULES[name]):
        for rule in RULES[name]:
            arguments = {each: argument(each, value) for each, value in given.items()}
            found = list(violations("it", [rule], GivenArguments(arguments)))
            assert found == list(violations("it", [rule], GivenValues(given))), (given, rule)
            judged.add(bool(found))
    assert judged == {True, False}


def test_what_each_kind_of_rule_says() -> None:
    given = GivenValues({"a": 1.0, "b": "left", "c": True})
    rules = [
        at_most_one("a", "b"),
        at_least_one("d", when=["c"], values=["true"]),
        at_least_one("d", "e"),
        at_least_one("d", unless=["a"]),
        none_of("a", when=["b"]),
        none_of("a", when=["b"], values=["right"]),
        at_least(1, "a"),
        at_least(2, "a"),
        above(1, "a", "b"),
    ]
    found = [(each.parameter, each.text) for each in violations("it", rules, given)]
    assert found == [
        ("b", "`a` and `b` exclude each other"),
        (None, "`c: true` needs `d`"),
        (None, "it needs `d` or `e`"),
        ("a", "`b` leaves no room for `a`"),
        ("a", "`a` must not be less than 2"),
        ("a", "`a` must be above 1"),
    ]
