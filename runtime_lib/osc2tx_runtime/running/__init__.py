"""One run of a scenario.

`main` reads the command line by the table of `options`, `runner` creates world, cast and tree,
`loop` settles one instant after the other until the verdict.
"""
