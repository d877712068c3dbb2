"""How a shipped ONNX file stores its weights: as float16 or as bytes, cast when a session begins.

``python -m training.weights FILE`` stores a file's large weights as bytes, in place.

The networks of the sky and of suns are stored as bytes (no map changes by more than .001 on
average); depth and the unseen sun of the land network would change too much.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
import onnx
from onnx import helper, numpy_helper

from training.quantize import from_bytes, to_bytes

SMALLEST = 64
"""Weights of fewer numbers stay float32."""
SMALLEST_AS_BYTES = 40_000
"""Weights of fewer numbers, and those of one axis, stay float16: they decide most per byte."""
_HALF, _BYTES, _SCALES, _WHOLE = "_half", "_bytes", "_scales", "_whole"


def read_weights(model: onnx.ModelProto) -> dict[str, np.ndarray]:
    """Return a file's weights by the names that they had in training; large ones as float32."""
    stored = {i.name: numpy_helper.to_array(i) for i in model.graph.initializer}
    weights = {}
    for name, values in stored.items():
        if name.endswith(_BYTES):
            name = name.removesuffix(_BYTES)
            values = from_bytes(values, stored[name + _SCALES])
        elif name.endswith(_HALF):
            name = name.removesuffix(_HALF)
            values = values.astype(np.float32)
        elif name.endswith(_SCALES):
            continue
        weights[name] = np.asarray(values)
    return weights


def store_weights(model: onnx.ModelProto, as_bytes: bool = False) -> None:
    """Store large weights as float16, or the largest as bytes, in place; either may be there."""
    graph = model.graph
    weights = read_weights(model)
    casted = {*weights, *(name + _WHOLE for name in weights)}
    for node in [n for n in graph.node if n.output[0] in casted]:
        graph.node.remove(node)
    del graph.initializer[:]
    casts = []

    def store(name: str, values: np.ndarray) -> None:
        graph.initializer.append(numpy_helper.from_array(values, name))

    for name, values in weights.items():
        if values.dtype.kind != "f" or values.size < SMALLEST:
            store(name, values)
        elif as_bytes and values.ndim > 1 and values.size >= SMALLEST_AS_BYTES:
            whole, scales = to_bytes(values)
            store(name + _BYTES, whole)
            store(name + _SCALES, scales)
            casts.append(_cast(name + _BYTES, name + _WHOLE))
            casts.append(helper.make_node("Mul", [name + _WHOLE, name + _SCALES], [name]))
        else:
            store(name + _HALF, values.astype(np.float16))
            casts.append(_cast(name + _HALF, name))
    for cast in reversed(casts):
        graph.node.insert(0, cast)


def _cast(stored: str, name: str) -> onnx.NodeProto:
    return helper.make_node("Cast", [stored], [name], to=onnx.TensorProto.FLOAT)


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("file", type=Path)
    path = parser.parse_args().file
    model = onnx.load(path)
    store_weights(model, as_bytes=True)
    onnx.checker.check_model(model, full_check=True)
    path.write_bytes(model.SerializeToString())
    print(f"{path}: {path.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
