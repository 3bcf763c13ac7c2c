"""Ctrl-C while a generated module is loaded as a script: its process ends quietly, with code 130.

This is effective from the import of this module, which comes first, until `main`: a later interrupt
is one of the run. Other programs that import the runtime keep their signal handlers.
"""

from __future__ import annotations

import os
import signal
import sys

INTERRUPTED = 130
"""Exit code, as of shells: 128 + SIGINT."""

_MARK = b"Made by osc2tx from "


def _quiet_while_loading() -> None:
    """End the process at once when the user interrupts it, if a generated module is its script."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler and _is_script():
        try:  # noqa: SIM105 (contextlib would be one more to load)
            signal.signal(signal.SIGINT, _end)
        except ValueError:
            pass  # only the main thread may set it


def as_usual() -> None:
    """Make interrupts exceptions again."""
    if signal.getsignal(signal.SIGINT) is _end:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _end(number: int, frame: object) -> None:
    os._exit(INTERRUPTED)


def _is_script() -> bool:
    path = getattr(sys.modules.get("__main__"), "__file__", None)
    if not isinstance(path, str):
        return False
    try:
        with open(path, "rb") as file:
            return _MARK in file.read()
    except (OSError, ValueError):
        return False


_quiet_while_loading()
