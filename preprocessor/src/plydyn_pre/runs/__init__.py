"""Runs: from a recipe or a study to results, by the solver of this machine."""
