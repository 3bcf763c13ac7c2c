"""Leads a campaign: chooses rows, has them run, stores their outcomes."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import closing

from osc2tx.campaigns.engine import Engine
from osc2tx.campaigns.identity import Texts, identity_of, plan_to, with_files_of
from osc2tx.campaigns.planner import Planner, columns_of, why_left_out
from osc2tx.campaigns.samplers import sampler_by_name
from osc2tx.campaigns.sampling import Findings, Sampler, Wanted
from osc2tx.campaigns.store import Store
from osc2tx_runtime.campaigns import Executor, Plan, Row
from osc2tx_shared.classes import dataclass, replace

from .store import CampaignError

OnProgress = Callable[["Progress"], None]


@dataclass(frozen=True, slots=True)
class Progress:
    """The progress of a campaign.

    Attributes:
        wanted: Requested number of rows; None if unknown.
        done: Rows in the store.
        failed: Rows in the store that did not succeed.
        new: Rows added since this call began.
        left_out: Points that break a constraint.
    """

    wanted: int | None
    done: int
    failed: int
    new: int
    left_out: int


def run_campaign(
    plan: Plan,
    texts: Texts,
    wanted: Wanted,
    store: Store,
    engine: Engine,
    on_progress: OnProgress = lambda progress: None,
) -> Progress:
    """Run the rows of a campaign that its store does not have yet.

    Args:
        plan: The common part of the rows.
        texts: The options of the runs, as they are written.
        wanted: The sampler, and the requested number of rows.
        store: Holds the results, and possibly results of earlier calls.
        engine: Runs the rows.
        on_progress: Called after rows are stored.

    Raises:
        CampaignError: The store is of another campaign, or rows cannot be chosen or run.
        ScenarioError: The scenario cannot have any values.
    """
    with closing(Executor(plan)) as executor:
        findings = Findings(store.measures() if wanted.aim else {}, store.left_out())
        sampler = make_sampler(executor, wanted, findings)
        store.claim(
            identity_of(plan, texts, executor, sampler, wanted),
            plan_to(plan, texts, plan.settings.map_path),
        )
        plan = with_files_of(plan, store)
        if wanted.samples is not None:
            store.wanted = wanted.samples
        planner = Planner(executor, sampler, wanted.samples, store.done(), findings.left_out)
        counts = store.counts()
        so_far = Progress(
            wanted.samples,
            sum(counts.values()),
            sum(counts.values()) - counts.get("success", 0),
            0,
            len(findings.left_out),
        )
        on_progress(so_far)
        with closing(engine.run(plan, planner.rows())) as results:
            for found in results:
                left_out, planner.newly_left_out = planner.newly_left_out, []
                store.add(found, left_out)
                if wanted.aim:
                    findings.hear(found)
                so_far = replace(
                    so_far,
                    done=so_far.done + len(found),
                    failed=so_far.failed + sum(each.status != "success" for each in found),
                    new=so_far.new + len(found),
                    left_out=so_far.left_out + len(left_out),
                )
                on_progress(so_far)
        store.add((), planner.newly_left_out)
        return replace(so_far, left_out=len(store.left_out()))


def make_sampler(executor: Executor, wanted: Wanted, findings: Findings) -> Sampler:
    """Return the sampler of a campaign.

    Raises:
        CampaignError: The number of rows is not stated, or rows cannot be chosen.
    """
    if wanted.is_endless:
        raise CampaignError("state the number of rows: --samples 1000")

    def allows(row: Row) -> bool:
        return why_left_out(executor, row) is None

    needs_columns = wanted.name.partition(":")[0] not in ("random", "table")
    columns = columns_of(executor) if needs_columns else []
    return sampler_by_name(wanted, columns, allows, findings)
