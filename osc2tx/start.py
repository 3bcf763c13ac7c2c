"""The first lines of the process.

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
