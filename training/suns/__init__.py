"""How the network that finds a photo's sun, and the sky behind it, was made."""
