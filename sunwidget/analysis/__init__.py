"""From a photo to a Scene: one map per module, ``scene.analyze`` runs them in order."""
