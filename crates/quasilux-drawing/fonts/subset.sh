#!/bin/sh
# Makes the three font files from Noto Sans Regular, Noto Sans Math Regular and the Japanese face of
# Noto Sans CJK Regular: subset.sh NotoSans-Regular.ttf NotoSansMath-Regular.ttf NotoSansCJK-Regular.ttc
set -eu
cd "$(dirname "$0")"
options="--layout-features= --no-hinting --notdef-outline --name-IDs=0,1,2,3,4,5,6,13,14"
latin=U+0020-007E,U+00A0-052F,U+1E00-1FFF,U+2000-2027,U+202F-205F,U+2070-209F,U+20A0-20BF
pyftsubset "$1" $options --drop-tables+=MATH,MVAR,STAT --output-file=NotoSans-subset.ttf \
    --unicodes="$latin,U+2100-214F,U+2150-218B,U+FB00-FB04,U+FFFD"
pyftsubset "$2" $options --drop-tables+=MATH --output-file=NotoSansMath-subset.ttf \
    --unicodes=U+2190-21FF,U+2200-22FF
python3 charset.py NotoSans-subset.ttf NotoSansMath-subset.ttf > charset.txt
pyftsubset "$3" $options --drop-tables+=BASE,VORG,vhea,vmtx --output-file=NotoSansCJK-subset.otf \
    --font-number=0 --unicodes-file=charset.txt
rm charset.txt
