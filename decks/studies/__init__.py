"""Studies of the impacts: which cases are run, and what is told of them."""
