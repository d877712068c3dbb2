"""Errors of the clear-sky model against measurements and other models."""
