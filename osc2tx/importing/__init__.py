"""OpenSCENARIO XML to DSL: a storyboard becomes the program that it was written from.

1. `document`: a file with its catalogs and its map (`substitution`: with other texts, `reach`: the
   files that it may name); `cursor` notes what of it has been used
2. `parameters` with the `dimensions` that their uses give them, `values`: `expressions` with units
3. `cast`, `places` (`ground`: at the start, `beside` other actors, `courses` on the map, `points`
   as texts), `conditions` (`entity_conditions`, `place_conditions`, `clearances`) and `actions`
   (`speeds` with `profiles`, `offsets`, `routes`, `synchrony`, `surroundings`), `signals` of both:
   the parts of the storyboard; `effects` has what their readers share
4. `board`: the storyboard as `steps`, events with their triggers, one for each time that they are
   executed; `structure`: the order of events as compositions of `statements` (`acts` that are
   stopped, `joining` what waits for several ends), `waiting` the triggers as waits, `starts` how
   actors begin, `endings` what ends the scenario, `whole` all together, `wording` in fewer words
5. `declarations` and `program`: the text; `report`: how exactly it says what the document says

`importer` runs them on one file, `distributions` turns values for runs (`value_files`) into
settings of campaigns. `batch` imports several files: scenarios with values inherit the one of their
document, those of a folder what they share (`families`); what they take from catalogs is in their
library file (`libraries`).
"""
