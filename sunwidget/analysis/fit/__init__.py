"""Fit the sky model to a photo, and estimate the fit's confidence."""
