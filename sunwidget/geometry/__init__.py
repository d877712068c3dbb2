"""Pixels and directions; place, time and the sun's position."""
