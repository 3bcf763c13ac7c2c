"""The parser made from grammar/OpenSCENARIO2.g4 by `make parser`; not to be edited."""
