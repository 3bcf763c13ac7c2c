"""An entry of the reference as text, as Markdown, as plain data."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import indent
from typing import Any

from osc2tx.reference.declarations import Declaration, Member
from osc2tx.reference.entries import Entry
from osc2tx.reference.topics import Topic

INDENT = "    "
MANY = 12  # users that a page names


def signature(declaration: Declaration) -> str:
    """Return the declaration as the library writes it, without meanings."""
    head = f"{declaration.kind} {declaration.name}"
    if declaration.base:
        head += f" {'of' if declaration.kind == 'modifier' else 'inherits'} {declaration.base}"
    if declaration.kind == "enum":
        return f"{head}: [{', '.join(each.name for each in declaration.members)}]"
    lines = [f"    {_member(each)}" for each in declaration.members]
    return "\n".join([f"{head}:" if lines else head, *lines])


def as_text(entry: Entry) -> str:
    """Return the entry for a terminal."""
    declaration = entry.declaration
    parts = [_title(declaration), signature(declaration)]
    if declaration.meaning:
        parts.insert(1, _sentence(declaration.meaning))
    if declaration.kind == "enum":
        parts += _only_in(declaration.members)
    told = [(each.name, _meaning(each)) for each in declaration.members if each.meaning]
    if told:
        width = max(len(name) for name, _ in told)
        parts.append("\n".join(f"  {name:<{width}}  {meaning}" for name, meaning in told))
    if declaration.units:
        parts.append(f"Units: {', '.join(declaration.units)}")
    parts += [fact.replace("`", "") for fact in entry.facts]
    if entry.inherited:
        parts.append(f"Inherited: {', '.join(map(_short, entry.inherited))}")
    if entry.users:
        parts.append(f"Used by: {_users(entry, '')}")
    if entry.actions:
        parts.append(f"Actions: {', '.join(entry.actions)}")
    if entry.modifiers:
        parts.append(f"Modifiers: {', '.join(entry.modifiers)}")
    shown = entry.shown
    if shown.carla:
        parts.append(f"In CARLA: {shown.carla}.")
    if shown.xml:
        parts.append(f"OpenSCENARIO XML: {_sentence(shown.xml)}")
    if shown.example:
        parts += [f"Example, from {shown.file}:", indent(shown.example, INDENT)]
    if shown.xml_example:
        parts += ["As OpenSCENARIO XML:", indent(shown.xml_example, INDENT)]
    return "\n\n".join(parts)


def as_markdown(entry: Entry) -> str:
    """Return the entry as a page; the caller knows where types are and makes the links."""
    declaration = entry.declaration
    parts = [f"# {declaration.name}", f"*{_title(declaration)}*"]
    parts.append(_sentence(declaration.meaning))
    parts.append(f"```\n{signature(declaration)}\n```")
    if declaration.members:
        parts.append(_table(declaration))
    if declaration.units:
        parts.append("Units: " + ", ".join(f"`{unit}`" for unit in declaration.units))
    shown = entry.shown
    facts = [*entry.facts, *([f"In CARLA: {shown.carla}."] if shown.carla else [])]
    if facts:
        parts += ["## How it runs", "\n".join(f"- {fact}" for fact in facts)]
    if entry.inherited:
        parts += ["## Inherited", ", ".join(f"`{_short(each)}`" for each in entry.inherited)]
    if entry.actions:
        parts += ["## Actions", ", ".join(f"`{name}`" for name in entry.actions)]
    if entry.modifiers:
        parts += ["## Modifiers", ", ".join(f"`{name}`" for name in entry.modifiers)]
    if shown.example:
        parts += ["## Example", f"From `{shown.file}`, which the tests run:"]
        parts.append(f"```\n{shown.example}\n```")
    if shown.xml:
        parts += ["## OpenSCENARIO XML", _sentence(shown.xml)]
    if shown.xml_example:
        parts += ["The example in OpenSCENARIO XML:", f"```xml\n{shown.xml_example}\n```"]
    if entry.users:
        parts += ["## Used by", _users(entry, "`")]
    return "\n\n".join(part for part in parts if part) + "\n"


def as_data(entry: Entry) -> dict[str, Any]:
    """Return the entry as plain data, for JSON."""
    declaration = entry.declaration
    return {
        "kind": declaration.kind,
        "name": declaration.name,
        "base": declaration.base,
        "section": declaration.section,
        "meaning": declaration.meaning,
        "members": [_data(each) for each in declaration.members],
        "units": list(declaration.units),
        "modifiers": list(entry.modifiers),
        "actions": list(entry.actions),
        "inherited": [each.name for each in entry.inherited],
        "facts": [fact.replace("`", "") for fact in entry.facts],
        "carla": entry.shown.carla,
        "xml": entry.shown.xml,
        "file": entry.shown.file,
        "example": entry.shown.example,
        "xml_example": entry.shown.xml_example,
    }


def _users(entry: Entry, quote: str) -> str:
    more = f", and {len(entry.users) - MANY} more" if len(entry.users) > MANY else ""
    return ", ".join(f"{quote}{user}{quote}" for user in entry.users[:MANY]) + more


def _only_in(members: Sequence[Member]) -> list[str]:
    """Return which members only one version of the standard has."""
    versions = sorted({each.version for each in members if each.version})
    return [
        f"Only in {version}: {', '.join(each.name for each in members if each.version == version)}"
        for version in versions
    ]


def topic_as_text(topic: Topic) -> str:
    """Return a topic for a terminal."""
    parts = [_topic_title(topic), _sentence(topic.meaning).replace("`", ""), topic.signature]
    if topic.units:
        parts.append(f"Units: {', '.join(topic.units)}")
    if topic.example:
        parts += ["Example:", indent(topic.example, INDENT)]
    return "\n\n".join(part for part in parts if part)


def topic_as_markdown(topic: Topic) -> str:
    """Return a topic as a part of a page."""
    parts = [f"*{_topic_title(topic)}*", _sentence(topic.meaning), f"```\n{topic.signature}\n```"]
    if topic.units:
        parts.append("Units: " + ", ".join(f"`{unit}`" for unit in topic.units))
    if topic.example:
        parts += ["Example:", f"```\n{topic.example}\n```"]
    return "\n\n".join(part for part in parts if part) + "\n"


def topic_as_data(topic: Topic) -> dict[str, Any]:
    """Return a topic as plain data, for JSON."""
    return {
        "kind": topic.kind,
        "name": topic.name,
        "names": list(topic.names),
        "signature": topic.signature,
        "section": topic.section,
        "meaning": topic.meaning,
        "example": topic.example,
        "units": list(topic.units),
    }


def _topic_title(topic: Topic) -> str:
    section = topic.section and f", OpenSCENARIO DSL 2.2 section {topic.section}"
    names = [topic.name, *(topic.names if topic.is_of_language else ())]
    only = topic.version and f", only in {topic.version}"
    return f"{topic.kind} {', '.join(dict.fromkeys(names))}{section}{only}"


def _sentence(text: str) -> str:
    return text and text[0].upper() + text[1:] + ("" if text.endswith((".", "?")) else ".")


def _data(member: Member) -> dict[str, Any]:
    data = {"kind": member.kind, "name": member.name, "type": member.type}
    data |= {"default": member.default, "meaning": member.meaning}
    data |= {"section": member.section, "version": member.version}
    return {**data, "parameters": list(member.parameters)}


def _title(declaration: Declaration) -> str:
    section = declaration.section and f", OpenSCENARIO DSL 2.2 section {declaration.section}"
    return f"{declaration.kind} {declaration.name}{section}"


def _member(member: Member) -> str:
    if member.kind == "method":
        result = f" -> {member.type}" if member.type else ""
        return f"def {member.name}({', '.join(member.parameters)}){result}"
    head = "var " if member.kind == "variable" else ""
    default = f" = {member.default}" if member.default else ""
    return f"{head}{member.name}: {member.type}{default}"


def _short(member: Member) -> str:
    return f"{member.name}()" if member.kind == "method" else member.name


def _meaning(member: Member) -> str:
    return f"{member.meaning} (only in {member.version})" if member.version else member.meaning


def _table(declaration: Declaration) -> str:
    if declaration.kind == "enum":
        return _values(declaration.members)
    rows = ["| name | type | default | meaning |", "|---|---|---|---|"]
    for each in declaration.members:
        default = f"`{each.default}`" if each.default else ""
        kind = f"`{each.type}`" if each.type else ""
        call = "()" if each.kind == "method" else ""
        rows.append(f"| `{each.name}{call}` | {kind} | {default} | {_cell(_meaning(each))} |")
    return "\n".join(rows)


def _values(members: Sequence[Member]) -> str:
    names = [f"`{each.name}`{_note(each)}" for each in members]
    if not any(each.meaning for each in members):
        return ", ".join(names)
    rows = ["| value | meaning |", "|---|---|"]
    rows += [f"| {name} | {each.meaning} |" for name, each in zip(names, members, strict=True)]
    return "\n".join(rows)


def _note(member: Member) -> str:
    alias = f" = `{member.default}`" if member.default else ""
    return f"{alias} ({member.version} only)" if member.version else alias


def _cell(text: str) -> str:
    return text.replace("|", "\\|")
