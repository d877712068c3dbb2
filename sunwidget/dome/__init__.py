"""Environment maps of real skies: their sun, sky and air, and their light under another sun."""
