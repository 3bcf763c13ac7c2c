"""Random programs that follow the grammar and mostly also the rules of types.

Everything is drawn from a `random.Random`, so that hypothesis (`st.randoms()`) can shrink what
it finds and `run.py` can repeat it from a seed. Arguments of actions and modifiers follow the
standard library as it is loaded, so what is added there is tried at once.

`vocabulary` chooses words, `expressions` and `behaviors` write what stands inside of scenarios,
`declarations` the rest.
"""

from __future__ import annotations

from random import Random

from tests.fuzz.declarations import Writer


def write_program(random: Random, standard: str = "2.1", dialect: str = "asam") -> str:
    """Return a random program; two of three are tame, so that many get to the back end."""
    return Writer(random, standard, dialect, bold=random.random() < 0.34).program()
