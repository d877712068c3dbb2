"""Environment maps of real skies: analysis of sun, sky and air, and relighting."""
