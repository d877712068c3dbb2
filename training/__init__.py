"""How the bundled sky network is made: data, augmentation, training, evaluation, export.

Nothing here is imported by ``sunwidget``; it needs PyTorch, which the package does not.
"""
