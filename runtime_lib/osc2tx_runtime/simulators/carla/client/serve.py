"""Serves requests until the input ends."""

from __future__ import annotations

import json
import math
import os
import signal
import sys
import traceback
from collections.abc import Callable, Iterator
from typing import Any

from . import LETTING_GO, MISSING


def requests_of(holder: object) -> Iterator[tuple[str, Callable[..., Any]]]:
    """Yield the public methods of an object with their names."""
    for name in dir(type(holder)):
        if not name.startswith("_"):
            yield name, getattr(holder, name)


def main(folder: str) -> int:
    """Serve a session that keeps its journal in a folder."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent process decides
    answers = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)  # the library prints warnings
    try:
        from .actors import Actors
        from .inspection import Inspection
        from .levels import Levels
        from .session import Session
        from .surroundings import Surroundings
        from .traffic_manager import TrafficManagers
    except ImportError as error:
        if error.name != "carla":
            raise
        return MISSING
    session = Session(folder)
    actors = Actors(session)
    surroundings, managers = Surroundings(session, actors), TrafficManagers(session)
    levels, inspection = Levels(session), Inspection(session)
    holders = (session, levels, actors, surroundings, managers, inspection)
    requests = {name: call for each in holders for name, call in requests_of(each)}
    try:
        for line in sys.stdin:
            number, name, arguments = json.loads(line)
            try:
                answer = [number, "value", requests[name](*arguments)]
            except RuntimeError as error:  # the only exception of the library
                answer = [number, "error", str(error)]
            except Exception:  # reported to the parent process
                answer = [number, "bug", traceback.format_exc()]
            answers.write(json.dumps(answer) + "\n")
            answers.flush()
    except BrokenPipeError:
        pass  # the parent process is gone
    finally:
        signal.alarm(LETTING_GO + math.ceil(session.patience))
        session.close()
    return 0
