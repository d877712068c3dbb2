"""Widgets as HTML pages and in saved notebooks: no kernel."""
