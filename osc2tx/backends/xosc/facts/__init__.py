"""What the embedded world knows and documents have to agree with.

Only these modules ask the runtime (ADR 0001).
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from osc2tx.losses.entries import Inexpressible
from osc2tx_runtime.errors import ScenarioError
from osc2tx_runtime.opendrive import MapError


@contextmanager
def refusing(kind: type[Inexpressible] = Inexpressible, about: str = "") -> Iterator[None]:
    """Refuse what the world refuses inside, or in a function that this decorates.

    `about` is what the reason begins with.
    """
    try:
        yield
    except (ScenarioError, MapError) as error:
        raise kind(f"{about}{error.message}") from None
