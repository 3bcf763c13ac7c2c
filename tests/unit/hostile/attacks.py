"""Attacks: hostile texts for every place where a text of somebody else gets in, from a seed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from random import Random

from tests.unit.hostile.texts import MULTILINE, TEXTS

ESCAPES = [
    *("\x1b[2J", "\x1b]0;title\x07", "\x1b[1A\x1b[K", "\x9b31m", "\x90q\x9c", "\x08\x08", "\r"),
    *("\u202egpj.exe", "\u2066a\u2069", "\u200f", "\u061c", "\ufeff", "\u00ad", "\u2028", "\u2029"),
    *("\U000e0041", "\u0085", "\x7f", "\x00", "\x0b", "\x0c", "\x1c", "\x1e"),
]
COMMANDS = [
    *(
        "::error::x",
        "::set-output name=a::b",
        "::add-mask::a",
        "::stop-commands::t",
        "\n::error::x",
    ),
    *("##[error]x", "##vso[task.complete]", "##teamcity[buildStop]", "\r\n::warning file=a::b"),
    *("%0A::error::x", "section_start:0:a\r\x1b[0K", "%(prog)s%s%d%", "100%", "%%", "{0}{x!r}"),
]
MARKUP = [
    *("</script><script>alert(1)</script>", "<!--", "-->", "]]>", "&lt;&amp;&#0;", "<?xml?>"),
    *("<svg onload=alert(1)>", "${x}", "$(id)", "`id`", "[red]x[/]", "[link=http://a]b", "](x)"),
    *("\"'><img src=x onerror=alert(1)>", "javascript:alert(1)", "'\"`", "\\u0022", "\\x3c"),
]
CODE = [
    *(
        '"""\nimport os\n"""',
        "'''",
        "\\",
        "\\\n",
        "# coding: utf-7",
        "#! allow OSC",
        "\n    pass\n",
    ),
    *("__import__('os')", "f'{1}'", "lambda: 0", "{{ 7*7 }}", "{% raw %}", "{#", "\\N{BULLET}"),
]
POOL = [*TEXTS, *MULTILINE, *ESCAPES, *COMMANDS, *MARKUP, *CODE]

# What a quoted name, and a comment, cannot hold by the grammar: nobody gets that far with it.
NOT_IN_NAMES = set("|\r\n\0\x0b\x0c\x1b\x7f\x85\u2028\u2029\x1c\x1e")
NOT_IN_COMMENTS = set("\r\n")
NAMES = ("scenario", "field", "event", "label", "action", "actor", "parameter")
POSITIONS = {
    **dict.fromkeys(NAMES, 60),
    **{"string": 90, "comment": 90, "undefined": 60, "member": 60, "unit": 30, "raw": 60},
    **{"file": 70, "folder": 50, "setting": 50, "option": 90, "map": 70, "trace": 60},
    **{"output": 50, "own_action": 60, "allow": 30},
}
"""How many attacks each position gets."""


@dataclass(frozen=True, slots=True)
class Attack:
    """A hostile text at a position."""

    position: str
    text: str

    def __str__(self) -> str:
        return f"{self.position}: {ascii(self.text)[:60]}"


def attacks(position: str, seed: int = 0) -> Iterator[Attack]:
    """Yield the attacks of a position: texts of the pool, whole, doubled, joined and cut."""
    random = Random(f"{seed}/{position}")
    seen = set()
    while len(seen) < POSITIONS[position]:
        text = "".join(random.sample(POOL, random.choice((1, 1, 2, 3))))
        if random.random() < 0.2:
            text = text[: random.randint(1, len(text))] * random.choice((1, 2, 40))
        text = fitting(position, text)
        if text and text not in seen:
            seen.add(text)
            yield Attack(position, text)


def fitting(position: str, text: str) -> str:
    """Return what of a text can stand at a position at all."""
    if position in NAMES or position in ("undefined", "member"):
        return "".join(char for char in text if char not in NOT_IN_NAMES)
    if position in ("comment", "allow"):
        return "".join(char for char in text if char not in NOT_IN_COMMENTS)
    if position in ("file", "folder"):
        return "".join(char for char in text if char not in "/\0")[:60].strip(".")
    return text
