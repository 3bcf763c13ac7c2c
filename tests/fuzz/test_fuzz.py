"""A bounded number of random programs and texts: diagnostics or a module, never an exception.

The long run is `make fuzz`; `test_long_run.py` has a part of it.
"""

from pathlib import Path
from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from osc2tx.options import DIALECTS, STANDARDS, CompileOptions
from tests.fuzz.extremes import SECONDS, Scenario, write_extreme
from tests.fuzz.grammar import write_text
from tests.fuzz.mutations import mutate, seed_texts
from tests.fuzz.oracle import is_built, try_text
from tests.fuzz.programs import write_program

OPTIONS = st.builds(CompileOptions, st.sampled_from(STANDARDS), st.sampled_from(DIALECTS))
BOUNDED = settings(max_examples=30, suppress_health_check=[HealthCheck.data_too_large])
ROOT = Path(__file__).parents[2]
SCENARIOS = ROOT / "scenarios"
SEEDS = seed_texts(ROOT)


def assert_sound(text: str, options: CompileOptions) -> None:
    finding = try_text(text, options)
    if finding is not None:
        pytest.fail(f"{options}\n{text}\n{finding.report}")


@pytest.mark.slow
@BOUNDED
@given(st.randoms(use_true_random=False), OPTIONS)
def test_programs(random: Random, options: CompileOptions) -> None:
    assert_sound(write_program(random, options.standard, options.dialect), options)


@BOUNDED
@given(st.randoms(use_true_random=False), OPTIONS)
def test_mutated_scenarios(random: Random, options: CompileOptions) -> None:
    assert_sound(mutate(random, SEEDS), options)


@pytest.mark.slow
@BOUNDED
@given(st.randoms(use_true_random=False), OPTIONS)
def test_texts_of_the_grammar(random: Random, options: CompileOptions) -> None:
    assert_sound(write_text(random), options)


@BOUNDED
@given(st.text(), OPTIONS)
def test_any_text(text: str, options: CompileOptions) -> None:
    assert_sound(text.encode("utf-8", "replace").decode(), options)


@BOUNDED
@given(
    st.lists(st.sampled_from([*"()[]{}:,.@?!=<>+-*/%|\"'#\\ \t\r\n\0", "\n    ", "do", "a", "1"])),
    OPTIONS,
)
def test_any_tokens(tokens: list[str], options: CompileOptions) -> None:
    assert_sound("".join(tokens), options)


@BOUNDED
@given(st.binary(), OPTIONS)
def test_any_bytes(data: bytes, options: CompileOptions) -> None:
    assert_sound(data.decode("utf-8", "surrogateescape"), options)


@settings(BOUNDED, max_examples=15)
@given(st.randoms(use_true_random=False))
def test_extremes(random: Random) -> None:
    scenario, text = write_extreme(random, SCENARIOS)
    finding = try_text(
        text,
        scenario.options,
        execute=True,
        look="quick",
        place=scenario.path,
        simulated=SECONDS,
    )
    if finding is not None:
        pytest.fail(f"{scenario.path}\n{text}\n{finding.report}")


def test_numbers_are_found_outside_of_comments_and_strings() -> None:
    text = 'a: int = 1 # 2\nkeep(it == "3.4" or x1 > -5.6e7kph) in [8..9.5]'
    numbers = Scenario(Path(), text, CompileOptions()).numbers()
    assert [text[start:end] for start, end in numbers] == ["1", "5.6e7", "8", "9.5"]


def test_programs_reach_the_back_end() -> None:
    options = CompileOptions()
    built = sum(is_built(write_program(Random(seed)), options) for seed in range(50))
    assert built >= 10, "random programs are mostly refused; see MODIFIERS in vocabulary.py"
