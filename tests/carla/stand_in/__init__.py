"""A stand-in for the server of CARLA 0.9.16: the unmodified client library connects to it.

It answers the calls that a scenario tool makes, moves vehicles by a kinematic single-track model,
and repeats itself to the bit. Calls it does not know are answered with an error and counted.

From the wire up: `rpc` and `streams` (what travels), `snapshot` (the state of all actors as
bytes), `actors`, `dynamics`, `blueprints`, `level` (the map), `traffic_lights`, `simulation`
(time, spawning, contacts); calls by subject: `server_calls`, `actor_calls`, `vehicle_calls`,
`signal_calls`, `batches`; `faults` are ways to misbehave; `server` puts them together, `process`
runs it in a process of its own.

It cannot show what needs the real one: rigid-body physics, sizes of all blueprints, pictures,
data of sensors, DDS.
"""
