"""The intermediate representation: the meaning of a program, for any backend.

Nodes are frozen data without references to syntax or symbols; each has its span. Modules, in
reading order: `values`, `expressions`, `behaviors`, `declarations`, `user_types`, `coverage`,
`nodes`; then `traversal`, `trees`, `starts`, `occurrences`, `compare`, `inheritance`, `verify` (the
invariants) and `dump` (the printable form).
"""

from osc2tx.ir.alternatives import is_drawn, is_partly_drawn
from osc2tx.ir.behaviors import (
    Application,
    Behavior,
    BehaviorBase,
    Call,
    Composition,
    CompositionBase,
    Condition,
    Edge,
    Elapsed,
    Emit,
    EventRef,
    Every,
    Finish,
    InnerEvent,
    Invoke,
    InvokeScenario,
    LabelEvent,
    Level,
    ModifierCall,
    Moment,
    On,
    OneOf,
    Parallel,
    Serial,
    SpecialScenario,
    Trigger,
    Wait,
)
from osc2tx.ir.compare import means_same, same, words
from osc2tx.ir.coverage import Bucket, Coverage
from osc2tx.ir.declarations import (
    GLOBAL_MARK,
    Actor,
    Constraint,
    Declaration,
    DeclarationBase,
    Event,
    External,
    FieldValue,
    Method,
    MethodParameter,
    Parameter,
    Sample,
    Struct,
    Variable,
    setting_name,
)
from osc2tx.ir.endings import ends_with_open, goals_of, is_instant, is_open, lasts_until_event
from osc2tx.ir.expression_text import show, show_arguments
from osc2tx.ir.expressions import (
    Argument,
    Attribute,
    Binary,
    Choices,
    Conditional,
    Conversion,
    Domain,
    Downcast,
    Element,
    EnumValue,
    EventArgument,
    Expression,
    FieldRef,
    HalfRange,
    Index,
    InvokedValue,
    ListOperation,
    ListOperator,
    ListValue,
    Literal,
    Lookup,
    MethodCall,
    ParameterRef,
    Quantity,
    RangeValue,
    ScenarioSelf,
    TypeTest,
    Unary,
    Undefined,
    UserShape,
)
from osc2tx.ir.inheritance import Additions, additions, is_named_after, without_bases
from osc2tx.ir.nodes import AbstractScenario, Module, Override, Placement, Scenario
from osc2tx.ir.occurrences import WAITABLE, Occurrences, early_triggers, emitted_by, triggers_of
from osc2tx.ir.traversal import applied_with, bounds, children, constant, is_live, rewrite, walk
from osc2tx.ir.trees import (
    actors_of,
    around,
    entry_of,
    first_actions,
    follower,
    holds,
    invocations,
    is_first,
    is_last,
    is_single,
    is_timed,
    may_be_cut,
    predecessor,
    runs_beside,
    starts_at_once,
    starts_together,
    takes_time,
)
from osc2tx.ir.user_types import (
    ActionParameter,
    UserAction,
    UserEnum,
    UserField,
    UserModifier,
    UserType,
    UserUnit,
    lineage,
    lineages,
    merged,
)
from osc2tx.ir.values import (
    CommentBelow,
    ExpressionBase,
    Kind,
    TrailingComment,
    Unit,
    ValueType,
    qualified,
)
from osc2tx.ir.verify import condition_expressions, verify, walk_behaviors
