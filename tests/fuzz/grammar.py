"""Random texts from the grammar itself: every rule, no types.

A small generator instead of grammarinator: that wants a lexer grammar as well, which the product
does not have, and a step that writes a generator to disk.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import cache
from pathlib import Path
from random import Random

GRAMMAR = Path(__file__).parents[2] / "grammar" / "OpenSCENARIO2.g4"
DEEPEST = 40  # rules in rules; beyond, the shortest way out
LONGEST = 400  # tokens; likewise
TERMINALS = {
    "ID": (
        "a",
        "b",
        "x",
        "ego",
        "speed",
        "vehicle",
        "top",
        "drive",
        "it",
        "actor",
        "std::s",
        "|é|",
    ),
    "INTEGER": ("0", "1", "0x1F", "42"),
    "FLOAT": ("0.5", "1e3", ".1"),
    "PHYSICAL": ("3s", "35kph", "1.5m", "2x"),
    "STRING": ('"text"', "'t'", '"""t"""'),
    "NAMESPACE_STAR": ("std::*",),
    "NEWLINE": ("\n",),
    "INDENT": ("INDENT",),
    "DEDENT": ("DEDENT",),
    "EOF": ("",),
}
_TOKEN = re.compile(r"'(?:[^'\\]|\\.)*'|\w+|[()|?*+:;]")

# An element is a terminal or rule (str), a choice (list of sequences) or (element, suffix).
Element = object
Sequence = list[Element]


@cache
def rules() -> dict[str, list[Sequence]]:
    """Return the alternatives of each rule."""
    text = re.sub(r"/\*.*?\*/|(?m://[^\n]*)", "", GRAMMAR.read_text(encoding="utf-8"), flags=re.S)
    text = re.sub(r"parser grammar \w+;|options \{[^}]*\}", "", text)
    tokens = _TOKEN.findall(text)
    found: dict[str, list[Sequence]] = {}
    while tokens:
        name = tokens.pop(0)
        assert tokens.pop(0) == ":"
        found[name] = _alternatives(tokens)
        assert tokens.pop(0) == ";"
    return found


def _alternatives(tokens: list[str]) -> list[Sequence]:
    """Read `a b | c` up to a closing bracket or semicolon."""
    choices: list[Sequence] = [[]]
    while tokens[0] not in (")", ";"):
        token = tokens.pop(0)
        if token == "|":
            choices.append([])
            continue
        element: Element = token
        if token == "(":
            element = _alternatives(tokens)
            assert tokens.pop(0) == ")"
        while tokens[0] in ("?", "*", "+"):
            element = (element, tokens.pop(0))
        choices[-1].append(element)
    return choices


@cache
def _costs() -> dict[str, float]:
    """Return the least number of tokens of each rule."""
    costs = dict.fromkeys(rules(), float("inf"))
    while True:
        new = {name: min(map(_sequence_cost(costs), alts)) for name, alts in rules().items()}
        if new == costs:
            return costs
        costs = new


def _sequence_cost(costs: dict[str, float]) -> Callable[[Sequence], float]:
    def cost(element: Element) -> float:
        if isinstance(element, str):
            return costs.get(element, 1)
        if isinstance(element, tuple):
            return cost(element[0]) if element[1] == "+" else 0
        assert isinstance(element, list)
        return min(sum(map(cost, sequence)) for sequence in element)

    return lambda sequence: sum(map(cost, sequence))


class _Generator:
    def __init__(self, random: Random) -> None:
        self.random = random
        self.tokens: list[str] = []

    def element(self, element: Element, depth: int) -> None:
        if isinstance(element, list):
            self.choice(element, depth)
        elif isinstance(element, tuple):
            inner, suffix = element
            number = 1 if suffix == "+" else 0
            if depth < DEEPEST and len(self.tokens) < LONGEST:
                number += self.random.randint(0, 1 if suffix == "?" else 2)
            for _ in range(number):
                self.element(inner, depth + 1)
        else:
            assert isinstance(element, str)
            if element in rules():
                self.choice(rules()[element], depth + 1)
            elif element.startswith("'"):
                self.tokens.append(element[1:-1])
            else:
                self.tokens.append(self.random.choice(TERMINALS[element]))

    def choice(self, alternatives: list[Sequence], depth: int) -> None:
        if depth < DEEPEST and len(self.tokens) < LONGEST:
            sequence = self.random.choice(alternatives)
        else:
            sequence = min(alternatives, key=_sequence_cost(_costs()))
        for element in sequence:
            self.element(element, depth)


def write_text(random: Random) -> str:
    """Return a random text that follows the grammar."""
    generator = _Generator(random)
    for _ in range(random.randint(1, 4)):
        generator.element("statement", 0)
    depth = 0
    parts: list[str] = []
    for token in generator.tokens:
        if token in ("INDENT", "DEDENT"):
            depth += 1 if token == "INDENT" else -1
            continue
        if not parts or parts[-1].endswith("\n"):
            parts.append("  " * depth)
        blank = " " if token.isalpha() or random.random() < 0.5 else ""
        parts.append(token if token in (".", "::", "!") else token + blank)
        if blank == "" and token[-1:].isalnum():
            parts.append(" ")
    text = "".join(parts).replace(" \n", "\n")
    return f"import osc.standard\n{text}\n"
