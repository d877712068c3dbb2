"""Small ONNX networks for the tests, written as protocol buffers by hand.

The onnx package is large and only the training needs it; its file format is a few nested
messages (onnx.proto: the numbers below are its field numbers).
"""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

TYPES = {np.dtype(np.float32): 1, np.dtype(np.uint8): 2, np.dtype(np.int64): 7}
TYPES |= {np.dtype(np.float16): 10, np.dtype(np.float64): 11, np.dtype(np.int32): 6}

Value = tuple[str, Any, Sequence[int | str]]  # name, dtype, shape


def _varint(value: int) -> bytes:
    value &= 2**64 - 1  # a negative one takes ten bytes
    out = bytearray()
    while value > 0x7F:
        out.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes([*out, value])


def _field(number: int, value: int | bytes | str) -> bytes:
    if isinstance(value, int):
        return _varint(number << 3) + _varint(value)
    data = value.encode() if isinstance(value, str) else value
    return _varint(number << 3 | 2) + _varint(len(data)) + data


def _fields(message: bytes) -> Iterator[tuple[int, bytes]]:
    """Yield number and encoding of every field (varints and strings only)."""
    position = 0

    def varint() -> int:
        nonlocal position
        value = shift = 0
        while True:
            byte = message[position]
            position += 1
            value |= (byte & 0x7F) << shift
            shift += 7
            if byte < 0x80:
                return value

    while position < len(message):
        begin = position
        key = varint()
        length = varint()
        if key & 7 == 2:
            position += length
        yield key >> 3, message[begin:position]


def _payload(field: bytes) -> bytes:
    position = 1
    while field[position] & 0x80:
        position += 1
    return field[position + 1 :]


def tensor(name: str, array: Any) -> bytes:
    array = np.asarray(array)
    dims = b"".join(_field(1, n) for n in array.shape)
    return dims + _field(2, TYPES[array.dtype]) + _field(8, name) + _field(9, array.tobytes())


def node(kind: str, inputs: Sequence[str], outputs: Sequence[str], **attributes: Any) -> bytes:
    message = b"".join(_field(1, i) for i in inputs) + b"".join(_field(2, o) for o in outputs)
    message += _field(4, kind)
    for name, value in attributes.items():
        if isinstance(value, int):
            body = _field(3, value) + _field(20, 2)
        else:
            body = b"".join(_field(8, v) for v in value) + _field(20, 7)
        message += _field(5, _field(1, name) + body)
    return message


def value(name: str, dtype: Any, shape: Sequence[int | str]) -> bytes:
    dims = b"".join(_field(1, _field(1 if isinstance(n, int) else 2, n)) for n in shape)
    kind = _field(1, TYPES[np.dtype(dtype)]) + _field(2, dims)
    return _field(1, name) + _field(2, _field(1, kind))


def _graph(
    nodes: Sequence[bytes], constants: dict[str, Any], inputs: Sequence[Value], more: bytes = b""
) -> bytes:
    parts = [_field(1, n) for n in nodes]
    parts += [_field(5, tensor(name, array)) for name, array in constants.items()]
    parts += [_field(11, value(*entry)) for entry in inputs]
    return b"".join(parts) + more


def write(
    path: Path,
    nodes: Sequence[bytes],
    constants: dict[str, Any],
    inputs: Sequence[Value],
    outputs: Sequence[Value],
    metadata: dict[str, str] | None = None,
) -> Path:
    """Write a network and return its path."""
    ends = b"".join(_field(12, value(*entry)) for entry in outputs)
    graph = _graph(nodes, constants, inputs, _field(2, "test") + ends)
    model = _field(1, 8) + _field(8, _field(2, 13)) + _field(7, graph)
    path.write_bytes(model + _metadata(metadata or {}))
    return path


def _metadata(entries: dict[str, str]) -> bytes:
    return b"".join(_field(14, _field(1, key) + _field(2, text)) for key, text in entries.items())


def wrap(
    source: Path,
    path: Path,
    nodes: Sequence[bytes],
    constants: dict[str, Any],
    entry: Value,
    metadata: dict[str, str],
) -> Path:
    """Put nodes before a network's only input, which the last of them must make."""
    model = b""
    for number, field in _fields(source.read_bytes()):
        if number == 7:
            rest = b"".join(f for n, f in _fields(_payload(field)) if n != 11)
            field = _field(7, _graph(nodes, constants, [entry], rest))
        model += field
    path.write_bytes(model + _metadata(metadata))
    return path
