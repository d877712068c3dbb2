"""Many photos with one recipe, in this process or on Dask's workers."""
