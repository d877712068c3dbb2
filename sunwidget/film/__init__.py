"""Films of one photo: the path of the sun, the frames, the writers."""
