"""Physics of the clear sky in NumPy: constants, optics, reference sky, sun."""
