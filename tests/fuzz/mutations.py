"""Mutations of the texts that the repository has: scenarios, goldens, the standard library."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from random import Random

FOLDERS = ("scenarios", "tests/golden", "osc2tx/stdlib")
LONGEST = 6000  # characters; longer texts give a part
TOKEN = re.compile(r"\w+|[^\w\s]+|\s+")
MARKS = "( ) [ ] : , . .. @ ? ! = == => + - * / % | \" ' # \\ \t \r \0 \ufeff \u2028 é \U0001d4b3"
WORDS = "do serial parallel one_of with: until keep( it actor inherits extend import on if"
VALUES = "1e999 0x 99999999999999999999 -1 nan inf 1s 3kph null::x ::a |"
LAYOUT = ("\n", "\n    ", "\n\t", '"""')
PLAIN = (
    "import osc.standard scenario top : actor struct enum modifier action event var def external "
    "keep ( ) do serial : parallel : wait elapsed ( every ( call drive ( ) with : a b it . of "
    'vehicle speed 3 mps 1.5 m true and or not in [ 1 .. 2 ] as is emit cover ( record ( => "x"'
)
SPICE = (*MARKS.split(" "), *WORDS.split(), *VALUES.split(), *LAYOUT)
VOCABULARY = (*PLAIN.split(), *PLAIN.split(), *SPICE)


@cache
def seed_texts(root: Path) -> tuple[str, ...]:
    """Return the texts to start from, in a stable order."""
    paths = sorted(path for folder in FOLDERS for path in (root / folder).rglob("*.osc"))
    return tuple(
        path.read_bytes().decode("utf-8", "surrogateescape") for path in paths if path.is_file()
    )


def mutate(random: Random, seeds: Sequence[str]) -> str:
    """Return one of the texts with a few mutations."""
    text = _part(random, seeds[random.randrange(len(seeds))])
    for _ in range(random.randint(1, 6)):
        text = MUTATIONS[random.randrange(len(MUTATIONS))](random, text, seeds)
    return text


def any_tokens(random: Random) -> str:
    """Return words and signs of the language in any order, some of them in lines of a program."""
    lines = []
    for _ in range(random.randint(1, 8)):
        words = random.choices(VOCABULARY, k=random.randint(1, 9))
        lines.append("    " * random.randint(0, 3) + random.choice(("", " ")).join(words))
    return "\n".join(lines)


def _part(random: Random, text: str) -> str:
    if len(text) <= LONGEST:
        return text
    start = random.randrange(len(text) - LONGEST)
    start = text.rfind("\n\n", 0, start) + 1
    return "import osc.standard\n" + text[start : start + LONGEST]


def _swap_tokens(random: Random, text: str, seeds: Sequence[str]) -> str:
    tokens = TOKEN.findall(text)
    if len(tokens) < 2:
        return text
    one, other = random.randrange(len(tokens)), random.randrange(len(tokens))
    tokens[one], tokens[other] = tokens[other], tokens[one]
    return "".join(tokens)


def _copy_token(random: Random, text: str, seeds: Sequence[str]) -> str:
    """Replace a word by another word of the same text: often still a program."""
    words = [match for match in re.finditer(r"\w+", text)]
    if not words:
        return text
    one, other = words[random.randrange(len(words))], words[random.randrange(len(words))]
    return text[: one.start()] + other.group() + text[one.end() :]


def _spice(random: Random, text: str, seeds: Sequence[str]) -> str:
    at = random.randint(0, len(text))
    until = at + random.randint(0, 3)
    return text[:at] + SPICE[random.randrange(len(SPICE))] + text[until:]


def _drop_line(random: Random, text: str, seeds: Sequence[str]) -> str:
    lines = text.splitlines(keepends=True)
    if lines:
        del lines[random.randrange(len(lines))]
    return "".join(lines)


def _repeat_line(random: Random, text: str, seeds: Sequence[str]) -> str:
    lines = text.splitlines(keepends=True)
    if lines:
        lines.insert(random.randrange(len(lines)), lines[random.randrange(len(lines))])
    return "".join(lines)


def _shift_line(random: Random, text: str, seeds: Sequence[str]) -> str:
    lines = text.splitlines(keepends=True)
    if lines:
        at = random.randrange(len(lines))
        lines[at] = " " * random.randint(1, 8) + lines[at].lstrip(" ")
    return "".join(lines)


def _splice(random: Random, text: str, seeds: Sequence[str]) -> str:
    other = _part(random, seeds[random.randrange(len(seeds))]).splitlines(keepends=True)
    lines = text.splitlines(keepends=True)
    start = random.randint(0, len(other))
    at = random.randint(0, len(lines))
    return "".join(lines[:at] + other[start : start + 10] + lines[at:])


def _change_number(random: Random, text: str, seeds: Sequence[str]) -> str:
    numbers = list(re.finditer(r"\d+", text))
    if not numbers:
        return text
    match = numbers[random.randrange(len(numbers))]
    values = ("0", "-1", "1e308", "0.0", "18446744073709551616", "9" * 400, "1e-400", "007")
    return text[: match.start()] + values[random.randrange(len(values))] + text[match.end() :]


Mutation = Callable[[Random, str, Sequence[str]], str]
MUTATIONS: tuple[Mutation, ...] = (
    _swap_tokens,
    _copy_token,
    _copy_token,
    _copy_token,
    _spice,
    _drop_line,
    _repeat_line,
    _shift_line,
    _splice,
    _change_number,
)
