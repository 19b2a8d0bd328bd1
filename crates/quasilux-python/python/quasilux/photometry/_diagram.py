"""Drawings that notebooks show and that are saved as SVG or PNG."""

from __future__ import annotations

from typing import Any

from quasilux import _native
from quasilux.photometry import _files

_SCREEN_SCALE = 2.0


class Diagram:
    """A drawing.

    Notebooks show it. It is the same on every machine, to the byte.

    See Also
    --------
    quasilux.photometry.Photometry.diagram : Diagrams of luminaires.
    quasilux.bsdf.Bsdf.diagram : Diagrams of measured surfaces.
    """

    __slots__ = ("_drawing", "_title")

    def __init__(self, drawing: _native.Drawing, title: str) -> None:
        self._drawing = drawing
        self._title = title

    def to_svg(self) -> str:
        """Return the drawing as the text of an SVG file."""
        return self._drawing.to_svg()

    def to_png(self, *, scale: float = _SCREEN_SCALE) -> bytes:
        """Return the drawing as the bytes of a PNG file.

        Parameters
        ----------
        scale : float, optional
            Pixels for each unit of length of the SVG, 0.1 to 10: 1 for a screen, 2 to 4 for print.

        Raises
        ------
        ValueError
            For other scales.
        """
        if not 0.1 <= scale <= 10.0:
            raise ValueError(f"scale is {scale}; expected 0.1 to 10")
        return self._drawing.to_png(scale)

    def save(self, path: _files.Path, *, scale: float = _SCREEN_SCALE) -> None:
        """Write the drawing to a file whose name ends in ``.svg`` or ``.png``.

        The file appears whole or not at all.

        Parameters
        ----------
        path : str or os.PathLike
            Where to.
        scale : float, optional
            As in `to_png`; nothing to an SVG file.

        Raises
        ------
        ValueError
            For other names.
        OSError
            When the file cannot be written.
        """
        kind = _files.extension(path)
        if kind == ".svg":
            data = self.to_svg().encode()
        elif kind == ".png":
            data = self.to_png(scale=scale)
        else:
            raise ValueError(f"found the extension {kind!r}; expected .svg or .png")
        _files.write_whole(path, data)

    def __repr__(self) -> str:
        return f"<Diagram {self._title!r}>"

    def _repr_svg_(self) -> str:
        return self.to_svg()

    def _repr_png_(self) -> tuple[bytes, dict[str, Any]]:
        png = self.to_png()
        width, height = (int.from_bytes(png[i : i + 4], "big") for i in (16, 20))
        # Twice as many pixels as the notebook gives it room, for screens that have them.
        return png, {"width": width / _SCREEN_SCALE, "height": height / _SCREEN_SCALE}
