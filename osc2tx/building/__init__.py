"""From a tree of sources to a tree of modules.

Every source file that declares a scenario gives `NAME.py` and its map `NAME.map.json`; the layout
of the sources is mirrored. A file with errors does not stop the others. Outputs appear whole or
not at all, and those that are up to date are not touched.

`build` is the control flow: `jobs` lists the files to compile, `result_cache` holds the `results`
of earlier builds that are still valid (`fingerprint` is their key), `workers` make the others,
`plan` compares the outputs with the folder, where `ownership` tells which files are ours,
`written_digests` and `version_control` which of them are unedited, and `write` brings the
folder up to date. `compare` shows changes instead, also since a revision, whose sources
`revision_files` lays out; `watch` builds again when a source changes.
"""
