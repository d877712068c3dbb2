"""A photo's edited sky as an environment map for 3D programs."""
