"""OpenSCENARIO XML to DSL: a storyboard becomes the program that it was written from.

1. `document`: a file with its catalogs and its map; `cursor` notes what of it has been used
2. `values`: parameters with the dimensions that their uses give them, expressions with units
3. `cast`, `places`, `actions`, `conditions`: the parts of the storyboard, each by its table
4. `steps`: events with their triggers; `structure`: the order of events as compositions
5. `program`: the text; `report`: how exactly it says what the document says

`importer` runs them on one file, `distributions` turns values for runs into settings of campaigns.
"""
