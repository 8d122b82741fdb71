"""What is read off the runs of impacts: numbers, differences, profiles, symmetry, faces."""
