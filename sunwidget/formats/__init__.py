"""Contents of picture files: color spaces, metadata, gain maps, light."""
