"""What must hold for every text: diagnostics or a module, never an exception.

And for every other input: a result, or the error that is meant for it.
"""

from __future__ import annotations

import ast
import os
import signal
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from traceback import extract_tb, format_exception
from types import FrameType
from typing import Literal, get_args

from osc2tx.backends.py_trees.emitter import GeneratedModule, emit
from osc2tx.compilation.driver import Compilation
from osc2tx.compilation.dump import dump_product
from osc2tx.diagnostics import InternalCompilerError
from osc2tx.diagnostics.render import render_all
from osc2tx.module_loading import scenarios_of_module
from osc2tx.options import PRODUCT_NAMES, CompileOptions
from osc2tx_runtime import RunSettings, ScenarioError, run_scenario
from osc2tx_runtime.report.page import render_report
from tests.fuzz.inputs import Input

Look = Literal["whole", "quick", "check"]
LOOKS: tuple[Look, ...] = get_args(Look)

# Of the processor's time: the machine may be busy.
SECONDS = 5.0
HANGING = 60.0
SECONDS_OF_A_LINE = 0.05
SIMULATED_SECONDS = 1.0


@dataclass(frozen=True, slots=True)
class Finding:
    """Something that must not happen.

    Attributes:
        key: What tells it from other findings: kind and place.
        report: For people.
    """

    key: str
    report: str


class Refuted(AssertionError):
    """A promise of the compiler that does not hold."""


class Hangs(BaseException):
    """It does not come to an end."""


def try_text(
    text: str,
    options: CompileOptions,
    *,
    execute: bool = False,
    look: Look = "whole",
    place: Path | None = None,
    simulated: float = SIMULATED_SECONDS,
) -> Finding | None:
    """Compile a text through all stages and return what went wrong.

    Args:
        text: The program, or anything; lone surrogates stand for bytes that are no UTF-8.
        options: How to compile it.
        execute: Import the module, if there is one, and run its scenarios for a moment.
        look: A quick look prints no products and does without black and the second compilation,
            which take most of the time; a check makes no outputs.
        place: The file that has the text; a file of its own if left out.
        simulated: Seconds that its scenarios run.
    """

    def attempt(folder: Path) -> None:
        path = place or folder / "fuzzed.osc"
        if place is None:
            path.write_bytes(text.encode("utf-8", "surrogateescape"))

        def compilation() -> Compilation:
            return Compilation(path, path.name, options, text=text if place else None)

        module = MAKE[look](compilation)
        if module is not None and execute:
            _execute(module, path.parent, simulated)

    return _tried(attempt, SECONDS + SECONDS_OF_A_LINE * text.count("\n"))


def try_input(kind: Input, text: str) -> Finding | None:
    """Read something that is no scenario, and return what went wrong."""

    def attempt(folder: Path) -> None:
        try:
            kind.read(text, folder)
        except kind.allowed as error:
            if not str(error):
                raise Refuted("an error that says nothing") from error

    return _tried(attempt, SECONDS)


def _tried(attempt: Callable[[Path], None], limit: float) -> Finding | None:
    with tempfile.TemporaryDirectory() as folder:
        start = time.process_time()
        try:
            with _ended_if_it_hangs():
                attempt(Path(folder))
        except (Exception, Hangs) as error:  # any exception is a finding
            return Finding(_key(error), "".join(format_exception(error)))
        seconds = time.process_time() - start
    return Finding("slow", f"took {seconds:.1f} s of the processor") if seconds > limit else None


@contextmanager
def _ended_if_it_hangs() -> Iterator[None]:
    def end(number: int, frame: FrameType | None) -> None:
        raise Hangs

    signal.signal(signal.SIGVTALRM, end)
    signal.setitimer(signal.ITIMER_VIRTUAL, HANGING)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_VIRTUAL, 0.0)


def is_built(text: str, options: CompileOptions) -> bool:
    """Whether a text gives a module; to see how far random programs get."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "fuzzed.osc")
        path.write_text(text, encoding="utf-8")
        return Compilation(path, path.name, options).module is not None


def _compile(compilation_of: Callable[[], Compilation]) -> GeneratedModule | None:
    compilation = compilation_of()
    for product in PRODUCT_NAMES:
        dump_product(compilation, product)
    diagnostics = compilation.diagnostics
    render_all(diagnostics, color=False, folder=compilation.path.parent)
    for diagnostic in diagnostics:
        span = diagnostic.primary
        if span and not 0 <= span.start <= span.end <= len(span.source.text):
            raise Refuted(f"{diagnostic.code} points outside of its source")
    module = compilation.module
    if module is None:
        return None
    if compilation.sink.has_errors:
        raise Refuted("a module although there are errors")
    ast.parse(module.python)
    compile(module.python, "fuzzed.py", "exec")
    again = compilation_of().module
    if again is None or again.python != module.python:
        raise Refuted("another module the second time")
    return module


def _compile_quickly(compilation_of: Callable[[], Compilation]) -> GeneratedModule | None:
    compilation = compilation_of()
    _ = compilation.xml
    if not compilation.has_module or compilation.ir is None:
        render_all(compilation.diagnostics, color=False, folder=compilation.path.parent)
        return None
    module = emit(compilation.ir, compilation.sharing)
    compile(module.python, "fuzzed.py", "exec")
    return module


def _check(compilation_of: Callable[[], Compilation]) -> None:
    compilation = compilation_of()
    compilation.check()
    render_all(compilation.diagnostics, color=False, folder=compilation.path.parent)


MAKE: Mapping[Look, Callable[[Callable[[], Compilation]], GeneratedModule | None]] = {
    "whole": _compile,
    "quick": _compile_quickly,
    "check": _check,
}


def _execute(module: GeneratedModule, maps: Path, simulated: float) -> None:
    """Run the scenarios of a module: to a verdict, or to an error that the runtime explains."""
    settings = RunSettings(max_time=simulated, map_path=(maps,))
    with ExitStack() as imported, explained():
        for scenario in imported.enter_context(scenarios_of_module(module)).values():
            with explained():
                result = run_scenario(scenario, settings)
                render_report(result.trace_lines)


@contextmanager
def explained() -> Iterator[None]:
    """Errors of a scenario that say what is wrong are an answer."""
    try:
        yield
    except ScenarioError as error:
        if not error.message:
            raise Refuted("an error that says nothing") from error


def _key(error: BaseException) -> str:
    frames = extract_tb(error.__traceback__)
    ours = [f for f in frames if f"{os.sep}osc2tx" in f.filename and "_antlr" not in f.filename]
    frame = (ours or frames)[-1]
    place = f"{Path(frame.filename).name}:{frame.name}"
    if isinstance(error, InternalCompilerError | Refuted):
        message = str(error).partition("'")[0].split(": ")[-1]
        return f"{type(error).__name__} {message} {place}"
    return f"{type(error).__name__} {place}"
