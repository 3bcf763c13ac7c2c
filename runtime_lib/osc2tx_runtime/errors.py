"""The errors of scenarios and runs; `main` prints them as `file:line: error: message`."""

from __future__ import annotations

import sys
from contextlib import suppress

NO_RESULT = (ArithmeticError, LookupError, RecursionError, ValueError)
"""Exceptions of an expression without a result: a division by zero, no such element,
a conversion to a type that has no such value (§7.4.2.6)."""

RUN_FAILED = "OSC809"
"""Code of the line with the reason of a failed run: a verdict, not an error."""

NOT_MET = "OSC810"
"""Code of a condition that fails its phase."""

PARTLY_MET = "OSC811"
"""Code of a condition that holds only for a part of its phase."""


class SourcePlace(str):
    """A source position: `cut_in.osc:12` as in traces and reports, with its column.

    Args:
        file: The scenario file.
        line: From 1.
        column: From 1.
    """

    __slots__ = ("column",)
    column: int

    def __new__(cls, file: str, line: int, column: int) -> SourcePlace:
        """Make the text."""
        place = super().__new__(cls, f"{file}:{line}")
        place.column = column
        return place

    def __reduce__(self) -> tuple[type[SourcePlace], tuple[str, int, int]]:
        """Return the constructor call of a copy, also in another process."""
        file, _, line = self.rpartition(":")
        return SourcePlace, (file, int(line), self.column)


class ScenarioError(Exception):
    """The scenario cannot run, or cannot continue.

    Attributes:
        message: Description of the error, with its remedy if known.
        source: Position in the scenario, `hello_world.osc:57`; None if unknown.
        exit_code: The exit code of `main`: 5 run failed, 4 unreadable input or no simulator, 2
            usage.
        code: Code for `osc2tx explain`.
    """

    exit_code = 5
    code = "OSC801"

    def __init__(self, message: str, source: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.source = source

    def happened(self, seconds: float) -> None:
        """Note the time at which it occurred."""
        self.message = f"{self.message} (at {seconds:.3f} s)"

    def report(self, file: str, given: str | None = None) -> str:
        """Return the printed message: `cut_in.osc:12:9: error[OSC802]: …`.

        Args:
            file: The scenario file as stated in the module.
            given: The same file as given by the user.
        """
        return coded(self.code, self.message, self.source or file, file, given)

    def __str__(self) -> str:
        return f"{self.source}: {self.message}" if self.source else self.message


def why_no_result(error: Exception) -> str:
    """Return why an expression has no result."""
    if isinstance(error, KeyError) and error.args:
        return f"no member of the enumeration has the value {error.args[0]!r}"
    if isinstance(error, RecursionError):
        return "a method calls itself without an end"
    return str(error)


def with_column(place: str) -> str:
    """Return a source position with its column, if known: `cut_in.osc:12:9`."""
    return f"{place}:{place.column}" if isinstance(place, SourcePlace) else place


def coded(code: str, message: str, place: str, file: str, given: str | None = None) -> str:
    """Return the printed message of a run.

    Args:
        code: Its code.
        message: Description of the error.
        place: Its position; empty if unknown.
        file: The scenario file as stated in the module.
        given: The same file as given by the user.
    """
    known = given is not None and place.startswith(file)
    whole = with_column(place)
    shown = f"{given}{whole[len(file) :]}" if known else whole
    severity = "warning" if code == PARTLY_MET else "error"
    return f"{shown}{': ' if shown else ''}{severity}[{code}]: {message}"


class PlacementError(ScenarioError):
    """An actor cannot be placed as the scenario requires."""

    code = "OSC802"


class BeyondMapError(ScenarioError):
    """A drawn value exceeds the map."""


class SlotConflict(ScenarioError):
    """Two actions that run at the same time control the same quantity of one actor."""

    code = "OSC803"


class UnsupportedError(ScenarioError):
    """The runtime does not support a request of the scenario."""

    code = "OSC804"


class NoActionError(UnsupportedError):
    """No class executes an action that the scenario declares; a package can provide one."""


class CapabilityError(ScenarioError):
    """The chosen world does not support a request of the scenario."""

    code = "OSC805"


class SettingsError(ScenarioError):
    """A run option is invalid."""

    code = "OSC806"
    exit_code = 2


class InputError(ScenarioError):
    """A file cannot be found, read or written."""

    code = "OSC807"
    exit_code = 4


class SimulatorError(ScenarioError):
    """The simulator is not available, no longer responds, or rejects a request of the run."""

    code = "OSC808"
    exit_code = 4


class OwnCode:
    """Turns every exception of user code into an error of the scenario.

        with OwnCode("ego creep raised", action.source):
            action.on_start()

    This includes `SystemExit`, which must not end the run like a success. Errors of the scenario
    and Ctrl-C pass.

    Args:
        what: Start of the message, which ends with the exception.
        source: Position in the scenario.
        error: The class of the resulting error.
    """

    __slots__ = ("error", "source", "what")

    def __init__(
        self, what: str, source: str | None = None, error: type[ScenarioError] = ScenarioError
    ) -> None:
        self.what = what
        self.source = source
        self.error = error

    def __enter__(self) -> None:
        """Begin."""

    def __exit__(self, kind: object, raised: BaseException | None, trace: object) -> None:
        """Translate the exception."""
        if raised is None or isinstance(raised, ScenarioError | KeyboardInterrupt):
            return
        raise self.error(f"{self.what} {message_of(raised)}", self.source or None) from raised


def message_of(error: BaseException) -> str:
    """Return the class and the message of an exception; without a message, the class alone."""
    text = ""
    with suppress(Exception):  # its `__str__` is user code
        text = str(error)
    name = type(error).__name__
    return f"{name}: {text}" if text else name


def is_own(factory: type) -> bool:
    """Whether a class is user code, whatever its module claims."""
    stated = module_of(factory)
    module = sys.modules.get(stated)
    is_ours = f"{stated}.".startswith("osc2tx_runtime.")
    return not is_ours or getattr(module, factory.__qualname__, None) is not factory


def name_of(factory: type) -> str:
    """Return the full name of a class."""
    return f"{module_of(factory)}.{factory.__qualname__}"


def module_of(factory: type) -> str:
    """Return the name of the module that a class states, which may be wrong."""
    stated: object = factory.__module__
    return stated if type(stated) is str else "?"
