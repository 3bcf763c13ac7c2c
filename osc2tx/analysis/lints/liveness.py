"""Warnings about members that are never reached, never end or are never chosen."""

from __future__ import annotations

from itertools import pairwise

from osc2tx.analysis.lints.termination import Endings, has_duration
from osc2tx.analysis.tree_walk import do_directives, do_members
from osc2tx.diagnostics import DiagnosticSink, Label, Span
from osc2tx.semantics import SemanticModel
from osc2tx.semantics import symbols as sym
from osc2tx.syntax import ast

Operator = ast.CompositionOperator


def report_liveness(
    model: SemanticModel,
    endings: Endings,
    invoked: frozenset[sym.Symbol],
    sink: DiagnosticSink,
) -> None:
    """Report on the `do` trees of the root file.

    Args:
        model: The checked program.
        endings: Which members never end by themselves.
        invoked: The behaviors that something in the program invokes.
        sink: Receives the diagnostics.
    """
    for scenario in model.scenarios:
        directives = [d for d in do_directives(scenario) if d in scenario.statements]
        _report_after_endless([d.member for d in directives], endings, sink)
        for directive in directives:
            for member in do_members(directive.member):
                if isinstance(member, ast.Composition):
                    _report_composition(member, endings, sink)
        if directives and scenario.actor is None and scenario not in invoked:
            _report_without_end(directives[-1].member, endings, sink)


def _report_composition(node: ast.Composition, endings: Endings, sink: DiagnosticSink) -> None:
    if node.operator is Operator.SERIAL and not _gives_the_rest(node, endings):
        _report_after_endless(list(node.members), endings, sink)
    if node.operator is Operator.ONE_OF and len(node.members) == 1:
        sink.report(
            "OSC435",
            keyword_span(node),
            "`one_of` has a single member, so there is nothing to choose",
        )


def _gives_the_rest(node: ast.Composition, endings: Endings) -> bool:
    """Whether a serial has a duration of which its one endless member gets the rest."""
    others = [member for member in node.members if member not in endings.endless]
    is_one = len(others) == len(node.members) - 1
    return has_duration(node) and is_one and all(map(_has_length, others))


def _has_length(member: ast.BehaviorMember) -> bool:
    match member:
        case ast.WaitDirective():
            return isinstance(member.event.condition, ast.ElapsedCondition)
        case ast.EmitDirective() | ast.CallDirective():
            return True
        case _:
            return has_duration(member)


def _report_after_endless(
    members: list[ast.BehaviorMember], endings: Endings, sink: DiagnosticSink
) -> None:
    for member, follower in pairwise(members):
        if member in endings.endless:
            sink.report(
                "OSC432",
                head_span(follower),
                "this is never reached",
                labels=[Label(head_span(member), "this never ends by itself")],
                help="give the member before it a `duration` or an `until`",
            )
            return


def _report_without_end(root: ast.BehaviorMember, endings: Endings, sink: DiagnosticSink) -> None:
    """Report the outermost parallel or race without a member that ends."""
    member = root
    while member in endings.endless and isinstance(member, ast.Composition):
        endless = [child for child in member.members if child in endings.endless]
        if member.operator is not Operator.SERIAL:
            sink.report(
                "OSC434",
                keyword_span(member),
                f"no member of this `{member.operator.value}` ends by itself",
                labels=[Label(head_span(child), "never ends") for child in endless],
                help="give it a `duration` or an `until`, or one of its members",
            )
            return
        if endless[0] is not member.members[-1]:
            return  # the members behind it are reported as unreachable
        member = endless[0]


def head_span(node: ast.BehaviorMember) -> Span:
    """Return the first line of a member."""
    text = node.span.text
    length = len(text.splitlines()[0].split("#")[0].rstrip()) if text else 0
    return Span(node.span.source, node.span.start, node.span.start + length)


def keyword_span(node: ast.Composition) -> Span:
    """Return the operator of a composition."""
    word = node.operator.value
    offset = 0 if node.label is None else node.label.span.end - node.span.start
    start = node.span.start + max(node.span.text.find(word, offset), 0)
    return Span(node.span.source, start, start + len(word))
