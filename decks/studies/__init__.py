"""The parts of decks/study.py: jobs, what is read off their results, tables and figures."""
