"""What SkyExplorer shows: its parameters, the values they give the shaders, and the drawing."""
