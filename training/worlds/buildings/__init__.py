"""Buildings and streets as meshes: the shapes and parts they are made of, and their makers."""
