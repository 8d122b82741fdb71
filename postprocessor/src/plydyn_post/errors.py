"""What can be wrong with results."""


class ResultsError(Exception):
    """Something is missing from a job's files, or cannot be read; the message names the file."""
