"""The one table of parameters, the Edit built from it, and recipes."""
