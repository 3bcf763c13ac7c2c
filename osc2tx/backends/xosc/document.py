"""The whole document: header, entities, storyboard, stop trigger."""

from __future__ import annotations

from pathlib import PurePosixPath

from osc2tx import ir
from osc2tx.backends.xosc.actions.environment import initial_environment
from osc2tx.backends.xosc.adapting import adapted
from osc2tx.backends.xosc.conditions.flow import Flow, at_time, single
from osc2tx.backends.xosc.context import Context
from osc2tx.backends.xosc.entities.entities import scenario_objects
from osc2tx.backends.xosc.entities.placing import initial_actions
from osc2tx.backends.xosc.flattening.flatten import Flattener
from osc2tx.backends.xosc.flattening.storyboard import StoryboardWriter
from osc2tx.backends.xosc.logical.parameters import declaration
from osc2tx.ir.source_text import condensed
from osc2tx.xosc import elements as xml
from osc2tx.xosc.columns import declared
from osc2tx_shared.map_files import DEFAULT_MAP

DATE = "2000-01-01T00:00:00"
"""The schema asks for a date; a real one would change the file each day."""

AUTHOR = "osc2tx"

MOST_TIME = 300.0
"""Seconds after which a run is over that nothing ends before, as with `osc2tx run`."""


def make_document(ctx: Context) -> xml.OpenSCENARIO:
    """Return the document; what it cannot say is in the report."""
    ctx.init_globals.extend(initial_environment(ctx))
    ctx.init_privates.update(initial_actions(ctx))
    flattener = Flattener(ctx)
    end = flattener.run()
    objects = scenario_objects(ctx)  # only now it is known what they have to be able to do
    writer = StoryboardWriter(ctx.version, is_lazy=ctx.profile.is_lazy)
    end = _end(ctx, end)
    acts, end = adapted(ctx, flattener.acts, end)
    ctx.origins |= {event.name: event.place for act in acts for event in act.all_events()}
    story = writer.story("story", acts)
    storyboard = xml.Storyboard(
        xml.Init(xml.Actions(*ctx.init_globals, *ctx.init_privates.values())),
        story,
        writer.trigger(xml.StopTrigger, end, ctx.profile.stop_name or "end"),
    )
    _declare_what_is_never_set(ctx, storyboard)
    major, minor = ctx.version.split(".")
    return xml.OpenSCENARIO(
        xml.FileHeader(
            _properties(ctx),
            revMajor=int(major),
            revMinor=int(minor),
            date=DATE,
            description=ctx.scenario.name,
            author=AUTHOR,
        ),
        _parameters(ctx),
        _variables(ctx),
        _monitors(ctx),
        xml.CatalogLocations(),
        _road_network(ctx),
        xml.Entities(*objects),
        storyboard,
    )


def _declare_what_is_never_set(ctx: Context, storyboard: xml.Storyboard) -> None:
    """Declare the marks of ends that never come: a condition may look at them all the same."""
    looked_at: list[str] = []
    parameters = {each.name for each in ctx.choosing.kept}
    for node in storyboard.walk():
        if isinstance(node, xml.VariableCondition):
            looked_at.append(node.variableRef)
        elif isinstance(node, xml.ParameterCondition):
            looked_at.append(node.parameterRef)
    for name in looked_at:
        if name not in parameters:
            ctx.declare(name, "boolean", "false")


def _end(ctx: Context, end: Flow) -> Flow:
    """Return when a run is over: what waits for something may wait for ever."""
    if not end.is_never:
        return end | single(at_time(MOST_TIME)) if _waits(ctx) else end
    note = f"it ends after {MOST_TIME:g} s, as with `osc2tx run`"
    ctx.report.exact("a scenario without end", ctx.scenario.span, note)
    return single(at_time(MOST_TIME))


def _waits(ctx: Context) -> bool:
    """Whether the end may depend on something that never happens."""
    bodies = (scope.scenario.body for scope in ctx.scope.all())
    nodes = (node for body in bodies for node in ir.walk_behaviors(body))
    triggers = (each for n in nodes if not isinstance(n, ir.On) for each in ir.triggers_of(n))
    return any(
        each.event is not None or not isinstance(each.condition, ir.Elapsed) for each in triggers
    )


def _monitors(ctx: Context) -> xml.MonitorDeclarations | None:
    told = [xml.MonitorDeclaration(name=name, value=value) for name, value in ctx.monitors.items()]
    return xml.MonitorDeclarations(*told) if told else None


def _properties(ctx: Context) -> xml.Properties | None:
    """Return where the scenario stands, and what it samples for coverage: XML samples nothing."""
    sampled = []
    for item in ctx.scenario.coverage:
        note = "runs of the XML sample nothing; the header keeps what was asked for"
        ctx.report.exact(f"{item.kind} {item.name}", item.span, note)
        text = condensed(item.span.text)
        sampled.append(xml.Property(name=f"{item.kind} {item.name}", value=text))
    if ctx.version < "1.2":
        return None
    source = xml.Property(name="source", value=ctx.scenario.span.source.name)
    return xml.Properties(source, *sampled)


def _road_network(ctx: Context) -> xml.RoadNetwork:
    roads = ctx.roads
    if roads is not None and any(roads.map.geo_reference.offset) and ctx.profile.moves_maps:
        ctx.report.exact("map with an offset", ctx.scenario.span, ctx.profile.moves_maps)
    if roads is not None and any(road.reversed for road in roads.map.roads.values()):
        ctx.report.cannot(
            "map with reversed lanes",
            ctx.scenario.span,
            "places and directions in XML go by the side of a lane, not by its `direction`",
        )
    signals = xml.TrafficSignals(*ctx.controllers) if ctx.controllers else None
    return xml.RoadNetwork(xml.LogicFile(filepath=_map_file(ctx)), signals)


def _map_file(ctx: Context) -> str:
    """Return the map as a tool has to look for it: most of them open a file of just that name."""
    wanted = ctx.map_file or DEFAULT_MAP
    if ctx.roads is None or ctx.profile.knows_towns:
        return wanted
    return PurePosixPath(wanted).with_name(ctx.roads.file.name).as_posix()


def _parameters(ctx: Context) -> xml.ParameterDeclarations | None:
    values = {scope.path: scope.values for scope in ctx.scope.all()}
    point, version = ctx.choosing.point, ctx.version
    given = [declaration(p, point[p.key], values[p.path], version) for p in ctx.choosing.kept]
    if ctx.version < "1.2":
        variables = ctx.variables.items()
        given += [declared(name, type_, value, version) for name, (type_, value) in variables]
    return xml.ParameterDeclarations(*given) if given else None


def _variables(ctx: Context) -> xml.VariableDeclarations | None:
    if ctx.version < "1.2" or not ctx.variables:
        return None
    declarations = (
        xml.VariableDeclaration(name=name, variableType=type_, value=value)
        for name, (type_, value) in ctx.variables.items()
    )
    return xml.VariableDeclarations(*declarations)
