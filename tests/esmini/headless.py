"""Plays one document in a library of esmini and writes down what happened, as JSON.

A process of its own, as esmini keeps its state in globals, and may end the process when a document
does not suit it. Usage: `headless.py LIBRARY DOCUMENT FOLDER_OF_MAPS DT MOST_SECONDS RESULT`.
"""

import ctypes
import json
import sys
from pathlib import Path


class ObjectState(ctypes.Structure):
    """The head of `SE_ScenarioObjectState`; the rest is room for what comes after it."""

    _fields_ = (
        [("id", ctypes.c_int), ("model", ctypes.c_int), ("controller", ctypes.c_int)]
        + [(name, ctypes.c_double) for name in ("timestamp", "x", "y", "z", "h", "p", "r")]
        + [("road", ctypes.c_uint32), ("junction", ctypes.c_uint32), ("t", ctypes.c_double)]
        + [("lane", ctypes.c_int), ("offset", ctypes.c_double), ("s", ctypes.c_double)]
        + [("speed", ctypes.c_double), ("rest", ctypes.c_byte * 512)]
    )


EVENT, RUNNING = 6, 2  # kind and state of a storyboard element
OnChange = ctypes.CFUNCTYPE(None, ctypes.c_char_p, ctypes.c_int, ctypes.c_int, ctypes.c_char_p)


def play(library: Path, document: Path, maps: Path, dt: float, most: float, log: Path) -> object:
    """Return the end (s), starts of events, and rows (time, x, y, speed) of each object."""
    esmini = ctypes.CDLL(str(library))
    esmini.SE_GetSimulationTime.restype = ctypes.c_double
    esmini.SE_GetObjectName.restype = ctypes.c_char_p
    esmini.SE_StepDT.argtypes = [ctypes.c_double]
    words = ["esmini", "--headless", "--disable_stdout", "--osc", str(document)]
    words += ["--path", str(maps), "--logfile_path", str(log)]
    texts = (ctypes.c_char_p * len(words))(*(word.encode() for word in words))
    if esmini.SE_InitWithArgs(len(words), texts) != 0:
        return {"error": log.read_text(encoding="utf-8", errors="replace")[-2000:]}
    starts: list[tuple[float, str]] = []
    rows: dict[str, list[tuple[float, ...]]] = {}

    def now() -> float:
        return round(esmini.SE_GetSimulationTime(), 6)

    def changed(name: bytes, kind: int, state: int, _path: bytes) -> None:
        if (kind, state) == (EVENT, RUNNING):
            starts.append((now(), name.decode()))

    def note() -> None:
        for index in range(esmini.SE_GetNumberOfObjects()):
            one, state = esmini.SE_GetId(index), ObjectState()
            esmini.SE_GetObjectState(one, ctypes.byref(state))
            row = (now(), state.x, state.y, state.speed)
            rows.setdefault(esmini.SE_GetObjectName(one).decode(), []).append(row)

    callback = OnChange(changed)  # not before the start, which forgets it
    esmini.SE_RegisterStoryBoardElementStateChangeCallback(callback)
    while esmini.SE_GetQuitFlag() == 0 and now() < most:
        note()
        esmini.SE_StepDT(dt)
    end = now() if esmini.SE_GetQuitFlag() != 0 else None
    esmini.SE_Close()
    return {"end": end, "starts": starts, "rows": rows}


if __name__ == "__main__":
    library, document, maps, dt, most, result = sys.argv[1:]
    log = Path(result).with_suffix(".log")
    told = play(Path(library), Path(document), Path(maps), float(dt), float(most), log)
    Path(result).write_text(json.dumps(told), encoding="utf-8")
