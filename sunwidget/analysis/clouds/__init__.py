"""Clouds: how opaque and how soft they are."""
