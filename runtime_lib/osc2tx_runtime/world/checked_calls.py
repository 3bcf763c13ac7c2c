"""Calls of code of the user's own, whose answers a run computes with."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NoReturn, TypeVar

from osc2tx_runtime.errors import OwnCode, ScenarioError, SimulatorError, is_own, name_of

from .value_checks import problem_of

__all__ = ["CheckedCalls"]

T = TypeVar("T")
_SIMULATORS = "osc2tx_runtime.simulators."


class CheckedCalls:
    """Calls an object, and names it when it fails or answers what is not of the type it should be.

    Args:
        part: What it is for the run: `plant`, `world`.
        object_: The object. What the embedded world raises is passed on as it is; one that speaks
            to a simulator fails as a rule for what that answered.
    """

    def __init__(self, part: str, object_: object) -> None:
        self._told = f"the {part} {name_of(type(object_))}"
        self._error = self._translated(type(object_))

    @staticmethod
    def _translated(factory: type) -> type[ScenarioError] | None:
        """What exceptions become; None for those of the embedded world, which are bugs."""
        if is_own(factory):
            return ScenarioError
        return SimulatorError if factory.__module__.startswith(_SIMULATORS) else None

    def ask(self, name: str, call: Callable[[], T], wanted: Any) -> T:
        """Return the answer to a call.

        Args:
            name: Of the method, for messages.
            call: Calls it.
            wanted: Type of the answer, as in annotations.

        Raises:
            ScenarioError: It is no such thing, or code of the user's own raised something.
        """
        if self._error is None:
            found = call()
            problem = problem_of(found, wanted)
        else:
            with OwnCode(f"{self._told} raised", error=self._error):
                found = call()
                problem = problem_of(found, wanted)  # its numbers may be own classes
        if problem:
            self.refuse(name, problem)
        return found

    def refuse(self, name: str, problem: str) -> NoReturn:
        """Raises what is wrong with the answer of a method, as a `ScenarioError`."""
        raise ScenarioError(f"{self._told}: {name}: {problem}")
