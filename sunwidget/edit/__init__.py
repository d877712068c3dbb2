"""The one table of parameters, the Edit made of it, and recipes."""
