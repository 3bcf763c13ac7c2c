"""The map as scenarios speak of it (DSL 8.12): roads, lanes, crossings, routes; what it offers."""
