/*
 * ASAM OpenSCENARIO DSL 2.1 and 2.2.
 *
 * The tokens come from `osc2tx/syntax/token_source.py`, which also decides which words are keywords
 * and where blocks begin and end; their names stand in `OpenSCENARIO2Tokens.tokens`. The grammar is
 * LL(1) and takes more than the language does: one rule `statement` for all places, optional colons
 * and blocks, one rule `expression` without precedence. What is too much is refused with a message
 * of its own by `osc2tx/syntax/ast_builder/`. See README.md for the why.
 *
 * Section numbers are those of the 2.2 standard.
 */
parser grammar OpenSCENARIO2;

options { tokenVocab = OpenSCENARIO2Tokens; }

// --- Layout -------------------------------------------------------------------------------------

// A first line that is indented starts a `block` here; the builder says so.
sourceFile : block? statement* EOF ;

block : INDENT statement* DEDENT ;

// Recovery: a mistake inside a statement never leaves it (see `parser.py`).
// The most frequent kinds come first: the generated code compares one after the other.
statement
    : nameStatement | composition | waitDirective
    | keepConstraint | variableDeclaration | eventDeclaration | methodDeclaration
    | emitDirective | callDirective | untilDirective | onDirective | doDirective
    | structDeclaration | actorDeclaration | scenarioDeclaration | actionDeclaration
    | modifierDeclaration | enumDeclaration | unitDeclaration | physicalTypeDeclaration
    | extension | globalParameter | removeDefault | coverageDeclaration
    | importStatement | namespaceStatement | useStatement | exportStatement
    ;

// `: NEWLINE block` or `NEWLINE`; a colon without block and a block without colon are refused later.
body : ':'? NEWLINE block? ;

withBlock : 'with' ':'? ( NEWLINE block? | statement ) ;

// --- File level (7.2.2.1, 7.7) ------------------------------------------------------------------

importStatement : 'import' ( STRING | dottedName ) NEWLINE block? ;

dottedName : ID ( '.' ID )* ;

namespaceStatement : 'namespace' ID ( 'use' dottedName ( ',' dottedName )* )? NEWLINE block? ;

// Not in the standard, but in files one meets.
useStatement : 'use' dottedName ( ',' dottedName )* NEWLINE block? ;

exportStatement : 'export' exportItem ( ',' exportItem )* NEWLINE block? ;

exportItem : ID | '*' | NAMESPACE_STAR ;

globalParameter : 'global' nameStatement ;

// --- Type names (7.2.2.2) -----------------------------------------------------------------------

typeName : ( ( 'list' | 'range' ) 'of' )* behaviorName ;

behaviorName : ID ( '.' ID )? ;

// --- Physical types, units, enumerations (7.3.3, 7.3.4) -----------------------------------------

physicalTypeDeclaration : 'type' ID 'is' siUnit NEWLINE block? ;

unitDeclaration : 'unit' ID 'of' ID 'is' siUnit NEWLINE block? ;

siUnit : ID '(' arguments? ')' ;

enumDeclaration : 'enum' ID ':' enumMembers NEWLINE block? ;

enumMembers : '[' enumMember ( ',' enumMember )* ']' ;

enumMember : ID ( '=' expression )? ;

// --- Structured types (7.3.5, 7.3.8, 7.3.9) -----------------------------------------------------

structDeclaration : 'struct' behaviorName inheritance? body ;

actorDeclaration : 'actor' behaviorName inheritance? body ;

scenarioDeclaration : 'scenario' behaviorName inheritance? body ;

actionDeclaration : 'action' behaviorName inheritance? body ;

modifierDeclaration : 'modifier' behaviorName ( 'of' behaviorName )? body ;

inheritance : 'inherits' behaviorName ( '(' expression ')' )? ;

extension : 'extend' behaviorName ':'? enumMembers? NEWLINE block? ;

// --- Members (7.3.5 - 7.3.12, 7.5) --------------------------------------------------------------

eventDeclaration
    : 'event' ID ( '(' parameters? ')' )? ( 'is' eventSpecification )? NEWLINE block?
    ;

parameters : parameter ( ',' parameter )* ;

parameter : ID ':' typeName ( '=' expression )? ;

// `rise`, `fall`, `elapsed` and `every` are calls until the builder sees where they stand.
eventSpecification : '@'? expression ( 'as' ID )? ( 'if' expression )? ;

variableDeclaration
    : 'var' ID ( ',' ID )* ':' typeName ( '=' ( sampleExpression | expression ) )? ending
    ;

sampleExpression : 'sample' '(' expression ',' eventSpecification ( ',' expression )? ')' ;

methodDeclaration
    : 'def' ID '(' parameters? ')' ( '->' typeName )? 'is' 'only'?
      ( 'expression' expression
      | 'undefined'
      | 'external' dottedName '(' arguments? ')'
      )
      NEWLINE block?
    ;

keepConstraint : 'keep' '(' ( 'default' | 'hard' )? expression ')' NEWLINE block? ;

removeDefault : 'remove_default' '(' expression ')' NEWLINE block? ;

coverageDeclaration : ( 'cover' | 'record' ) '(' arguments? ')' NEWLINE block? ;

// Everything that starts with a name: fields, modifier applications, invocations, each with or
// without a label. A label and a field name look alike; the place of the statement decides.
nameStatement
    : expression ( ',' expression )*
      ( ':' ( composition | waitDirective | emitDirective | callDirective | typedRest )
      | ending
      )
    ;

typedRest : ( ( ( 'list' | 'range' ) 'of' )+ behaviorName | expression ) ( '=' expression )? ending ;

// The block stands on the statement's own line; one on the next line is refused later.
ending : withBlock | NEWLINE block? withBlock? ;

// --- Behavior (7.3.13) --------------------------------------------------------------------------

onDirective : 'on' eventSpecification body ;

doDirective
    : 'do'
      ( ':' NEWLINE block? withBlock?
      | composition | waitDirective | emitDirective | callDirective | nameStatement
      )
    ;

composition
    : ( 'serial' | 'parallel' | 'one_of' ) ( '(' arguments? ')' )? ':'? NEWLINE block? withBlock?
    ;

waitDirective : 'wait' eventSpecification NEWLINE block? ;

emitDirective : 'emit' expression NEWLINE block? ;

callDirective : 'call' expression NEWLINE block? ;

untilDirective : 'until' eventSpecification NEWLINE block? ;

// --- Expressions (7.4) --------------------------------------------------------------------------

// Operands, postfix forms and operators in one flat row; the builder knows the precedence.
expression
    : ( '-' | '+' | 'not' )* ( ID | INTEGER | FLOAT | PHYSICAL | STRING | group )
      ( '.' ( ID | ( 'as' | 'is' ) '(' typeName ')' )
      | '!' ID
      | '[' expression ']'
      | '(' arguments? ')'
      | ( '=>' | 'or' | 'and' | '==' | '!=' | '<' | '<=' | '>' | '>=' | 'in'
        | '+' | '-' | '*' | '/' | '%'
        )
        ( '-' | '+' | 'not' )* ( ID | INTEGER | FLOAT | PHYSICAL | STRING | group )
      )*
      ( '?' expression ':' expression )?
    ;

group
    : '(' expression ')'
    | '[' ( expression ( '..' expression | ( ',' expression )* ) )? ']'
    ;

arguments : expression ( ':' expression )? ( ',' expression ( ':' expression )? )* ;
