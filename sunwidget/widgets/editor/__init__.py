"""SunEditor."""
