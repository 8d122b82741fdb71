"""Parameter studies: one recipe with lists of values, a folder for each case."""
