"""The network that finds panes of windows: façades drawn by seed before real photos."""
