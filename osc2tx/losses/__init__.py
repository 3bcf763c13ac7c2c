"""Loss reports: how exactly OpenSCENARIO XML says what a scenario says, construct by construct.

The back end notes the grades, `grading` adds what played documents show; `compilation` writes the
reports beside the documents.
"""
