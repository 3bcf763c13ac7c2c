"""Paths of the data folders of osc2tx: templates and grammar."""

from __future__ import annotations

from pathlib import Path


def resource_dir(name: str) -> Path:
    """Return the folder of `templates` or `grammar`.

    In a wheel it lies inside of the package. In a checkout it lies beside it, and counts only if
    `pyproject.toml` lies there too: a stranger's `templates` in site-packages is none of ours.

    Raises:
        FileNotFoundError: If there is no such folder.
    """
    package = Path(__file__).resolve().parent
    if (package / name).is_dir():
        return package / name
    checkout = package.parent
    if (checkout / "pyproject.toml").is_file() and (checkout / name).is_dir():
        return checkout / name
    raise FileNotFoundError(f"osc2tx is installed without its folder {name!r}")
