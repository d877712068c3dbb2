"""Saving pictures: stills, layers, maps, environment maps."""
