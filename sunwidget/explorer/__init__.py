"""SkyExplorer's parameters, their values for the shaders, and the drawing."""
