"""How long an editor waits for the language server, as ratios to a budget.

    python benchmarks/language_server.py [lines ...]

For generated files of 100 and 1,000 lines: the median and the worst CPU time of edits, each one
character in another place and its undoing, and of the questions after them, in one process and
without the transport, which takes about a millisecond. A ratio below 1 is within the budget. Then
the CPU time of a process that reports the first diagnostics, and the highest memory of all.
"""

import json
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

from osc2tx.language_server import decorations, descriptions, navigation, problems
from osc2tx.language_server.completion import completions
from osc2tx.language_server.positions import position_of, whole
from osc2tx.language_server.project import Project
from osc2tx.support.recursion import collect_earlier_trees

SIZES = (100, 1000)
EDITS = 20
# Question -> lines of the file -> milliseconds, of the median and of the worst.
BUDGET: dict[str, dict[int, tuple[float, float]]] = {
    "diagnostics": {100: (50, 150), 1000: (150, 400)},
    "of a slip": {100: (50, 150), 1000: (150, 400)},  # diagnostics of a text with an error
    "completion": {100: (50, 100), 1000: (50, 100)},
    "hover": {100: (20, 50), 1000: (20, 50)},
    "definition": {100: (20, 50), 1000: (20, 50)},
    "formatting": {1000: (200, 200)},
}
FIRST_FILE = 500.0  # ms
MEMORY = 150.0  # MB, of ten files of 1,000 lines
FILES = 10

HEADER = "import osc.standard\n\n"
BLOCK = """\
scenario approach_{n}:
    ego, other: vehicle
    gap: length = 20m
    do parallel:
        ego.drive(duration: 5s) with:
            speed(50kph)
            lane(1, at: start)
        other.drive() with:
            position(gap, behind: ego, at: start)

"""


def text_of(lines: int) -> str:
    """Return a text of about so many lines."""
    size = BLOCK.count("\n")
    return HEADER + "".join(BLOCK.format(n=n) for n in range(max(lines // size, 1)))


def milliseconds(work: Callable[[], object]) -> float:
    start = time.process_time()
    work()
    return (time.process_time() - start) * 1000


def measure(lines: int, file: Path) -> dict[str, list[float]]:
    """Return the times of edits and questions by their names."""
    project, text = Project(), text_of(lines)
    problems.problems(project.change(file, text))
    found: dict[str, list[float]] = {}
    starts = [i for i in range(len(text)) if text.startswith("ego.drive", i)]
    for number in range(EDITS):
        place = starts[number * len(starts) // EDITS]
        edited = text[: place + 4] + text[place + 5 :]  # `ego.rive`
        found.setdefault("of a slip", []).append(
            milliseconds(lambda edited=edited: problems.problems(project.change(file, edited)))
        )
        collect_earlier_trees()  # as the server does after its answer
        offset = place + 4
        found.setdefault("completion", []).append(
            milliseconds(
                lambda edited=edited, offset=offset: completions(
                    edited, offset, project.model_near(file, offset), project.document(file).job
                )
            )
        )
        found.setdefault("diagnostics", []).append(
            milliseconds(lambda: problems.problems(project.change(file, text)))
        )
        collect_earlier_trees()
        document = project.document(file)
        position = position_of(document.source, place + 5)
        for name, ask in (("hover", descriptions.hover), ("definition", navigation.definition)):
            found.setdefault(name, []).append(
                milliseconds(lambda ask=ask, d=document, p=position: ask(d, p))
            )
        found.setdefault("formatting", []).append(
            milliseconds(lambda d=document: d.compilation.formatted)
        )
        decorations.inlay_hints(document, whole(document.source))
    return found


def start_of_a_process(file: Path) -> float:
    """Return the milliseconds from nothing to the diagnostics of a first file."""
    item = {"uri": file.as_uri(), "languageId": "osc2", "version": 1, "text": text_of(100)}
    sent = (
        message("initialize", {"capabilities": {}}, 1),
        message("initialized", {}),
        message("textDocument/didOpen", {"textDocument": item}),
        message("shutdown", None, 2),
        message("exit", None),
    )
    command = [sys.executable, "-m", "osc2tx", "lsp"]
    least = float("inf")
    for _ in range(3):
        before = _time_of_children()
        subprocess.run(command, check=True, input=b"".join(sent), stdout=subprocess.DEVNULL)
        least = min(least, (_time_of_children() - before) * 1000)
    return least


def message(method: str, params: object, number: int | None = None) -> bytes:
    """Return a message as it is sent to the server; a question has a number."""
    identity = {} if number is None else {"id": number}
    content = {"jsonrpc": "2.0", "method": method, "params": params, **identity}
    text = json.dumps(content).encode()
    return b"Content-Length: %d\r\n\r\n%s" % (len(text), text)


def _time_of_children() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main() -> None:
    """Print the tables."""
    from tempfile import TemporaryDirectory

    sizes = [int(word) for word in sys.argv[1:]] or SIZES
    print(f"{'question':<14}{'lines':>6}{'median ms':>11}{'ratio':>7}{'worst ms':>10}{'ratio':>7}")
    with TemporaryDirectory() as folder:
        file = Path(folder, "edited.osc")
        for lines in sizes:
            for name, times in measure(lines, file).items():
                budget = BUDGET[name].get(lines)
                middle, worst = median(times), max(times)
                ratios = [t / b for t, b in zip((middle, worst), budget or (), strict=False)]
                first, last = (f"{r:.2f}" for r in ratios) if ratios else ("-", "-")
                print(f"{name:<14}{lines:>6}{middle:>11.1f}{first:>7}{worst:>10.1f}{last:>7}")
        first = start_of_a_process(Path(folder, "first.osc"))
        print(f"\nfirst file in a new process: {first:.0f} ms, ratio {first / FIRST_FILE:.2f}")
        project = Project()
        for number in range(FILES):
            text = text_of(max(sizes))
            problems.problems(project.change(Path(folder, f"many_{number}.osc"), text))
        memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        print(f"{FILES} files of {max(sizes)} lines: {memory:.0f} MB, ratio {memory / MEMORY:.2f}")


if __name__ == "__main__":
    main()
