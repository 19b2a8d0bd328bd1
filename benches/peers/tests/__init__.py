"""Tests of what needs no other program: `python3 -m unittest` in benches/peers."""
