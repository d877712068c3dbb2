"""Networks in ONNX files: loading them, and the outputs of the bundled ones."""
