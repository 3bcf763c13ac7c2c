"""`osc2tx campaign`: a scenario run many times, each time with other values."""

from __future__ import annotations

import click

from osc2tx.cli.campaign_results import export, replay, report
from osc2tx.cli.campaign_run import run


@click.group()
def campaign() -> None:
    """Run a scenario many times, each time with other values, and look at the outcomes.

    The outcomes of the runs are in one file, the store. A row has a number, and the number one
    meaning: it depends on the scenario, the sampler and the seed, not on the machine and the time.
    A campaign that was interrupted is resumed by the next call.
    """


for command in (run, report, replay, export):
    campaign.add_command(command)
