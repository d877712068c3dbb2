"""Pixels and directions; place, time and where the sun stands."""
