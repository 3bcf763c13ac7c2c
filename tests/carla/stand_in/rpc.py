"""Remote calls of CARLA: MessagePack-RPC over TCP.

A request is `[0, number, name, [[asynchronous], argument, ...]]`, its answer
`[1, number, nil, result]`. A value comes as `[[1, value]]` and an error as `[[0, [text]]]`; calls
without value answer `[[false]]` and `[[true, [text]]]`.
"""

from __future__ import annotations

import contextlib
import socket
import socketserver
import threading
from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any

import msgpack

WITHOUT_VALUE = {"reset_all_traffic_lights", "set_actor_collisions", "set_actor_simulate_physics"}
"""Calls without value whose errors the client reads."""

UNWRAPPED = {"apply_batch"}
"""Calls whose value is a list of results by itself."""


class CallError(Exception):
    """A call that fails: the client raises a RuntimeError with this text."""


class TcpServer(socketserver.ThreadingTCPServer):
    """Serves each connection in a thread."""

    allow_reuse_address = daemon_threads = True

    def __init__(self, port: int, serve: Callable[[socket.socket], None]) -> None:
        class Session(socketserver.BaseRequestHandler):
            def handle(self) -> None:
                self.request.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                with contextlib.suppress(OSError):  # the client is gone
                    serve(self.request)

        super().__init__(("127.0.0.1", port), Session)
        self.port = int(self.server_address[1])
        threading.Thread(target=self.serve_forever, args=(0.05,), daemon=True).start()

    def close(self) -> None:
        """Stop serving."""
        self.shutdown()
        self.server_close()


class CallLog:
    """What has been called.

    Attributes:
        calls: Names and arguments, in their order.
        unknown: How often calls came that nobody answers here, by name.
    """

    def __init__(self) -> None:
        self.calls: list[tuple[str, list[Any]]] = []
        self.unknown: Counter[str] = Counter()


class RpcServer:
    """Answers calls one at a time; those of one connection in their order.

    Args:
        port: Where; 0 takes a free port.
        calls: What answers, by the names of the calls.
        unlogged: Names of calls that are no client's, so that the log does not have them.
    """

    def __init__(
        self, port: int, calls: Mapping[str, Callable[..., Any]], log: CallLog, unlogged: set[str]
    ) -> None:
        self.lock = threading.RLock()
        self._calls, self._log, self._unlogged = calls, log, unlogged
        self._server = TcpServer(port, self._serve)
        self.port, self.close = self._server.port, self._server.close

    def _serve(self, connection: socket.socket) -> None:
        unpacker = msgpack.Unpacker(raw=False, strict_map_key=False)
        while received := connection.recv(1 << 16):
            unpacker.feed(received)
            for _, number, name, (_, *arguments) in unpacker:
                result = self._result(name, arguments)
                connection.sendall(msgpack.packb([1, number, None, result]))

    def _result(self, name: str, arguments: list[Any]) -> Any:
        with self.lock:
            try:
                value = self._answer(name, arguments)
            except (CallError, TypeError) as error:  # a TypeError: other arguments than expected
                return [[True, [str(error)]]] if name in WITHOUT_VALUE else [[0, [str(error)]]]
        if name in UNWRAPPED:
            return value
        return [[False]] if value is None else [[1, value]]

    def _answer(self, name: str, arguments: list[Any]) -> Any:
        if name not in self._unlogged:
            self._log.calls.append((name, arguments))
        if name not in self._calls:
            self._log.unknown[name] += 1
            raise CallError(f"the stand-in does not know {name}")
        return self._calls[name](*arguments)
