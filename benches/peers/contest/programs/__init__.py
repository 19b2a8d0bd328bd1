"""One module for each program: how it is told of a room and how it is run."""
