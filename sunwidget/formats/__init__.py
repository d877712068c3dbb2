"""What lies in picture files: color spaces, metadata, gain maps, light."""
