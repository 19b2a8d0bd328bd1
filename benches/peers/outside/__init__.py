"""Rooms with windows, under the same skies in quasilux and Radiance."""
