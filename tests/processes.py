"""Processes that tests start."""

from __future__ import annotations

import os
import signal
import sys
import traceback
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

HANGING = 600
"""Seconds after which a process counts as hanging; how long one takes decides no test."""


@dataclass(frozen=True)
class Ended:
    """How a process ended.

    Attributes:
        code: Its exit code; the signal that ended it is negative.
        out: What it printed.
        err: What it printed as errors.
    """

    code: int
    out: str
    err: str


def forked(main: Callable[[], object], folder: Path | None = None) -> Ended:
    """Call something that may end its process in a copy of this one; nothing is imported again.

    What it prints goes through pipes, since a limit on the size of files must not touch it.

    Args:
        main: What to call.
        folder: The working directory, if not that of this process.
    """
    pipes = os.pipe(), os.pipe()
    process = os.fork()
    if process == 0:
        for number, (_, end) in enumerate(pipes, 1):
            os.dup2(end, number)
        os.chdir(folder or os.curdir)
        _end_with(main)
    for _, end in pipes:
        os.close(end)
    with ThreadPoolExecutor(len(pipes)) as readers:
        out, err = readers.map(_read, (beginning for beginning, _ in pipes))
    _, status = os.waitpid(process, 0)
    return Ended(os.waitstatus_to_exitcode(status), out, err)


def _read(pipe: int) -> str:
    with open(pipe, encoding="utf-8") as text:
        return text.read()


def _end_with(main: Callable[[], object]) -> NoReturn:
    signal.alarm(HANGING)
    sys.stdout, sys.stderr = (
        os.fdopen(number, "w", encoding="utf-8", closefd=False) for number in (1, 2)
    )
    code = 1
    try:
        main()
        code = 0
    except SystemExit as ended:
        code = ended.code if isinstance(ended.code, int) else 1
    except BaseException:  # as the interpreter does it
        traceback.print_exc()
    finally:
        try:
            sys.stdout.flush()
            sys.stderr.flush()
        finally:  # a copy of the tests must never go on as the tests
            os._exit(code)
