"""Things that stand outdoors, as meshes: trees, people, cars, boats … Metres, on z = 0."""
