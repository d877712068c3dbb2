"""Widgets as HTML pages and in saved notebooks, without a kernel."""
