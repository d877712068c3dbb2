"""SkyExplorer."""
