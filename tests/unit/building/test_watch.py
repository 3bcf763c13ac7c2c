"""Rounds of --watch: one at once, then one for each change that has come to rest."""

from collections.abc import Callable
from pathlib import Path

from osc2tx.building.watch import rounds
from tests.unit.building.projects import drive, write


class Enough(Exception):
    """The end of a watch."""


def watched(paths: list[Path], also: list[str], *events: Callable[[], object]) -> list[int]:
    """Return at how many pauses there was a round; each pause one event happens."""
    happened = 0
    found = []

    def pause() -> None:
        nonlocal happened
        if happened == len(events):
            raise Enough
        events[happened]()
        happened += 1

    try:
        for _ in rounds(paths, lambda: also, pause):
            found.append(happened)
    except Enough:
        return found
    raise AssertionError("it never ends by itself")


def nothing() -> None:
    pass


def test_rounds(tmp_path: Path) -> None:
    source = drive(tmp_path / "in/a.osc")
    speeds = iter(range(100, 200))

    def change() -> None:
        drive(source, speed=next(speeds) * 10 ** (next(speeds) % 5))

    folder = [tmp_path / "in"]
    assert watched(folder, [], nothing, nothing) == [0]
    assert watched(folder, [], nothing, change, nothing, nothing) == [0, 3]
    assert watched(folder, [], change, change, change, nothing, nothing) == [0, 4]
    assert watched([source], [], change, nothing, nothing) == [0, 2]


def test_what_is_noticed(tmp_path: Path) -> None:
    source = drive(tmp_path / "in/a.osc")
    library = tmp_path / "lib.osc"
    also = [str(library)]

    def is_noticed(event: Callable[[], object]) -> bool:
        return watched([tmp_path / "in"], also, event, nothing, nothing) == [0, 2]

    assert is_noticed(lambda: drive(tmp_path / "in/new/b.osc"))
    assert is_noticed(lambda: write(tmp_path / "osc2tx.toml", ""))
    assert is_noticed(lambda: write(tmp_path / "in/new/osc2tx.toml", ""))
    assert is_noticed(lambda: write(library, "enum color: [red]\n"))
    assert is_noticed(source.unlink)
    assert not is_noticed(lambda: write(tmp_path / "in/notes.txt", ""))
    assert not is_noticed(lambda: write(tmp_path / "out/a.py", ""))


def test_a_change_during_a_round_is_noticed(tmp_path: Path) -> None:
    source = drive(tmp_path / "a.osc")
    number = 0

    def pause() -> None:
        pass

    for _ in rounds([source], list, pause):
        number += 1
        if number == 3:
            break
        drive(source, speed=10**number)
    assert number == 3
