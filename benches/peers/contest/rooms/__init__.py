"""The rooms of the contest, one module each."""
