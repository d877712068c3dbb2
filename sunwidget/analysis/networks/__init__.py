"""Networks in ONNX files: how they are read, and what the bundled ones see."""
