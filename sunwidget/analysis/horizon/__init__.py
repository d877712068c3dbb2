"""The horizon, and straight edges across a picture."""
