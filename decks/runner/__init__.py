"""What runs the studies: jobs of the solver, what is kept of them, tables, and commands."""
