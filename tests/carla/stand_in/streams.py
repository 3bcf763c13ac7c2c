"""Streams of CARLA: a client connects, writes the number of a stream, and messages follow.

A message is its length (uint32, little endian) and as many bytes. `token` is how calls tell a
client where a stream is.
"""

from __future__ import annotations

import contextlib
import socket
import struct
import threading

from .rpc import TcpServer


class StreamServer:
    """Sends messages to all who subscribed to a stream."""

    def __init__(self) -> None:
        self._subscribers: dict[int, list[socket.socket]] = {}
        self._lock = threading.Lock()
        self._server = TcpServer(0, self._serve)
        self.close = self._server.close

    def _serve(self, connection: socket.socket) -> None:
        (stream,) = struct.unpack("<I", connection.recv(4, socket.MSG_WAITALL))
        with self._lock:
            self._subscribers.setdefault(stream, []).append(connection)
        try:
            while connection.recv(1):
                pass  # a subscriber says nothing until it goes
        finally:
            with self._lock:
                self._subscribers[stream].remove(connection)

    def subscribers(self, stream: int) -> int:
        """Return how many listen to a stream."""
        return len(self._subscribers.get(stream, ()))

    def send(self, stream: int, message: bytes) -> None:
        """Send a message to the subscribers of a stream."""
        framed = struct.pack("<I", len(message)) + message
        with self._lock:
            for subscriber in self._subscribers.get(stream, ()):
                with contextlib.suppress(OSError):  # about to go
                    subscriber.sendall(framed)

    def token(self, stream: int) -> bytes:
        """Return where a stream is: number, port, TCP, the host that the client connected to."""
        return struct.pack("<IHBB", stream, self._server.port, 1, 0) + bytes(16)
