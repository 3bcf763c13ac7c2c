"""Progress bar on a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

from osc2tx_shared.text import is_watched

FEWEST_FILES = 20  # that take long enough to look at a bar

Show = Callable[[int, int], None]


@contextmanager
def progress_bar(label: str) -> Iterator[Show]:
    """Yield what is to be told how many of how many files are done."""
    with ExitStack() as stack:
        bars: list[Show] = []

        def show(done: int, total: int) -> None:
            if total >= FEWEST_FILES and is_watched():
                if not bars:
                    bars.append(_start(stack, label))
                if done % max(1, total // 100) == 0 or done == total:
                    bars[0](done, total)

        yield show


def _start(stack: ExitStack, label: str) -> Show:
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
    # Without a thread that refreshes it: processes are forked meanwhile.
    bar = stack.enter_context(
        Progress(*columns, console=Console(stderr=True), transient=True, auto_refresh=False)
    )
    task = bar.add_task(label)

    def show(done: int, total: int) -> None:
        bar.update(task, completed=done, total=total, refresh=True)

    return show
