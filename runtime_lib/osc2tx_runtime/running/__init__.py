"""One run of a scenario.

`main` reads the command line by the table of `options`, `runner` makes world, cast and tree, `loop`
goes from one instant to the next until the verdict.
"""
