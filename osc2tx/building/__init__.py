"""From a tree of sources to a tree of modules.

Every source file that declares a scenario gives `NAME.py` and its map `NAME.map.json`; the layout
of the sources is mirrored. A file with errors does not stop the others. Outputs appear whole or
not at all, and those that are up to date are not touched.

`build` is the way through: `jobs` says what there is to compile, `result_cache` knows the `results`
of earlier builds that still hold (`fingerprint` is what they hold for), `workers` make the others,
`plan` compares what the sources make with the folder, where `ownership` tells which files are ours,
`written_digests` and `version_control` which of them nobody has edited, and `write` brings the
folder up to date. `compare` shows changes instead; `watch` builds again when a source changes.
"""
