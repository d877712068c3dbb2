"""Shared by all widgets: traits, requests, threads, and the data sent to the browser."""
