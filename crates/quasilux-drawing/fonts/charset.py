"""Prints the code points of the East Asian subset as hexadecimal numbers, one a line.

They are the letters of JIS X 0208, GB 2312, Big5 level 1 and KS X 1001, read from Python's codecs,
all Hangul syllables, and the letters and signs that stand with them, less the code points of the
font files named as arguments.
"""

import sys

from fontTools.ttLib import TTFont

ROWS = range(0xA1, 0xFF)
BIG5_TRAILS = [*range(0x40, 0x7F), *ROWS]
SETS = [
    ("euc_jp", ROWS, ROWS),
    ("gb2312", ROWS, ROWS),
    ("big5", range(0xA1, 0xC7), BIG5_TRAILS),
    ("euc_kr", ROWS, ROWS),
]
BLOCKS = [
    (0x2460, 0x24FF),  # enclosed numbers
    (0x2500, 0x25FF),  # box drawing, blocks, geometric shapes
    (0x3000, 0x30FF),  # ideographic punctuation, kana
    (0x3131, 0x318E),  # Hangul letters
    (0xAC00, 0xD7A3),  # Hangul syllables
    (0xFF01, 0xFF9F),  # full-width ASCII, half-width kana
]

points = {point for first, last in BLOCKS for point in range(first, last + 1)}
for codec, leads, trails in SETS:
    for lead in leads:
        for trail in trails:
            letter = bytes((lead, trail)).decode(codec, "ignore")
            if len(letter) == 1:
                points.add(ord(letter))
for name in sys.argv[1:]:
    points -= TTFont(name).getBestCmap().keys()
print("\n".join(f"{point:04X}" for point in sorted(points)))
