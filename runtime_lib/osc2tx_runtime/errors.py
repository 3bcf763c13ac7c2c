"""The errors a scenario can meet; `main` prints them as `file:line: error: message`."""

from __future__ import annotations

__all__ = [
    "USER_CODE_ERRORS",
    "CapabilityError",
    "InputError",
    "PlacementError",
    "ScenarioError",
    "SettingsError",
    "SlotConflict",
    "UnsupportedError",
    "blame",
    "is_own",
]

USER_CODE_ERRORS = (
    *(ArithmeticError, AssertionError, AttributeError, LookupError, NameError),
    *(OSError, RuntimeError, TypeError, ValueError),
)
"""What code of the user raises when it is wrong; reported with the place in the scenario."""


class ScenarioError(Exception):
    """The scenario cannot run, or cannot go on.

    Attributes:
        message: What is wrong, and what to do about it where that is known.
        source: Place in the scenario, `hello_world.osc:57`; None where unknown.
        exit_code: What `main` returns: 5 ran and failed, 4 unreadable input, 2 usage.
    """

    exit_code = 5

    def __init__(self, message: str, source: str | None = None) -> None:
        super().__init__(message)
        self.message = message
        self.source = source

    def happened(self, seconds: float) -> None:
        """Note when it was met."""
        self.message = f"{self.message} (at {seconds:.3f} s)"

    def __str__(self) -> str:
        return f"{self.source}: {self.message}" if self.source else self.message


class PlacementError(ScenarioError):
    """An actor cannot be put where the scenario wants it."""


class SlotConflict(ScenarioError):
    """Two actions that run at the same time control the same thing of one actor."""


class UnsupportedError(ScenarioError):
    """The runtime does not do what the scenario asks for."""


class CapabilityError(ScenarioError):
    """The chosen world cannot do what the scenario asks for."""


class SettingsError(ScenarioError):
    """A run option is wrong."""

    exit_code = 2


class InputError(ScenarioError):
    """A file cannot be found, read or written."""

    exit_code = 4


def is_own(factory: type) -> bool:
    """Whether a class is code of the user's own."""
    return not f"{factory.__module__}.".startswith("osc2tx_runtime.")


def blame(factory: type, error: Exception) -> str:
    """Return what a class of the user's own raised, in words."""
    name = f"{factory.__module__}.{factory.__qualname__}"
    return f"{name} raised {type(error).__name__}: {error}"
