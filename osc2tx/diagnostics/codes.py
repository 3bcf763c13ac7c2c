"""The registry of diagnostic codes.

Families: 1xx text and syntax, 2xx names and imports, 3xx types and units, 4xx behaviors,
modifiers and constraints, 5xx not supported by a backend, 6xx relaxations of a dialect, 7xx
suppressions, 8xx runs.
A code is permanent; a retired one is not used again.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from osc2tx.diagnostics.model import Severity
from osc2tx.diagnostics.suggestions import nearest
from osc2tx_shared.classes import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Explanation:
    """An example of a mistake.

    Attributes:
        remedy: The remedy, one or two sentences.
        faulty: A source text with the mistake.
        fixed: The same text without it; empty where the mistake is not in the text.
        standard: Version of the standard of the example.
        dialect: Its dialect.
        target: Its target; some codes concern only one target.
    """

    remedy: str
    faulty: str
    fixed: str = ""
    standard: str = "2.1"
    dialect: str = "asam"
    target: str = "all"

    @property
    def options(self) -> str:
        """The options with which the example shows the code, as on the command line."""
        standard = f"--std {self.standard}" if self.standard != "2.1" else ""
        dialect = f"--dialect {self.dialect}" if self.dialect != "asam" else ""
        target = f"--target {self.target}" if self.target != "all" else ""
        return " ".join(option for option in (standard, dialect, target) if option)


def explanation_of(code: str) -> Explanation | None:
    """Return the explanation of a code; `None` if there is none."""
    found = _family(code[3:4]).get(code)
    return None if found is None else Explanation(**found)


@cache
def _family(digit: str) -> Mapping[str, Mapping[str, Any]]:
    import tomllib  # only needed for explanations
    from importlib.resources import files

    path = files("osc2tx.diagnostics") / "texts" / f"{digit}xx.toml"
    return tomllib.loads(path.read_text(encoding="utf-8")) if path.is_file() else {}


ERROR, WARNING = Severity.ERROR, Severity.WARNING


@dataclass(frozen=True, slots=True)
class Code:
    """One kind of report.

    Attributes:
        code: `OSC203`.
        slug: Short name in kebab case.
        severity: Its effect on the run.
        summary: One sentence for the reference.
        section: Section of OpenSCENARIO DSL 2.2 that states the rule, where there is one.
        warns_in_check: An error of a run that `check` reports as a warning where options of the
            run, or packages, can remove it.
    """

    code: str
    slug: str
    severity: Severity
    summary: str
    section: str = ""
    warns_in_check: bool = False

    @property
    def explanation(self) -> Explanation | None:
        """An example and how to fix it."""
        return explanation_of(self.code)

    @property
    def can_be_suppressed(self) -> bool:
        """Whether a comment `#! allow` can keep it back."""
        is_warning = self.severity is WARNING or self.warns_in_check
        return is_warning and not self.code.startswith("OSC7")


def _table(*rows: Code) -> dict[str, Code]:
    codes = {row.code: row for row in rows}
    assert len(codes) == len(rows), "a diagnostic code is registered twice"
    return codes


CODES = _table(
    # --- 1xx text and syntax ---
    Code("OSC100", "syntax-error", ERROR, "The text does not follow the grammar.", "7.2.2"),
    Code("OSC101", "unreadable-source", ERROR, "The file cannot be read or decoded.", "7.2.1.1"),
    Code("OSC102", "unknown-character", ERROR, "A character starts no token.", "7.2.1.5"),
    Code("OSC103", "unterminated-string", ERROR, "A string has no end.", "7.2.1.5.2"),
    Code("OSC104", "inconsistent-dedent", ERROR, "No block has this indentation.", "7.2.1.4"),
    Code("OSC105", "nesting-too-deep", ERROR, "Blocks or brackets nest too deeply.", "7.2.1"),
    Code("OSC106", "unclosed-bracket", ERROR, "A bracket is not closed.", "7.2.1.3"),
    Code("OSC107", "literal-out-of-range", ERROR, "A number does not fit its type.", "7.2.1.5.2"),
    Code("OSC108", "invalid-member", ERROR, "A member does not belong here.", "7.2.2"),
    Code("OSC109", "positional-after-named", ERROR, "Named arguments come last.", "7.3.5.1.3"),
    Code("OSC110", "use-statement", ERROR, "`use` is a clause of `namespace`.", "7.7.3"),
    Code("OSC111", "foreign-comment", ERROR, "Comments begin with `#`.", "7.2.1.2"),
    Code("OSC112", "empty-block", ERROR, "A block has no lines.", "7.2.2"),
    Code("OSC113", "implicit-serial", WARNING, "`do:` is read as `do serial:`.", "7.3.13"),
    Code("OSC114", "empty-parentheses", ERROR, "Empty parentheses are not allowed.", "7.3.10"),
    Code("OSC115", "line-too-long", ERROR, "A logical line exceeds the limit of tokens.", "7.2.1"),
    Code("OSC116", "merge-conflict", ERROR, "A merge conflict is not resolved."),
    # --- 5xx not supported by a backend ---
    Code("OSC501", "unsupported-declaration", ERROR, "No backend can express this member yet."),
    Code("OSC502", "unsupported-constraint", ERROR, "A constraint depends on the world.", "7.3.11"),
    Code("OSC503", "unsupported-expression", ERROR, "No backend can express this expression yet."),
    Code("OSC504", "unsupported-invocation", ERROR, "No backend can express this invocation yet."),
    Code("OSC506", "unsupported-directive", ERROR, "No backend can express this directive yet."),
    Code("OSC507", "abstract-action", ERROR, "An abstract action has no behavior.", "8.8.1"),
    Code("OSC508", "unsupported-modifier", ERROR, "The action does not support this modifier."),
    Code("OSC509", "unsupported-argument", ERROR, "The runtime does not support this argument."),
    Code("OSC510", "nothing-to-do", WARNING, "The scenario has no `do`."),
    Code("OSC511", "circular-value", ERROR, "A value is defined by itself.", "7.3.6"),
    Code("OSC512", "external-method", ERROR, "An external method is no Python function.", "7.3.7"),
    Code("OSC513", "inconsistent-arguments", ERROR, "Arguments are incomplete, or contradict."),
    Code("OSC514", "inexpressible-in-xml", ERROR, "OpenSCENARIO XML cannot express this."),
    Code("OSC515", "approximated-in-xml", ERROR, "OpenSCENARIO XML only approximates this."),
    Code("OSC516", "quantity-out-of-range", ERROR, "A quantity exceeds the limits of worlds."),
    Code("OSC518", "deviation-in-xml", ERROR, "A document deviates from its scenario."),
    Code("OSC519", "contradictory-durations", ERROR, "Durations contradict.", "7.6.2.1"),
    Code("OSC517", "renamed-module", WARNING, "A file has the name of a Python module."),
    # --- 2xx names and imports ---
    Code("OSC201", "unknown-name", ERROR, "A name is not defined here.", "7.7.4"),
    Code("OSC202", "unknown-type", ERROR, "No type has this name.", "7.3"),
    Code("OSC203", "duplicate-definition", ERROR, "A name is defined twice.", "7.3"),
    Code("OSC204", "ambiguous-name", ERROR, "Several used namespaces offer a name.", "7.7.4"),
    Code("OSC205", "import-not-found", ERROR, "An imported file does not exist.", "7.7.5"),
    Code("OSC206", "unknown-namespace", ERROR, "No namespace has this name.", "7.7.3"),
    Code("OSC207", "reserved-namespace", ERROR, "`std…` is for the standard library.", "7.7.3"),
    Code("OSC208", "unknown-member", ERROR, "A type has no such member.", "7.3.5"),
    Code("OSC209", "unknown-unit", ERROR, "No unit has this name.", "7.3.4"),
    Code("OSC210", "unknown-event", ERROR, "An event is not declared.", "7.3.10"),
    Code("OSC211", "unknown-behavior", ERROR, "An actor has no such behavior.", "7.3.13"),
    Code("OSC212", "unknown-modifier", ERROR, "No modifier has this name.", "7.3.12"),
    Code("OSC213", "newer-standard", ERROR, "A construct belongs to a later standard."),
    Code("OSC214", "unknown-export", ERROR, "An exported name does not exist.", "7.7.4"),
    Code("OSC215", "name-not-visible", ERROR, "A name is in an unused namespace.", "7.7.4"),
    Code("OSC216", "reserved-name", ERROR, "`osc.…` is for the standard.", "7.3.7.4"),
    # --- 3xx types and units ---
    Code("OSC301", "type-mismatch", ERROR, "A value has the wrong type.", "7.4.2.6"),
    Code("OSC302", "dimension-mismatch", ERROR, "Physical dimensions differ.", "7.3.4"),
    Code("OSC303", "missing-unit", ERROR, "A physical value has no unit.", "7.3.4"),
    Code("OSC304", "invalid-operands", ERROR, "An operator rejects its operands.", "7.4.2"),
    Code("OSC305", "unit-exponents", ERROR, "A unit does not fit its type.", "7.3.4"),
    Code("OSC306", "invalid-base", ERROR, "A type cannot inherit from this.", "7.3.8"),
    Code("OSC307", "inheritance-cycle", ERROR, "A type inherits from itself.", "7.3.8"),
    Code("OSC308", "invalid-condition", ERROR, "A condition of inheritance is invalid.", "7.3.8"),
    Code("OSC310", "invalid-range-type", ERROR, "Only numbers form ranges.", "7.3.5.2.2"),
    Code("OSC311", "not-a-type", ERROR, "A modifier is not a type.", "7.3.12"),
    Code("OSC312", "enum-value-cycle", ERROR, "An enum value depends on itself.", "7.3.3"),
    Code("OSC313", "ambiguous-enum-member", ERROR, "Several enums have this member.", "7.3.3"),
    Code("OSC314", "no-common-type", ERROR, "Elements have no common type.", "7.4.2.7"),
    Code("OSC315", "invalid-cast", ERROR, "A value cannot be converted to a type.", "7.4.2.6"),
    Code("OSC316", "not-a-value", ERROR, "A name does not denote a value.", "7.4.1"),
    Code("OSC317", "negative-unsigned", ERROR, "An unsigned value is negative.", "7.4.2.6"),
    Code("OSC318", "actor-association", ERROR, "Actors of base and type differ.", "7.3.8"),
    Code("OSC319", "invalid-override", ERROR, "An overriding method does not fit.", "7.3.7"),
    Code("OSC320", "event-specification", ERROR, "A specification excludes parameters.", "7.3.10"),
    Code("OSC321", "invalid-extension", ERROR, "A type has no such extension.", "7.3.9"),
    Code("OSC322", "same-dimension", ERROR, "Two types have one dimension.", "7.3.4"),
    Code("OSC323", "reversed-range", WARNING, "The upper bound comes first.", "7.3.5.2.2"),
    Code("OSC324", "too-many-levels", ERROR, "A type has too many supertypes.", "7.3.8"),
    # --- 4xx behaviors, modifiers and constraints ---
    Code("OSC401", "several-do", ERROR, "A behavior has more than one `do`.", "7.3.13"),
    Code("OSC402", "unknown-argument", ERROR, "No parameter has this name.", "7.3.5.1.3"),
    Code("OSC403", "duplicate-argument", ERROR, "A parameter is given twice.", "7.3.5.1.3"),
    Code("OSC404", "missing-argument", ERROR, "A required argument is missing.", "7.3.7"),
    Code("OSC405", "too-many-arguments", ERROR, "Too many arguments are given.", "7.3.5.1.3"),
    Code("OSC406", "modifier-not-applicable", ERROR, "A modifier does not apply here.", "7.3.12"),
    Code("OSC407", "missing-actor", ERROR, "An invocation has no actor.", "7.3.13"),
    Code("OSC408", "exclusive-arguments", ERROR, "Arguments exclude each other.", "8.9.1.3"),
    Code("OSC409", "range-argument", ERROR, "A method takes no range here.", "7.3.7"),
    Code("OSC410", "no-result", ERROR, "A method without result is used as value.", "7.3.7"),
    Code("OSC411", "constrained-variable", ERROR, "A variable is constrained.", "7.3.6"),
    Code("OSC412", "invalid-coverage", ERROR, "Coverage arguments do not fit.", "7.5"),
    Code("OSC413", "implicit-it", WARNING, "A parameter is named without `it.`.", "7.4.1.3"),
    Code("OSC414", "implication-chain", WARNING, "`a => b => c` is not specified.", "7.4.2"),
    Code("OSC415", "type-as-object", WARNING, "A type denotes its only object.", "7.4.1"),
    Code("OSC416", "operator-as-label", WARNING, "A label has the name `serial`.", "7.3.13"),
    Code("OSC417", "overrides-nothing", WARNING, "`only` has no method to override.", "7.3.7.2"),
    # 42x constraints, 43x unreachable parts, 44x times
    Code("OSC420", "contradiction", ERROR, "Constraints contradict each other.", "7.3.11"),
    Code("OSC421", "impossible-constraint", ERROR, "A constraint can never hold.", "7.3.11"),
    Code("OSC422", "contradicted-default", ERROR, "A default contradicts others.", "7.3.11"),
    Code("OSC423", "contradicted-argument", ERROR, "An argument is not allowed.", "7.3.5.1.3"),
    Code("OSC424", "integer-overflow", ERROR, "A number does not fit its type.", "7.3.2"),
    Code("OSC425", "division-by-zero", WARNING, "A divisor is always zero.", "7.4.2"),
    Code("OSC426", "impossible-conversion", ERROR, "A conversion has no result.", "7.4.2.6"),
    Code("OSC427", "undefined-method", ERROR, "A method without body is invoked.", "7.3.7.1"),
    Code("OSC430", "event-from-outside", WARNING, "Nothing emits an awaited event.", "7.3.10"),
    Code(
        "OSC431",
        "event-without-use",
        WARNING,
        "Nothing waits for an event, and a similar one is never emitted.",
        "7.3.10",
    ),
    Code("OSC432", "unreachable-member", WARNING, "The preceding member never ends.", "7.3.13"),
    Code("OSC433", "unused-actor", WARNING, "An actor is not used.", "7.3.6"),
    Code("OSC434", "endless-composition", WARNING, "No member ends by itself.", "7.3.13"),
    Code("OSC435", "single-alternative", WARNING, "`one_of` has one member.", "7.3.13.3"),
    Code("OSC436", "constant-condition", WARNING, "A condition never changes.", "7.3.10"),
    Code("OSC437", "unused-parameter", WARNING, "A parameter is never read.", "7.3.6"),
    Code("OSC438", "endless-recursion", ERROR, "A scenario invokes itself.", "7.3.13"),
    Code("OSC439", "contradictory-until", ERROR, "`until` and duration disagree.", "7.6.2.5.4"),
    Code("OSC440", "shorter-than-a-step", WARNING, "A wait is shorter than a step.", "7.3.10"),
    Code("OSC441", "reaction-at-every-instant", WARNING, "`on` reacts at every instant.", "7.3.10"),
    Code("OSC442", "shared-slot", WARNING, "Members control the same slot.", "7.3.13"),
    Code("OSC443", "map-not-found", WARNING, "The map is not found.", "8.12.2.2.11"),
    Code("OSC444", "too-many-members", ERROR, "Invocations multiply members.", "7.3.13"),
    Code("OSC445", "offset-without-overlap", ERROR, "An offset has no overlap.", "7.3.13.2"),
    # --- 6xx relaxations of a dialect ---
    Code("OSC601", "relaxed-use", WARNING, "A `use` statement is accepted.", "7.7.3"),
    Code("OSC602", "relaxed-do", WARNING, "Several `do` run one after the other.", "7.3.13"),
    Code("OSC603", "relaxed-event", WARNING, "An undeclared event is declared by use.", "7.3.10"),
    Code("OSC604", "relaxed-dimension", WARNING, "A product is taken as number in SI.", "7.3.4"),
    Code("OSC605", "relaxed-unit", WARNING, "A plain number is taken in SI units.", "7.3.4"),
    Code("OSC606", "relaxed-import", WARNING, "The library is imported by file name.", "7.7.5"),
    Code("OSC607", "prelude-member", WARNING, "A member belongs to the dialect's prelude."),
    Code("OSC608", "prelude-parameter", WARNING, "A parameter belongs to the prelude."),
    Code("OSC609", "prelude-behavior", WARNING, "A behavior belongs to the prelude."),
    Code("OSC610", "prelude-type", WARNING, "A type belongs to the dialect's prelude."),
    Code("OSC611", "prelude-modifier", WARNING, "A modifier belongs to the prelude."),
    Code("OSC612", "alias-type", WARNING, "A type has another name in the standard.", "8.14"),
    Code("OSC613", "alias-unit", WARNING, "A unit has another name in the standard.", "8.14"),
    Code("OSC614", "alias-parameter", WARNING, "A parameter has another name in the standard."),
    Code("OSC615", "alias-enum-member", WARNING, "A member has another standard name."),
    Code("OSC616", "repeated-declaration", WARNING, "A known name is declared again.", "7.3"),
    Code("OSC617", "relaxed-module", WARNING, "A file is imported without quotes.", "7.7.5"),
    Code("OSC618", "method-of-a-type", WARNING, "A method is called on the type itself.", "7.3.7"),
    Code("OSC619", "alias-member", WARNING, "A member has another name in the standard."),
    Code("OSC620", "runner-event", WARNING, "An event is only raised by `emit` here.", "7.3.10"),
    Code("OSC621", "quantity-text", WARNING, "A string names the speed of an actor.", "7.4.2.6"),
    Code("OSC622", "implied-actor", WARNING, "An actor type denotes an actor."),
    Code("OSC623", "first-of-two-ends", WARNING, "The first of `until` and duration.", "7.6.2.5.4"),
    Code("OSC624", "undeclared-model", WARNING, "A model of an actor is not declared.", "7.3"),
    Code("OSC625", "repeated-label", WARNING, "A label is used twice.", "7.3.13"),
    Code("OSC626", "relaxed-layout", WARNING, "A line begins between two blocks.", "7.2.1.4"),
    Code("OSC627", "argument-none", WARNING, "`None` denotes an omitted argument."),
    Code("OSC628", "caller-actor", WARNING, "An actor of the caller is used by its name."),
    # --- 7xx suppressions ---
    Code("OSC701", "unused-suppression", WARNING, "A suppression suppresses nothing."),
    Code("OSC702", "unknown-suppression", WARNING, "A suppression names an unknown code."),
    Code("OSC703", "invalid-suppression", WARNING, "A code cannot be suppressed."),
    Code("OSC704", "empty-suppression", WARNING, "A suppression names no code."),
    # --- 8xx runs; the classes of errors in the runtime have these codes ---
    Code("OSC801", "run-impossible", ERROR, "A run cannot begin, or cannot continue."),
    Code("OSC802", "no-such-position", ERROR, "An actor cannot be placed at a position."),
    Code("OSC803", "slot-conflict", ERROR, "Two actions control the same slot of an actor."),
    Code(
        "OSC804",
        "unsupported-by-runtime",
        ERROR,
        "The runtime does not support this.",
        warns_in_check=True,
    ),
    Code("OSC805", "unsupported-by-world", ERROR, "The chosen world does not support this."),
    Code("OSC806", "run-option", ERROR, "An option of a run is wrong.", warns_in_check=True),
    Code("OSC807", "run-file", ERROR, "A file of a run cannot be found, read or written."),
    Code("OSC808", "simulator", ERROR, "The simulator is not available, or refuses."),
    Code("OSC809", "run-failed", ERROR, "A run ended with a failure, or not in time."),
    Code("OSC810", "condition-failed", ERROR, "A condition of a modifier does not hold.", "8.9.1"),
    Code(
        "OSC811",
        "condition-missed",
        WARNING,
        "A condition of a modifier holds only for a part of its phase.",
        "8.8.2.2",
    ),
)


def find_code(written: str) -> Code | None:
    """Return the code of that number, name or slug, in capitals or not."""
    if written.isdecimal():
        written = f"OSC{written}"
    return CODES.get(written.upper()) or _by_slug().get(written.lower())


def meant_code(written: str) -> str | None:
    """Return the code or slug that was probably meant."""
    if written.isdecimal():
        written = f"OSC{written}"
    return nearest(written.upper(), CODES, 0.8) or nearest(written.lower(), _by_slug())


@cache
def _by_slug() -> dict[str, Code]:
    return {code.slug: code for code in CODES.values()}
