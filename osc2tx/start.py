"""The first lines of the process, and its last.

Ctrl-C ends it quietly also while the command line is loaded, and a check whose answer is known does
without the command line.
"""

from __future__ import annotations

import gc
import os
import signal
import sys

TYPE_CHECKING = False  # see `osc2tx/__init__.py`

if TYPE_CHECKING:
    from typing import NoReturn

_INTERRUPTED = 130


def collect_rarely() -> None:
    """Look for garbage rarely: objects that are loaded and parsed stay."""
    gc.set_threshold(200_000, 30, 30)


def main() -> NoReturn:
    """Run the command line and end the process."""
    try:
        signal.signal(signal.SIGINT, lambda number, frame: os._exit(_INTERRUPTED))
        collect_rarely()
        from osc2tx.building.answers import Answer

        answer = Answer(sys.argv[1:])
        code = answer.recall()
        if code is not None:
            sys.exit(code)
        from osc2tx.cli import main as run

        signal.signal(signal.SIGINT, signal.default_int_handler)
        run(answer=answer)
    except KeyboardInterrupt:  # outside of the commands
        os._exit(_INTERRUPTED)
    except SystemExit as end:
        _end(end)


def _end(end: SystemExit) -> NoReturn:
    """End the process; the system takes its memory faster than Python frees a million objects.

    Threads that are still at work are left to Python.

    Raises:
        SystemExit: There are such threads, or the end is not one of ours.
    """
    import atexit

    from osc2tx_shared.text import flush

    threading = sys.modules.get("threading")
    if not isinstance(end.code, int) or (threading and threading.active_count() > 1):
        raise end
    atexit._run_exitfuncs()
    flush()
    os._exit(end.code)
