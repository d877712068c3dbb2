"""Clouds: their opacity and softness."""
