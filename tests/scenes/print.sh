# A report's page on paper: printed by chromium, read by poppler.
. tests/scenes/lib.sh
python=$(command -v /usr/bin/python3 || command -v python3) # Debian's has numpy
"$JOSTLE" run scenes/evacuation.yaml --for 60 --quiet --no-half-step --set 'report.author=A. Engineer' --set 'report.organisation=Crowd </style> "Safety"' \
    --set report.date=2026-05-04 --report "$work/page" >/dev/null 2>&1
verdict "a run with a report" $?
print() { timeout 120 chromium --headless --no-sandbox --disable-gpu --user-data-dir="$work/profile" --no-pdf-header-footer --print-to-pdf="$work/$2.pdf" "file://$work/page/$1.html" >/dev/null 2>&1; } # PAGE PDF
print index page
pages=$(pdfinfo "$work/page.pdf" | sed -n 's/^Pages: *//p')
between "number of pages" "$pages" 8 18
pdfinfo "$work/page.pdf" | grep -q '^Page size: .*A4'; verdict "pages are A4" $?
pdftotext -l 1 -layout "$work/page.pdf" "$work/first.txt"
for text in "A. Engineer" "2026-05-04" "Crowd </style> \"Safety\"" "State hash at the end" "Prepared by" "Approved by" "Contents" "All 140 people left" "Cleared? Yes"; do
    grep -qF -- "$text" "$work/first.txt"; verdict "the first page has: $text" $?
done
pdftotext "$work/page.pdf" - | tr -d '\f' >"$work/page.txt"
sed -n 's/^<h2[^>]*>\(.*\)<\/h2>$/\1/p' "$work/page/index.html" | sed 's/&ensp;/ /' >"$work/heads"
tr -s ' \342\200\202' ' ' <"$work/page.txt" >"$work/plain.txt"
[ "$(grep -c . "$work/heads")" -ge 10 ] && [ "$(grep -xFf "$work/heads" "$work/plain.txt" | awk '!seen[$0]++')" = "$(cat "$work/heads")" ]; verdict "all sections are there, with numbers, in order" $?
pictures=$(grep -o '<img src="[^"]*"' "$work/page/index.html" | sort -u | wc -l)
# pdfimages lists each picture once; a missing picture has no row.
between "number of pictures" "$(pdfimages -list "$work/page.pdf" | awk 'NR > 2 && $3 == "image" && $4 > 500' | sort -u -k11,11 | wc -l)" "$pictures" "$pictures"
# Each page has its running head and number, and no word over the margins.
cat >"$work/pages.py" <<'PYTHON'
import re, sys
pages = open(sys.argv[1], encoding="utf-8").read().split("<page ")[1:]
heads = numbers = wide = 0
heights = []
for number, page in enumerate(pages, 1):
    words = [(float(x), float(y), float(right), text) for x, y, right, text in
             re.findall(r'<word xMin="([\d.-]+)" yMin="([\d.-]+)" xMax="([\d.-]+)" yMax="[\d.-]+">(.*?)</word>', page)]
    heights += [float(b) - float(a) for a, b in re.findall(r'yMin="([\d.-]+)" xMax="[\d.-]+" yMax="([\d.-]+)"', page)]
    top = [w[3] for w in words if w[1] < 50]
    foot = " ".join(w[3] for w in words if w[1] > 785)
    heads += "Evacuation" in top and "Crowd" in top
    numbers += ("page %d of %s" % (number, sys.argv[2])) in foot and "evacuation.yaml" in foot
    wide += sum(w[0] < 30 or w[2] > 565 for w in words)
height = sorted(heights)[len(heights) // 2]  # pt; chromium shrinks pages that have something too wide
for name, good in (("each page has its running head", heads == len(pages)), ("each page has its number", numbers == len(pages)),
                   ("no word runs over the margins", wide == 0), ("pages are printed at full size", height > 8.0)):
    print("ok " + name if good else "not ok %s (%d, %d, %d of %d, %.1f pt)" % (name, heads, numbers, wide, len(pages), height))
PYTHON
pdftotext -bbox "$work/page.pdf" "$work/boxes"
python3 "$work/pages.py" "$work/boxes" "$pages"
! grep -q "$work\|/home\|/tmp" "$work/page.txt"; verdict "no page has a path of this machine" $?
# Pages are filled: each but the last has ink in its last third, below a third of blank lines at most.
cat >"$work/ink.py" <<'PYTHON'
import glob, sys
import numpy as np
blank, first = [], 0
for path in sorted(glob.glob(sys.argv[1] + "-*.pgm"))[:-1]:
    with open(path, "rb") as file:
        words, size, _, pixels = file.read().split(b"\n", 3)
    width, height = map(int, size.split())
    page = np.frombuffer(pixels, np.uint8)[: width * height].reshape(height, width)
    body = np.nonzero((page[: int(height * 0.945)] < 200).any(axis=1))[0]  # without the foot
    blank.append(1 - body[-1] / (height * 0.945))
print("ok no page ends more than a third empty (%.0f %% at most)" % (100 * max(blank)) if max(blank) < 1 / 3
      else "not ok pages end empty: " + ", ".join("%.0f %%" % (100 * b) for b in blank))
PYTHON
pdftoppm -r 20 -gray "$work/page.pdf" "$work/ink" && "$python" "$work/ink.py" "$work/ink"
# The same test fails for a page with a cell that is too wide, and without the running head.
sed 's/<td>scenes\/evacuation.yaml/<td style="white-space:nowrap">a name that fits no page, as it is not broken, and goes on and on and on, and on and on and on, to the end/; s/@top-left/@top-centre/' \
    "$work/page/index.html" >"$work/page/wide.html"
print wide wide
pdftotext -bbox "$work/wide.pdf" "$work/boxes"
python3 "$work/pages.py" "$work/boxes" "$pages" >"$work/out"
grep -q "^not ok pages are printed at full size" "$work/out" && grep -q "^not ok each page has its running head" "$work/out"; verdict "the test sees a cell that is too wide, and a page without its head" $?
