"""Progress bar on a terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

from osc2tx_shared.text import complain, is_watched

FEWEST_FILES = 20  # that take long enough to look at a bar

Show = Callable[[int, int], None]


@contextmanager
def progress_bar(label: str, *, is_kept: bool | None = None) -> Iterator[Show]:
    """Yield a function that shows the progress: files done, files in total.

    Args:
        label: The present activity.
        is_kept: Whether results are kept, which an interruption reports; `None` reports nothing.
    """
    with ExitStack() as stack:
        bars: list[Show] = []
        last = (0, 0)

        def show(done: int, total: int) -> None:
            nonlocal last
            last = done, total
            if total >= FEWEST_FILES and is_watched():
                if not bars:
                    bars.append(_start(stack, label))
                if done % max(1, total // 100) == 0 or done == total:
                    bars[0](done, total)

        try:
            yield show
        except KeyboardInterrupt:
            stack.close()
            if is_kept is not None:
                complain(_interrupted(*last, is_kept=is_kept))
            raise


def _interrupted(done: int, total: int, *, is_kept: bool) -> str:
    if not done:
        return "interrupted"
    kept = "kept: the next run completes the others" if is_kept else "lost, as there is no cache"
    return f"interrupted: {done} of {total} files are done and {kept}"


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
