"""Analyze a photo into a Scene: a room per stage, which ``pipeline.py`` runs in order."""
