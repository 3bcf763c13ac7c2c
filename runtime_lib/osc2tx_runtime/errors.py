"""The errors a scenario can meet; `main` prints them as `file:line: error: message`."""

from __future__ import annotations

import sys
from contextlib import suppress

NO_RESULT = (ArithmeticError, LookupError, RecursionError, ValueError)
"""Exceptions of an expression without a result: a division by zero, no such element,
a conversion to a type that has no such value (§7.4.2.6)."""

RUN_FAILED = "OSC809"
"""Code of the line that says how a run failed: that is a verdict, no error."""

NOT_MET = "OSC810"
"""Code of a condition that fails its phase."""

PARTLY_MET = "OSC811"
"""Code of a condition that holds only for a part of its phase."""


class SourcePlace(str):
    """A place in a scenario: `cut_in.osc:12` as traces and reports have it, with its column.

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
        """Return what makes a copy, also in another process."""
        file, _, line = self.rpartition(":")
        return SourcePlace, (file, int(line), self.column)


class ScenarioError(Exception):
    """The scenario cannot run, or cannot continue.

    Attributes:
        message: Description of the error, and its remedy where that is known.
        source: Position in the scenario, `hello_world.osc:57`; None where unknown.
        exit_code: What `main` returns: 5 ran and failed, 4 unreadable input or no simulator, 2
            usage.
        code: What `osc2tx explain` says more about.
    """

    exit_code = 5
    code = "OSC801"

    def __init__(self, message: str, source: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.source = source

    def happened(self, seconds: float) -> None:
        """Note when it was met."""
        self.message = f"{self.message} (at {seconds:.3f} s)"

    def report(self, file: str, given: str | None = None) -> str:
        """Return the message as it is printed: `cut_in.osc:12:9: error[OSC802]: …`.

        Args:
            file: The scenario file, as the module knows it.
            given: The same file, as the user has written it.
        """
        return coded(self.code, self.message, self.source or file, file, given)

    def __str__(self) -> str:
        return f"{self.source}: {self.message}" if self.source else self.message


def why_no_result(error: Exception) -> str:
    """Say why an expression has no result."""
    if isinstance(error, KeyError) and error.args:
        return f"no member of the enumeration has the value {error.args[0]!r}"
    if isinstance(error, RecursionError):
        return "a method calls itself without an end"
    return str(error)


def with_column(place: str) -> str:
    """Return a place with its column, where it knows one: `cut_in.osc:12:9`."""
    return f"{place}:{place.column}" if isinstance(place, SourcePlace) else place


def coded(code: str, message: str, place: str, file: str, given: str | None = None) -> str:
    """Return a message of a run as it is printed.

    Args:
        code: Its code.
        message: Description of the error.
        place: Its position; empty where unknown.
        file: The scenario file, as the module knows it.
        given: The same file, as the user has written it.
    """
    known = given is not None and place.startswith(file)
    whole = with_column(place)
    shown = f"{given}{whole[len(file) :]}" if known else whole
    severity = "warning" if code == PARTLY_MET else "error"
    return f"{shown}{': ' if shown else ''}{severity}[{code}]: {message}"


class PlacementError(ScenarioError):
    """An actor cannot be put where the scenario wants it."""

    code = "OSC802"


class BeyondMapError(ScenarioError):
    """What was drawn is more than the map has there."""


class SlotConflict(ScenarioError):
    """Two actions that run at the same time control the same thing of one actor."""

    code = "OSC803"


class UnsupportedError(ScenarioError):
    """The runtime does not support a request of the scenario."""

    code = "OSC804"


class NoActionError(UnsupportedError):
    """No class carries out an action that the scenario declares; a package can bring one."""


class CapabilityError(ScenarioError):
    """The chosen world does not support a request of the scenario."""

    code = "OSC805"


class SettingsError(ScenarioError):
    """A run option is wrong."""

    code = "OSC806"
    exit_code = 2


class InputError(ScenarioError):
    """A file cannot be found, read or written."""

    code = "OSC807"
    exit_code = 4


class SimulatorError(ScenarioError):
    """The simulator is not available, no longer answers, or refuses a request of the run."""

    code = "OSC808"
    exit_code = 4


class OwnCode:
    """Makes whatever code of the user's own raises an error of the scenario.

        with OwnCode("ego creep raised", action.source):
            action.on_start()

    Also other exceptions: a `SystemExit` must not end the run like a success. Errors of the
    scenario and Ctrl-C pass.

    Args:
        what: Begin of the message, which ends with the exception.
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
        """Translate what was raised."""
        if raised is None or isinstance(raised, ScenarioError | KeyboardInterrupt):
            return
        raise self.error(f"{self.what} {message_of(raised)}", self.source or None) from raised


def message_of(error: BaseException) -> str:
    """Return the class and the message of an exception; without a message, the class alone."""
    text = ""
    with suppress(Exception):  # its `__str__` is code of the user's own
        text = str(error)
    name = type(error).__name__
    return f"{name}: {text}" if text else name


def is_own(factory: type) -> bool:
    """Whether a class is code of the user's own, whatever its module claims."""
    stated = module_of(factory)
    module = sys.modules.get(stated)
    is_ours = f"{stated}.".startswith("osc2tx_runtime.")
    return not is_ours or getattr(module, factory.__qualname__, None) is not factory


def name_of(factory: type) -> str:
    """Return the full name of a class."""
    return f"{module_of(factory)}.{factory.__qualname__}"


def module_of(factory: type) -> str:
    """Return the name of the module of a class, which may state anything."""
    stated: object = factory.__module__
    return stated if type(stated) is str else "?"
