"""How far `osc2tx campaign run` is, on a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from osc2tx.campaigns.driver import Progress
from osc2tx_shared.text import is_watched, visible

OnProgress = Callable[[Progress], None]


@contextmanager
def progress_bar(name: str) -> Iterator[OnProgress]:
    """Yield what shows progress: rate, failures, remaining time; nothing beside a terminal."""
    if not is_watched():
        yield lambda progress: None
        return
    from rich import progress as bars
    from rich.console import Console

    columns = (
        bars.TextColumn("{task.description}", markup=False),
        bars.BarColumn(),
        bars.TextColumn("{task.completed:.0f} of {task.total}, {task.fields[failed]} failed"),
        bars.TextColumn("{task.speed} rows/s"),
        bars.TimeRemainingColumn(),
    )
    with bars.Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task(visible(name), total=None, failed=0)

        def show(progress: Progress) -> None:
            bar.update(task, completed=progress.done, total=progress.wanted, failed=progress.failed)

        yield show
